#include "shade/frame.h"

#include "raster/tile.h"

/* Of one row of tiles. */
static struct zr_reach reach_of(const uint8_t *occupied, uint32_t columns, uint32_t width)
{
    uint32_t begin = 0, end = columns;
    while (begin < end && !occupied[begin])
        begin++;
    while (end > begin && !occupied[end - 1])
        end--;
    if (begin == end) return (struct zr_reach){0, 0};
    return (struct zr_reach){begin * ZR_TILE_SIZE, end < columns ? end * ZR_TILE_SIZE : width};
}

void zr_frame_find_reaches(const struct zr_frame *frame, const uint8_t *occupied)
{
    const uint32_t columns = zr_tile_across(frame->width);
    struct zr_reach reach = {0, 0};
    for (uint32_t y = 0; y < frame->height; y++) {
        if (y % ZR_TILE_SIZE == 0)
            reach = reach_of(occupied + (size_t)(y / ZR_TILE_SIZE) * columns, columns, frame->width);
        frame->reaches[frame->height - 1 - y] = reach;
    }
}
