#include "raster/line_draw.h"

static int32_t most(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

static int32_t least(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

void zr_line_draw(const struct zr_geometry *geometry, const struct zr_triangle *line, uint32_t owner,
                  struct zr_tile *tile)
{
    struct zr_line_corners corners;
    int32_t first, last;
    if (!zr_line_corners_make(&geometry->vertices[line->v[0]], &geometry->vertices[line->v[1]],
                              geometry->window.line_width, &corners))
        return;
    struct zr_depth depth = zr_depth_make(geometry->vertices, line);
    int32_t begin = corners.along_x ? tile->x : tile->y, size = corners.along_x ? tile->width : tile->height;
    int32_t side = corners.along_x ? tile->y : tile->x, side_size = corners.along_x ? tile->height : tile->width;
    zr_line_range(&corners, &first, &last);
    first = most(first, begin);
    last = least(last, begin + size - 1);
    for (int32_t at = first; at <= last; at++) {
        const int32_t begin_across = zr_line_pixel(&corners, at);
        const int32_t end_across = least(begin_across + corners.width, side + side_size);
        for (int32_t across = most(begin_across, side); across < end_across; across++) {
            const int32_t x = corners.along_x ? at : across, y = corners.along_x ? across : at;
            zr_tile_put(tile, x, y, zr_depth_at(&depth, x, y), owner);
        }
    }
}

void zr_line_tiles(const struct zr_line_corners *line, uint32_t width, uint32_t height,
                   void (*visit)(void *context, uint32_t column, uint32_t row), void *context)
{
    int32_t first, last, length = (int32_t)(line->along_x ? width : height),
                         breadth = (int32_t)(line->along_x ? height : width);
    zr_line_range(line, &first, &last);
    first = most(first, 0);
    last = least(last, length - 1);
    for (int32_t begin = first; begin <= last; begin = (begin / ZR_TILE_SIZE + 1) * ZR_TILE_SIZE) {
        int32_t end = least((begin / ZR_TILE_SIZE + 1) * ZR_TILE_SIZE - 1, last);
        int32_t a = zr_line_pixel(line, begin), b = zr_line_pixel(line, end);
        int32_t low = most(least(a, b), 0), high = least(most(a, b) + line->width - 1, breadth - 1);
        for (int32_t across = low / ZR_TILE_SIZE; low <= high && across <= high / ZR_TILE_SIZE; across++)
            visit(context, (uint32_t)(line->along_x ? begin / ZR_TILE_SIZE : across),
                  (uint32_t)(line->along_x ? across : begin / ZR_TILE_SIZE));
    }
}
