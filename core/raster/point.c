#include "raster/point.h"

#include "base/mutant.h"
#include "raster/depth.h"

enum { HALF_PIXEL = ZR_SUBPIXELS / 2 };

/* Rounds to an integer number of subpixels, ties to even; Mesa 22.3 rounded ties up. */
static int32_t subpixels_of(float size)
{
    const float no_fraction = 12582912.0f, subpixels = size * (float)ZR_SUBPIXELS; /* 1.5 * 2^23 */
    return (int32_t)ZR_MUTANT(older_mesa, (subpixels + no_fraction) - no_fraction, subpixels + 0.5f);
}

/* Rounds to an integer, half down. */
int32_t zr_point_width(float size, float scale)
{
    const int32_t subpixels = subpixels_of(size * scale);
    const int32_t width = (subpixels + ZR_MUTANT(point_sizes_half_up, HALF_PIXEL - 1, HALF_PIXEL)) >> ZR_SUBPIXEL_BITS;
    return width > 1 ? width : 1;
}

/* A regular octagon lacks 1 - 1 / sqrt(2) = 0.293 of its width at each corner. */
int32_t zr_point_cut(const struct zr_mesh *mesh, int32_t width)
{
    return mesh->points_are_round ? width * 3 / 10 : 0;
}

static const struct zr_window_vertex *middle_of(const struct zr_geometry *geometry, const struct zr_draw *draw,
                                                uint32_t number)
{
    return &geometry->vertices[draw->first_vertex + zr_draw_corner(draw, number - draw->first, 0)];
}

/* Returns the first of `width` pixels. For an odd width, the middle pixel contains the point; for an even one, the two
 * middle pixels meet at the nearest pixel corner. Snapped coordinates are relative to a pixel's centre (viewport.h). */
static int32_t first_of(int32_t snapped, int32_t width)
{
    const int32_t from_corner = snapped + HALF_PIXEL;
    if (width % 2 != 0) return (from_corner >> ZR_SUBPIXEL_BITS) - width / 2;
    return ((from_corner + ZR_MUTANT(even_points_lean, HALF_PIXEL, 0)) >> ZR_SUBPIXEL_BITS) - width / 2;
}

void zr_point_box(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number, int32_t box[4])
{
    const struct zr_window_vertex *middle = middle_of(geometry, draw, number);
    const int32_t width = zr_point_width(draw->mesh->point_size, geometry->window.point_scale);
    box[0] = first_of(zr_snapped_x(middle), width);
    box[1] = first_of(zr_snapped_y(middle), width);
    box[2] = box[0] + width - 1;
    box[3] = box[1] + width - 1;
}

void zr_point_draw(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number,
                   struct zr_tile *tile)
{
    const int32_t last_x = tile->x + tile->width - 1, last_y = tile->y + tile->height - 1;
    const float depth = zr_depth_clamp(middle_of(geometry, draw, number)->z);
    int32_t box[4];
    zr_point_box(geometry, draw, number, box);
    const int32_t cut = zr_point_cut(draw->mesh, box[2] - box[0] + 1);
    for (int32_t y = box[1] > tile->y ? box[1] : tile->y; y <= box[3] && y <= last_y; y++) {
        const int32_t row = y - box[1] < box[3] - y ? y - box[1] : box[3] - y, lacks = row < cut ? cut - row : 0;
        const int32_t first = box[0] + lacks, last = box[2] - lacks;
        for (int32_t x = first > tile->x ? first : tile->x; x <= last && x <= last_x; x++)
            zr_tile_put(tile, x, y, depth, number + 1);
    }
}
