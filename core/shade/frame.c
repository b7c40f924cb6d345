#include "shade/frame.h"

#include "raster/tile.h"

void zr_frame_find_reaches(const struct zr_frame *frame, const uint8_t *occupied)
{
    const uint32_t columns = zr_tile_across(frame->width);
    for (uint32_t row = 0; row < frame->height; row++) {
        const uint8_t *tiles = occupied + (size_t)((frame->height - 1 - row) / ZR_TILE_SIZE) * columns;
        uint32_t begin = 0, end = columns;
        while (begin < end && !tiles[begin])
            begin++;
        while (end > begin && !tiles[end - 1])
            end--;
        end *= ZR_TILE_SIZE;
        frame->reaches[row] = (struct zr_reach){begin * ZR_TILE_SIZE, end < frame->width ? end : frame->width};
        if (begin == columns) frame->reaches[row] = (struct zr_reach){0, 0};
    }
}
