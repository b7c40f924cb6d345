/* facets.h - mesh: the flat facets of a surface, and their neighbours.
 *
 * How:    triangles are neighbours across an edge that two of them use, in opposite directions. Neighbours whose normals
 *         differ by less than 0.05 degrees, plus the angle that rounding turns the thinner one by, are of one facet.
 *         A triangle without area joins the neighbour across its longest side.
 * Order:  facets are numbered in the order of their first triangles.
 */
#ifndef ZR_FACETS_H
#define ZR_FACETS_H

#include "base/arena.h"
#include "mesh/features/surface.h"

#define ZR_NO_FACET UINT32_MAX

struct zr_facets {
    const struct zr_surface *surface;
    uint32_t count;
    const uint32_t (*neighbours)[3]; /* per triangle: that across the side from corner k to corner k + 1; ZR_NO_FACET */
    const uint32_t *of_triangle;     /* facet */
    const uint32_t *begins;          /* count + 1, into `triangles` */
    const uint32_t *triangles;       /* by facet, ascending */
    const zr_dvec3 *normals;         /* unit length; 0 if the facet has no area */
    const double *areas;
    uint32_t border_count;
    const uint32_t *borders; /* sides 3 t + k whose edge no other triangle uses, ascending */
};

/* Makes the facets in the arena: some 100 bytes per triangle. False without memory or steps. */
bool zr_facets_make(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_surface *surface,
                    struct zr_facets *out);

#endif
