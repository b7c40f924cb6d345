/* grid_edge.h - geometry: an edge on the snapped grid, for the odd-even rule.
 *
 * Space:  snapped coordinates (geometry/viewport.h), y up. */
#ifndef ZR_GRID_EDGE_H
#define ZR_GRID_EDGE_H

#include <stdbool.h>
#include <stdint.h>

struct zr_grid_edge {
    int32_t x0, y0, x1, y1; /* y0 < y1 */
};

/* Makes the edge between two points in either order. Returns false if it is horizontal: such an edge crosses no row of
 * samples, so the odd-even rule ignores it. */
static inline bool zr_grid_edge_make(int32_t ax, int32_t ay, int32_t bx, int32_t by, struct zr_grid_edge *edge)
{
    *edge = ay < by ? (struct zr_grid_edge){ax, ay, bx, by} : (struct zr_grid_edge){bx, by, ax, ay};
    return ay != by;
}

#endif
