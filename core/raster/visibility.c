#include "raster/visibility.h"

#include "raster/halfspace.h"

enum { TRIANGLES_A_CANCEL_CHECK = 1024 };

static bool touches(const struct zr_tile *tile, const struct zr_geometry *geometry, uint32_t triangle)
{
    int32_t box[4];
    zr_setup_box(geometry->vertices, &geometry->triangles[triangle], box);
    return box[0] < tile->x + tile->width && box[1] < tile->y + tile->height && box[2] >= tile->x && box[3] >= tile->y;
}

static void place(struct zr_tile *tile, const struct zr_bins *bins, uint32_t number, uint32_t width, uint32_t height)
{
    tile->x = (int32_t)(number % bins->columns) * ZR_TILE_SIZE;
    tile->y = (int32_t)(number / bins->columns) * ZR_TILE_SIZE;
    tile->width = (int32_t)width - tile->x < ZR_TILE_SIZE ? (int32_t)width - tile->x : ZR_TILE_SIZE;
    tile->height = (int32_t)height - tile->y < ZR_TILE_SIZE ? (int32_t)height - tile->y : ZR_TILE_SIZE;
}

/* The tile's own list and the large triangles, merged back into one order. */
bool zr_visibility_tile(const struct zr_geometry *geometry, const struct zr_bins *bins, uint32_t number, uint32_t width,
                        uint32_t height, const struct zr_base *base, const struct zr_cancel *cancel,
                        struct zr_tile *tile)
{
    place(tile, bins, number, width, height);
    zr_tile_begin(tile, base, width, height);
    const uint32_t *small = bins->entries + bins->offsets[number],
                   *small_end = bins->entries + bins->offsets[number + 1];
    const uint32_t *large = bins->large, *large_end = large + bins->large_count;
    for (uint32_t drawn = 0; small < small_end || large < large_end; drawn++) {
        if (drawn % TRIANGLES_A_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
        bool take_small = large == large_end || (small < small_end && *small < *large);
        uint32_t triangle = take_small ? *small++ : *large++;
        if (!take_small && !touches(tile, geometry, triangle)) continue;
        struct zr_setup setup = zr_setup_make(geometry->vertices, &geometry->triangles[triangle]);
        zr_halfspace_draw(tile, &setup, triangle + 1);
    }
    return true;
}
