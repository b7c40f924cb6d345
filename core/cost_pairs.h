/* cost_pairs.h - the core: how often the triangles of a scene run through one another, from a sample of them.
 *
 * Space:  window space.
 * Why:    the painter compares and cuts what is neither nearer nor farther than something else, pair by pair
 *         (raster/textbook/painter.c); no other algorithm minds.
 */
#ifndef ZR_COST_PAIRS_H
#define ZR_COST_PAIRS_H

#include <stddef.h>

#include "geometry/viewport.h"

/* All pairs of so many are looked at: in a millisecond or two, where all overlap. */
enum { ZR_COST_PAIRS_SAMPLE = 128 };

struct zr_cost_triangle {
    struct zr_window_vertex corners[3];
};

struct zr_cost_pairs {
    double meeting;     /* of all pairs: the share whose boxes, depth included, overlap */
    double overlapping; /* of all pairs: the share that has pixels in common as well */
    double heights;     /* of the two together, 0 for all other pairs; mean over all pairs */
    double area;        /* of these pixels, where one is the nearer at all of them; mean over all pairs */
    double crossing;    /* the share that is each the nearer somewhere */
    double rows;        /* of the window in which a pair does so, 0 for all others; mean over all pairs */
};

struct zr_cost_pairs zr_cost_pairs_measure(const struct zr_cost_triangle *triangles, size_t count);

#endif
