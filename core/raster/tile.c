#include "raster/tile.h"

#include <string.h>

void zr_tile_place(struct zr_tile *tile, uint32_t number, uint32_t width, uint32_t height)
{
    uint32_t columns = zr_tile_across(width);
    tile->fragments = NULL;
    tile->x = (int32_t)(number % columns) * ZR_TILE_SIZE;
    tile->y = (int32_t)(number / columns) * ZR_TILE_SIZE;
    tile->width = (int32_t)width - tile->x < ZR_TILE_SIZE ? (int32_t)width - tile->x : ZR_TILE_SIZE;
    tile->height = (int32_t)height - tile->y < ZR_TILE_SIZE ? (int32_t)height - tile->y : ZR_TILE_SIZE;
}

/* Returns the next float above `depth` (in 0..1), at most 1, so that z < result means z <= depth and z < 1. The bits of
 * non-negative floats have the order of the floats. */
static inline float just_above(float depth)
{
    uint32_t bits;
    memcpy(&bits, &depth, sizeof bits);
    bits = depth > 0.0f ? bits + 1 : 1; /* -0 has other bits */
    float above;
    memcpy(&above, &bits, sizeof above);
    return depth < 1.0f ? above : 1.0f;
}

static void load_row(float *out, const float *depth, int32_t count, bool ties_too)
{
    if (!ties_too) {
        memcpy(out, depth, (size_t)count * sizeof *out);
        return;
    }
    for (int32_t i = 0; i < count; i++)
        out[i] = just_above(depth[i]);
}

void zr_tile_begin(struct zr_tile *tile, const struct zr_base *base, uint32_t width, uint32_t height)
{
    memset(tile->owner, 0, sizeof tile->owner);
    tile->has_block_owners = false;
    tile->unwritten = 0;
    tile->far = 1.0f;
    tile->is_empty = false;
    const uint32_t blocks = zr_tile_blocks(tile);
    for (int i = 0; i < ZR_BLOCKS; i++)
        tile->block_far[i] = blocks >> i & 1 ? 1.0f : 0.0f;
    for (int i = 0; i < ZR_TILE_STRIDE * ZR_TILE_SIZE; i++)
        tile->depth[i] = 1.0f; /* also beyond the window, since blocks are tested as a whole */
    for (int32_t row = 0; base && base->window_depth && row < tile->height; row++) {
        /* Window space has y up; pictures have row 0 on top. */
        size_t line = (size_t)(height - 1 - (uint32_t)(tile->y + row)) * width + (size_t)tile->x;
        load_row(&tile->depth[row * ZR_TILE_STRIDE], base->window_depth + line, tile->width, base->scene_wins_ties);
    }
}
