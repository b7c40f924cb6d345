/* setup.h - raster: edge functions and depth plane of one triangle.
 *
 * Space:  window space, y up; integers on the snapped grid of geometry/viewport.h.
 * Exact:  the reference's rules 7 (edges and the fill rule) and 8 (depth). */
#ifndef ZR_SETUP_H
#define ZR_SETUP_H

#include "raster/depth.h"

/* A pixel X, Y is covered if c + a X + b Y > 0 for all three edges. */
struct zr_edge {
    int64_t a, b, c;
};

struct zr_setup {
    struct zr_edge edges[3];
    struct zr_depth depth;
    int32_t min_x, min_y, max_x, max_y; /* pixels whose centres are in the bounding box, inclusive */
};

/* Computes the box only; empty (min > max) if it contains no pixel centre. */
void zr_setup_box(const struct zr_window_vertex *vertices, const struct zr_triangle *triangle, int32_t box[4]);

/* Sets up a triangle; lines and shapes are not accepted. */
struct zr_setup zr_setup_make(const struct zr_window_vertex *vertices, const struct zr_triangle *triangle);

static inline int64_t zr_edge_at(const struct zr_edge *edge, int32_t x, int32_t y)
{
    return edge->c + edge->a * x + edge->b * y;
}

static inline bool zr_setup_covers(const struct zr_setup *setup, int32_t x, int32_t y)
{
    return zr_edge_at(&setup->edges[0], x, y) > 0 && zr_edge_at(&setup->edges[1], x, y) > 0 &&
           zr_edge_at(&setup->edges[2], x, y) > 0;
}

#endif
