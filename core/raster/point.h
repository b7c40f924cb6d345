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

/* Computes the pixels of a point of the draw, not clipped to the window: min x, min y, max x, max y. */
void zr_point_box(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number, int32_t box[4]);

/* Writes depth and owner to the samples where the point is visible (zr_tile_put). */
void zr_point_draw(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number,
                   struct zr_tile *tile);

#endif
