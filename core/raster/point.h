/* point.h - raster: a point -> the square of pixels that it covers.
 *
 * Space:  window space, y up.
 * Exact:  as llvmpipe draws GL_POINTS without antialiasing, to the last bit (the reference's rule 28).
 */
#ifndef ZR_POINT_H
#define ZR_POINT_H

#include "geometry/geometry.h"
#include "raster/tile.h"

/* Pixels along a side, for a size in pixels that is made `scale` times as large: whole, and at least 1. */
int32_t zr_point_width(float size, float scale);

/* The pixels of a point of the draw, wherever they are: min x, min y, max x, max y. */
void zr_point_box(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number, int32_t box[4]);

/* Where the point is seen (zr_tile_put), writes its depth and owner. */
void zr_point_draw(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number,
                   struct zr_tile *tile);

#endif
