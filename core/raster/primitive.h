/* primitive.h - raster: common form of triangles, polygons of any shape, lines and points, for every hidden-surface
 * algorithm.
 *
 * Space:  window space, y up; edges on the snapped grid of geometry/viewport.h, where the centre of pixel X, Y is at
 *         256 X, 256 Y.
 * Inside: a sample is covered if an odd number of edges cross its row at or to the left of it: y0 <= 256 Y < y1, and
 *         the edge's x at 256 Y <= 256 X. For a triangle this is the reference's rule 7, which keeps left and bottom
 *         edges.
 * Nearer: among the primitives that cover a sample, the one with the smallest depth is visible; on a tie, the earliest.
 *         Its depth must be less than the sample's initial depth (1, or that of the base picture). */
#ifndef ZR_PRIMITIVE_H
#define ZR_PRIMITIVE_H

#include "raster/depth.h"

struct zr_primitive {
    const struct zr_draw *draw; /* of the first triangle */
    uint32_t first, count;      /* numbers of its triangles, or the number of its line or point */
    uint32_t edge_count;
    const struct zr_grid_edge *shape_edges; /* NULL: own_edges */
    struct zr_grid_edge own_edges[6];       /* of a triangle, a line or a point */
    struct zr_depth depth;                  /* of the first triangle */
    int32_t min_x, min_y, max_x, max_y;     /* pixels of its box within the window, inclusive; none if min > max */
};

/* Depth at a sample, and the owner id: 1 + the number of the triangle, line or point. */
struct zr_hit {
    float depth;
    uint32_t owner;
};

/* Returns the number of triangles of the primitive that begins with number `first` of the draw. */
static inline uint32_t zr_primitive_count(const struct zr_geometry *geometry, const struct zr_draw *draw,
                                          uint32_t first)
{
    const uint32_t shape = draw->kind == ZR_DRAW_SHAPES ? 1 + draw->traits[first - draw->first] / 2 : 0;
    return shape > 0 ? geometry->shapes[shape - 1].triangle_count : 1;
}

/* Computes the pixels of its box, not clipped to the window: min x, min y, max x, max y. */
void zr_primitive_box(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t first, int32_t box[4]);

/* Makes the primitive that begins with number `first` of the draw. */
void zr_primitive_make(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t first, uint32_t width,
                       uint32_t height, struct zr_primitive *primitive);

/* Returns one of its triangles, or its line. */
struct zr_triangle zr_primitive_triangle(const struct zr_geometry *geometry, const struct zr_primitive *primitive,
                                         uint32_t number);

static inline const struct zr_grid_edge *zr_primitive_edges(const struct zr_primitive *primitive)
{
    return primitive->shape_edges ? primitive->shape_edges : primitive->own_edges;
}

/* Returns depth and owner at a covered sample. For a shape, these are of the first triangle that covers the sample; if
 * rounding left none, of the triangle whose edges it misses by the least distance. */
struct zr_hit zr_primitive_hit(const struct zr_geometry *geometry, const struct zr_primitive *primitive, int32_t x,
                               int32_t y);

/* Computes the same for the samples x0 .. x1 - 1 of row y, which must all be covered; processes each triangle of a
 * shape once for all of them. hits[0] is at x0. */
void zr_primitive_hits(const struct zr_geometry *geometry, const struct zr_primitive *primitive, int32_t y, int32_t x0,
                       int32_t x1, struct zr_hit *hits);

#endif
