#include "raster/visibility.h"

#include <string.h>

#include "raster/halfspace.h"
#include "raster/line_draw.h"
#include "raster/oddeven.h"

/* Primitives, or edges and triangles of shapes: less than a millisecond of work. */
enum { PARTS_A_CANCEL_CHECK = 1024 };

/* ---- tile by tile ---- */

static void draw(const struct zr_geometry *geometry, uint32_t first, uint32_t width, uint32_t height,
                 struct zr_tile *tile)
{
    const struct zr_triangle *record = &geometry->triangles[first];
    if (record->line) {
        zr_line_draw(geometry, first, tile);
        return;
    }
    if (record->shape == 0) {
        struct zr_setup setup = zr_setup_make(geometry->vertices, record);
        zr_halfspace_draw(tile, &setup, first + 1);
        return;
    }
    struct zr_primitive primitive;
    zr_primitive_make(geometry, first, width, height, &primitive);
    zr_oddeven_draw(geometry, &primitive, tile);
}

static uint32_t parts_of(const struct zr_geometry *geometry, uint32_t first)
{
    uint32_t shape = geometry->triangles[first].shape;
    return shape > 0 ? geometry->shapes[shape - 1].edge_count + geometry->shapes[shape - 1].triangle_count : 1;
}

/* The tile's own list and the large primitives, merged back into one order. */
bool zr_visibility_tile(const struct zr_geometry *geometry, const struct zr_bins *bins, uint32_t number, uint32_t width,
                        uint32_t height, const struct zr_base *base, const struct zr_cancel *cancel,
                        struct zr_tile *tile)
{
    zr_tile_place(tile, number, width, height);
    zr_tile_begin(tile, base, width, height);
    const uint32_t *small = bins->entries + bins->offsets[number],
                   *small_end = bins->entries + bins->offsets[number + 1];
    const uint32_t *large = bins->large, *large_end = large + bins->large_count;
    uint64_t parts = PARTS_A_CANCEL_CHECK;
    while (small < small_end || large < large_end) {
        if (parts >= PARTS_A_CANCEL_CHECK) {
            if (zr_is_cancelled(cancel)) return false;
            parts = 0;
        }
        bool take_small = large == large_end || (small < small_end && *small < *large);
        uint32_t first = take_small ? *small++ : *large++;
        parts += parts_of(geometry, first);
        int32_t box[4];
        if (!take_small) zr_primitive_box(geometry, first, box);
        if (take_small || zr_tile_touches(tile, box)) draw(geometry, first, width, height, tile);
    }
    return true;
}

/* ---- the whole window ---- */

static void copy_rows(struct zr_samples *samples, const struct zr_tile *tile)
{
    for (int32_t row = 0; row < tile->height; row++) {
        size_t at = (size_t)(tile->y + row) * samples->width + (size_t)tile->x;
        memcpy(samples->depth + at, &tile->depth[row * ZR_TILE_SIZE], (size_t)tile->width * sizeof *samples->depth);
    }
}

enum zr_status zr_visibility_window(struct zr_arena *arena, const struct zr_geometry *geometry,
                                    zr_visibility_fn *visibility, uint32_t width, uint32_t height,
                                    const struct zr_base *base, const struct zr_cancel *cancel,
                                    struct zr_samples *samples)
{
    size_t pixels = (size_t)width * height;
    *samples = (struct zr_samples){width, height, zr_arena_alloc(arena, pixels, sizeof *samples->depth),
                                   zr_arena_zero(arena, pixels, sizeof *samples->owner)};
    struct zr_tile *tile = zr_arena_alloc(arena, 1, sizeof *tile);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    for (uint32_t number = 0; number < zr_tile_count(width, height); number++) {
        zr_tile_place(tile, number, width, height);
        zr_tile_begin(tile, base, width, height);
        copy_rows(samples, tile);
    }
    return visibility(arena, geometry, cancel, samples);
}

void zr_visibility_load(const struct zr_samples *samples, uint32_t number, struct zr_tile *tile)
{
    zr_tile_place(tile, number, samples->width, samples->height);
    for (int32_t row = 0; row < tile->height; row++) {
        size_t at = (size_t)(tile->y + row) * samples->width + (size_t)tile->x;
        memcpy(&tile->depth[row * ZR_TILE_SIZE], samples->depth + at, (size_t)tile->width * sizeof *samples->depth);
        memcpy(&tile->owner[row * ZR_TILE_SIZE], samples->owner + at, (size_t)tile->width * sizeof *samples->owner);
    }
}
