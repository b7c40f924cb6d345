/* borders.h - mesh: loops of edges at which a surface is open.
 *
 * Rule:   a border is a side of a triangle whose edge no other triangle uses. Loops follow borders from corner to corner;
 *         where several meet, the lowest triangle goes on. They are listed by length.
 */
#ifndef ZR_BORDERS_H
#define ZR_BORDERS_H

#include "mesh/features/facets.h"

enum { ZR_BORDERS_MAX = 100 };

struct zr_border {
    uint32_t edges;
    double length;
    zr_dvec3 center; /* mean of its edges, by length */
    bool is_closed;  /* it comes back to its begin */
};

struct zr_borders {
    uint32_t count, omitted;    /* omitted: shorter loops beyond ZR_BORDERS_MAX */
    const struct zr_border *at; /* the longest first */
};

/* Finds the loops, in the arena. False without memory or steps. */
bool zr_borders_find(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_facets *facets,
                     struct zr_borders *out);

#endif
