/* point.h - raster: the square or the octagon of pixels that a point covers.
 *
 * Space:  window space, y up.
 * Exact:  squares equal llvmpipe's GL_POINTS without antialiasing, to the last bit (the reference's rule 28). */
#ifndef ZR_POINT_H
#define ZR_POINT_H

#include "geometry/geometry.h"
#include "raster/tile.h"

/* Returns the side of the square in pixels, an integer of at least 1, for a point size in pixels times `scale`. */
int32_t zr_point_width(float size, float scale);

/* Returns the leg of the triangles that a round point of this width lacks at its corners, in pixels; 0 for squares.
 * Row i of the point, from either end, lacks cut - i pixels at each side. */
int32_t zr_point_cut(const struct zr_mesh *mesh, int32_t width);

/* Computes the pixels of a point of that width, not clipped to the window: min x, min y, max x, max y. */
void zr_point_box_at(const struct zr_window_vertex *middle, int32_t width, int32_t box[4]);

/* The same for a point of a draw that is not a cloud. */
void zr_point_box(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number, int32_t box[4]);

/* Pixels of a point. */
struct zr_point_shape {
    int32_t x, y;       /* the lowest */
    int32_t width, cut; /* zr_point_width and zr_point_cut */
};

/* Puts the pixels to the tile or to its lists (zr_tile_put). Returns the number of pixels in the tile. */
uint32_t zr_point_put(const struct zr_point_shape *shape, float depth, uint32_t owner, struct zr_tile *tile);

/* The same for a point of a draw that is not a cloud. */
void zr_point_draw(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number,
                   struct zr_tile *tile);

#endif
