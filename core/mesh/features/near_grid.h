/* near_grid.h - mesh: tells which places lie on a surface, or nearly so.
 *
 * How:    a grid of cells, each with the triangles that come within the reach of it. It is made coarser if triangles
 *         lie in many cells.
 */
#ifndef ZR_NEAR_GRID_H
#define ZR_NEAR_GRID_H

#include "base/arena.h"
#include "mesh/features/surface.h"

struct zr_near_grid {
    const struct zr_surface *surface;
    double reach, low[3], cell;
    uint32_t sides[3];
    const uint32_t *begins; /* per cell, and behind the last */
    const uint32_t *triangles;
};

/* Makes a grid for places up to `reach` away, in the arena. False without memory or steps. */
bool zr_near_grid_make(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_surface *surface,
                       double reach, struct zr_near_grid *out);

/* Returns true if a triangle is within the reach of a place. */
bool zr_near_grid_has(struct zr_feature_work *work, const struct zr_near_grid *grid, zr_dvec3 place);

#endif
