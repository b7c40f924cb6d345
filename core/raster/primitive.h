/* primitive.h - raster: what can be seen, in the one form that every algorithm takes: a
 * triangle, a polygon of any shape, a line, or a point.
 *
 * Space:  window space, y up; edges on the snapped grid of geometry/viewport.h, where the
 *         centre of pixel X, Y lies at 256 X, 256 Y.
 * Inside: a sample is covered where an odd number of edges pass below or through its row and
 *         on its left or through it: y0 <= 256 Y < y1, and the edge's x at 256 Y <= 256 X.
 *         For a triangle that is the reference's rule 7, which keeps left and bottom edges.
 * Nearer: of all primitives that cover a sample the one with the smallest depth is seen, of
 *         equal ones the earliest; and only where that is less than the depth the sample
 *         starts with (1, or that of a picture drawn before).
 */
#ifndef ZR_PRIMITIVE_H
#define ZR_PRIMITIVE_H

#include "raster/depth.h"

struct zr_primitive {
    const struct zr_draw *draw; /* of the first */
    uint32_t first, count;      /* numbers of its triangles, or the number of its line or point */
    uint32_t edge_count;
    const struct zr_grid_edge *shape_edges; /* NULL: own_edges */
    struct zr_grid_edge own_edges[4];       /* of a triangle, a line or a point */
    struct zr_depth depth;                  /* of the first; of the only one, where count is 1 */
    int32_t min_x, min_y, max_x, max_y;     /* pixels in its box and in the window, inclusive; none where min > max */
};

/* The depth at a sample, and its owner: 1 + the number of the triangle, line or point. */
struct zr_hit {
    float depth;
    uint32_t owner;
};

/* How many triangles the primitive has that begins with number `first` of the draw: the next one begins behind them. */
static inline uint32_t zr_primitive_count(const struct zr_geometry *geometry, const struct zr_draw *draw,
                                          uint32_t first)
{
    const uint32_t shape = draw->kind == ZR_DRAW_SHAPES ? 1 + draw->traits[first - draw->first] / 2 : 0;
    return shape > 0 ? geometry->shapes[shape - 1].triangle_count : 1;
}

/* Pixels in its box, wherever they are: min x, min y, max x, max y. */
void zr_primitive_box(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t first, int32_t box[4]);

/* The primitive that begins with number `first` of the draw. */
void zr_primitive_make(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t first, uint32_t width,
                       uint32_t height, struct zr_primitive *primitive);

/* One of its triangles, or its line. */
struct zr_triangle zr_primitive_triangle(const struct zr_geometry *geometry, const struct zr_primitive *primitive,
                                         uint32_t number);

static inline const struct zr_grid_edge *zr_primitive_edges(const struct zr_primitive *primitive)
{
    return primitive->shape_edges ? primitive->shape_edges : primitive->own_edges;
}

/* What a covered sample sees of the primitive. Of a shape's triangles the first that covers the sample
 * tells; where rounding left none, the one whose edges it misses by least. */
struct zr_hit zr_primitive_hit(const struct zr_geometry *geometry, const struct zr_primitive *primitive, int32_t x,
                               int32_t y);

/* The same for the samples x0 .. x1 - 1 of row y, all covered, at once: each of a shape's many triangles is
 * looked at once for all of them. hits[0] is that at x0. */
void zr_primitive_hits(const struct zr_geometry *geometry, const struct zr_primitive *primitive, int32_t y, int32_t x0,
                       int32_t x1, struct zr_hit *hits);

#endif
