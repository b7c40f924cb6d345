#include "raster/visibility.h"

#include <string.h>

#include "raster/halfspace.h"
#include "raster/oddeven.h"

enum { PRIMITIVES_A_CANCEL_CHECK = 1024 };

/* ---- tile by tile ---- */

static void place(struct zr_tile *tile, uint32_t number, uint32_t width, uint32_t height)
{
    uint32_t columns = (width + ZR_TILE_SIZE - 1) / ZR_TILE_SIZE;
    tile->x = (int32_t)(number % columns) * ZR_TILE_SIZE;
    tile->y = (int32_t)(number / columns) * ZR_TILE_SIZE;
    tile->width = (int32_t)width - tile->x < ZR_TILE_SIZE ? (int32_t)width - tile->x : ZR_TILE_SIZE;
    tile->height = (int32_t)height - tile->y < ZR_TILE_SIZE ? (int32_t)height - tile->y : ZR_TILE_SIZE;
}

static void clear(struct zr_tile *tile)
{
    for (int i = 0; i < ZR_TILE_SIZE * ZR_TILE_SIZE; i++)
        tile->depth[i] = 1.0f;
    memset(tile->owner, 0, sizeof tile->owner);
}

static bool touches(const struct zr_tile *tile, const struct zr_geometry *geometry, uint32_t first)
{
    int32_t box[4];
    zr_primitive_box(geometry, first, box);
    return box[0] < tile->x + tile->width && box[1] < tile->y + tile->height && box[2] >= tile->x && box[3] >= tile->y;
}

static void draw(const struct zr_geometry *geometry, uint32_t first, uint32_t width, uint32_t height,
                 struct zr_tile *tile)
{
    const struct zr_triangle *record = &geometry->triangles[first];
    if (record->shape == 0 && !record->line) {
        struct zr_setup setup = zr_setup_make(geometry->vertices, record);
        zr_halfspace_draw(tile, &setup, first + 1);
        return;
    }
    struct zr_primitive primitive;
    zr_primitive_make(geometry, first, width, height, &primitive);
    zr_oddeven_draw(geometry, &primitive, tile);
}

/* The tile's own list and the large primitives, merged back into one order. */
bool zr_visibility_tile(const struct zr_geometry *geometry, const struct zr_bins *bins, uint32_t number, uint32_t width,
                        uint32_t height, const struct zr_cancel *cancel, struct zr_tile *tile)
{
    place(tile, number, width, height);
    clear(tile);
    const uint32_t *small = bins->entries + bins->offsets[number],
                   *small_end = bins->entries + bins->offsets[number + 1];
    const uint32_t *large = bins->large, *large_end = large + bins->large_count;
    for (uint32_t drawn = 0; small < small_end || large < large_end; drawn++) {
        if (drawn % PRIMITIVES_A_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
        bool take_small = large == large_end || (small < small_end && *small < *large);
        uint32_t first = take_small ? *small++ : *large++;
        if (take_small || touches(tile, geometry, first)) draw(geometry, first, width, height, tile);
    }
    return true;
}

/* ---- the whole window ---- */

enum zr_status zr_visibility_window(struct zr_arena *arena, const struct zr_geometry *geometry,
                                    zr_visibility_fn *visibility, uint32_t width, uint32_t height,
                                    const struct zr_cancel *cancel, struct zr_samples *samples)
{
    size_t pixels = (size_t)width * height;
    *samples = (struct zr_samples){width, height, zr_arena_alloc(arena, pixels, sizeof *samples->depth),
                                   zr_arena_zero(arena, pixels, sizeof *samples->owner)};
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    for (size_t i = 0; i < pixels; i++)
        samples->depth[i] = 1.0f;
    return visibility(arena, geometry, cancel, samples);
}

void zr_visibility_load(const struct zr_samples *samples, uint32_t number, struct zr_tile *tile)
{
    place(tile, number, samples->width, samples->height);
    for (int32_t row = 0; row < tile->height; row++) {
        size_t at = (size_t)(tile->y + row) * samples->width + (size_t)tile->x;
        memcpy(&tile->depth[row * ZR_TILE_SIZE], samples->depth + at, (size_t)tile->width * sizeof *samples->depth);
        memcpy(&tile->owner[row * ZR_TILE_SIZE], samples->owner + at, (size_t)tile->width * sizeof *samples->owner);
    }
}
