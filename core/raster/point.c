#include "raster/point.h"

#include "base/mutant.h"
#include "raster/depth.h"

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
    const int32_t width =
        (subpixels + ZR_MUTANT(point_sizes_half_up, ZR_HALF_PIXEL - 1, ZR_HALF_PIXEL)) >> ZR_SUBPIXEL_BITS;
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

void zr_point_box(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number, int32_t box[4])
{
    const int32_t width = zr_point_width(draw->mesh->point_size, geometry->window.point_scale);
    zr_point_box_at(middle_of(geometry, draw, number), width, box);
}

/* zr_tile_put for pixels first .. last of a row, without branches on the kind of tile. */
static inline void put_row(struct zr_tile *tile, uint32_t first, uint32_t last, float depth, uint32_t owner)
{
    for (uint32_t i = first; i <= last; i++)
        zr_tile_put_at(tile, i, depth, owner);
}

uint32_t zr_point_put(const struct zr_point_shape *shape, float depth, uint32_t owner, struct zr_tile *tile)
{
    const int32_t low_x = shape->x - tile->x, low_y = shape->y - tile->y, width = shape->width;
    const int32_t y0 = low_y > 0 ? low_y : 0, y1 = low_y + width < tile->height ? low_y + width : tile->height;
    uint32_t pixels = 0;
    for (int32_t y = y0; y < y1; y++) {
        const int32_t from_end = y - low_y < low_y + width - 1 - y ? y - low_y : low_y + width - 1 - y;
        const int32_t lacks = from_end < shape->cut ? shape->cut - from_end : 0, first = low_x + lacks;
        const int32_t x0 = first > 0 ? first : 0, end = low_x + width - lacks;
        const int32_t x1 = end < tile->width ? end : tile->width;
        if (x0 >= x1) continue;
        const uint32_t at = (uint32_t)(y * ZR_TILE_STRIDE);
        pixels += (uint32_t)(x1 - x0);
        if (!tile->fragments)
            put_row(tile, at + (uint32_t)x0, at + (uint32_t)x1 - 1, depth, owner);
        else
            for (int32_t x = x0; x < x1; x++)
                zr_tile_list_at(tile, at + (uint32_t)x, depth, owner);
    }
    return pixels;
}

void zr_point_draw(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number,
                   struct zr_tile *tile)
{
    int32_t box[4];
    zr_point_box(geometry, draw, number, box);
    const int32_t width = box[2] - box[0] + 1;
    const struct zr_point_shape shape = {box[0], box[1], width, zr_point_cut(draw->mesh, width)};
    zr_point_put(&shape, zr_depth_clamp(middle_of(geometry, draw, number)->z), number + 1, tile);
}
