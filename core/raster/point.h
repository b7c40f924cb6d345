/* point.h - raster: the square or the octagon of pixels that a point covers.
 *
 * Space:  window space, y up.
 * Exact:  squares equal llvmpipe's GL_POINTS without antialiasing, to the last bit (the reference's rule 28). */
#ifndef ZR_POINT_H
#define ZR_POINT_H

#include "base/mutant.h"
#include "geometry/geometry.h"
#include "raster/tile.h"

/* Returns the side of the square in pixels, an integer of at least 1, for a point size in pixels times `scale`. */
int32_t zr_point_width(float size, float scale);

/* Returns the leg of the triangles that a round point of this width lacks at its corners, in pixels; 0 for squares.
 * Row i of the point, from either end, lacks cut - i pixels at each side. */
int32_t zr_point_cut(const struct zr_mesh *mesh, int32_t width);

enum { ZR_HALF_PIXEL = ZR_SUBPIXELS / 2 };

/* Returns the first of `width` pixels. For an odd width, the middle pixel contains the point; for an even one, the two
 * middle pixels meet at the nearest pixel corner. Snapped coordinates are relative to a pixel's centre (viewport.h). */
static inline int32_t zr_point_first(int32_t snapped, int32_t width)
{
    const int32_t from_corner = snapped + ZR_HALF_PIXEL;
    if (width % 2 != 0) return (from_corner >> ZR_SUBPIXEL_BITS) - width / 2;
    return ((from_corner + ZR_MUTANT(even_points_lean, ZR_HALF_PIXEL, 0)) >> ZR_SUBPIXEL_BITS) - width / 2;
}

/* Computes the pixels of a point of that width, not clipped to the window: min x, min y, max x, max y. */
static inline void zr_point_box_at(const struct zr_window_vertex *middle, int32_t width, int32_t box[4])
{
    box[0] = zr_point_first(zr_snapped_x(middle), width);
    box[1] = zr_point_first(zr_snapped_y(middle), width);
    box[2] = box[0] + width - 1;
    box[3] = box[1] + width - 1;
}

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
