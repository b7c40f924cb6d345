#include "raster/textbook/whole_window.h"

#include <string.h>

#include "base/run.h"

/* Copies a tile's initial depths to the window and clears its owners. */
static void begin_rows(struct zr_samples *samples, const struct zr_tile *tile)
{
    for (int32_t row = 0; row < tile->height; row++) {
        size_t at = (size_t)(tile->y + row) * samples->width + (size_t)tile->x;
        memcpy(samples->depth + at, &tile->depth[row * ZR_TILE_STRIDE], (size_t)tile->width * sizeof *samples->depth);
        memset(samples->owner + at, 0, (size_t)tile->width * sizeof *samples->owner);
    }
}

enum zr_status zr_visibility_window(const struct zr_run *run, const struct zr_geometry *geometry,
                                    zr_visibility_fn *visibility, uint32_t width, uint32_t height,
                                    const struct zr_base *base, struct zr_samples *samples)
{
    size_t pixels = (size_t)width * height;
    *samples = (struct zr_samples){.width = width,
                                   .height = height,
                                   .depth = zr_arena_alloc(run->arena, pixels, sizeof *samples->depth),
                                   .owner = zr_arena_alloc(run->arena, pixels, sizeof *samples->owner)};
    struct zr_tile *tile = zr_arena_alloc(run->arena, 1, sizeof *tile);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    for (uint32_t number = 0; number < zr_tile_count(width, height); number++) {
        if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
        zr_tile_place(tile, number, width, height);
        zr_tile_begin(tile, base, width, height);
        begin_rows(samples, tile);
    }
    return visibility(run, geometry, samples);
}

enum zr_status zr_visibility_window_fragments(const struct zr_run *run, const struct zr_geometry *geometry,
                                              zr_visibility_fn *visibility, enum zr_alpha_mode mode,
                                              struct zr_samples *samples, struct zr_fragments *fragments)
{
    enum zr_status status = ZR_OK;
    samples->drawn = mode;
    samples->fragments = fragments;
    if (!zr_fragments_begin(run->arena, NULL, samples->width * samples->height, fragments)) return ZR_NO_MEMORY;
    status = visibility(run, geometry, samples);
    if (status != ZR_OK) return status;
    if (!zr_fragments_prefix_sum(run->arena, NULL, fragments)) return ZR_NO_MEMORY;
    status = visibility(run, geometry, samples);
    zr_fragments_sort(run->cancel, fragments);
    samples->fragments = NULL;
    return status;
}

void zr_visibility_load(const struct zr_samples *samples, uint32_t number, struct zr_tile *tile)
{
    zr_tile_place(tile, number, samples->width, samples->height);
    tile->is_empty = tile->has_early_color = false;
    tile->has_block_owners = false;
    tile->unwritten = 0;
    memset(tile->owner, 0, sizeof tile->owner); /* also beyond the window */
    for (int32_t row = 0; row < tile->height; row++) {
        size_t at = (size_t)(tile->y + row) * samples->width + (size_t)tile->x;
        memcpy(&tile->depth[row * ZR_TILE_STRIDE], samples->depth + at, (size_t)tile->width * sizeof *samples->depth);
        memcpy(&tile->owner[row * ZR_TILE_STRIDE], samples->owner + at, (size_t)tile->width * sizeof *samples->owner);
    }
}

/* ---- the interface ---- */

static const struct zr_whole_window *window_of(const struct zr_visibility *visibility)
{
    return (const struct zr_whole_window *)visibility; /* its first member */
}

static bool load_tile(const struct zr_visibility *visibility, uint32_t number, const struct zr_cancel *cancel,
                      struct zr_tile *tile)
{
    zr_visibility_load(&window_of(visibility)->samples, number, tile);
    return !zr_is_cancelled(cancel);
}

/* Returns true if the window has lists for that mode: any tile may then have fragments. */
static bool has_any(const struct zr_visibility *visibility, uint32_t number, enum zr_alpha_mode mode)
{
    (void)number;
    return mode == ZR_ALPHA_OPAQUE || window_of(visibility)->lists[mode].ends;
}

/* Copies the fragments in front of the tile's samples. Keys are sorted by depth, so the first that is not in front ends
 * the list. */
static bool load_fragments(const struct zr_visibility *visibility, uint32_t number, enum zr_alpha_mode mode,
                           const struct zr_cancel *cancel, struct zr_tile *tile)
{
    const struct zr_whole_window *window = window_of(visibility);
    const struct zr_samples *samples = &window->samples;
    (void)number;
    for (int32_t y = 0; window->lists[mode].ends && y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++) {
            const size_t at = (size_t)(tile->y + y) * samples->width + (size_t)(tile->x + x);
            const uint32_t place = (uint32_t)(y * ZR_TILE_STRIDE + x);
            uint32_t count;
            const uint64_t *keys = zr_fragments_of(&window->lists[mode], (uint32_t)at, &count);
            for (uint32_t i = 0; i < count && zr_fragment_depth(keys[i]) < tile->depth[place]; i++)
                zr_fragments_put(tile->fragments, place, zr_fragment_depth(keys[i]), zr_fragment_owner(keys[i]));
        }
    return !zr_is_cancelled(cancel);
}

/* Lists all fragments of operands, those behind opaque samples included: windings need them. */
static enum zr_status list_operands(const struct zr_run *run, const struct zr_geometry *geometry,
                                    zr_visibility_fn *visibility, struct zr_whole_window *window)
{
    struct zr_samples *samples = &window->samples;
    const size_t pixels = (size_t)samples->width * samples->height;
    float *const depth = samples->depth, *const far = zr_arena_alloc(run->arena, pixels, sizeof *far);
    if (!far) return ZR_NO_MEMORY;
    for (size_t i = 0; i < pixels; i++)
        far[i] = 1.0f;
    samples->depth = far;
    const enum zr_status status = zr_visibility_window_fragments(run, geometry, visibility, ZR_ALPHA_OPERAND, samples,
                                                                 &window->lists[ZR_ALPHA_OPERAND]);
    samples->depth = depth;
    return status;
}

/* Puts the nearest fragment of each list. */
static bool draw_nearest(const struct zr_visibility *visibility, uint32_t number, enum zr_alpha_mode mode,
                         const struct zr_cancel *cancel, struct zr_tile *tile)
{
    const struct zr_whole_window *window = window_of(visibility);
    (void)number;
    for (int32_t y = 0; window->lists[mode].ends && y < tile->height; y++)
        for (int32_t x = 0; x < tile->width; x++) {
            const size_t at = (size_t)(tile->y + y) * window->samples.width + (size_t)(tile->x + x);
            uint32_t count;
            const uint64_t *keys = zr_fragments_of(&window->lists[mode], (uint32_t)at, &count);
            if (count > 0)
                zr_tile_put_at(tile, (uint32_t)(y * ZR_TILE_STRIDE + x), zr_fragment_depth(keys[0]),
                               zr_fragment_owner(keys[0]));
        }
    return !zr_is_cancelled(cancel);
}

enum zr_status zr_whole_window_make(const struct zr_run *run, const struct zr_geometry *geometry,
                                    zr_visibility_fn *visibility, const bool listed[ZR_ALPHA_COUNT],
                                    const struct zr_base *base, struct zr_whole_window *window)
{
    *window = (struct zr_whole_window){
        .visibility = {.tile = load_tile, .has_any = has_any, .fragments = load_fragments, .draw = draw_nearest}};
    enum zr_status status = zr_visibility_window(run, geometry, visibility, geometry->window.width,
                                                 geometry->window.height, base, &window->samples);
    if (listed[ZR_ALPHA_OPERAND] && status == ZR_OK) status = list_operands(run, geometry, visibility, window);
    for (int mode = 0; mode < ZR_ALPHA_OPERAND && status == ZR_OK; mode++)
        if (listed[mode])
            status = zr_visibility_window_fragments(run, geometry, visibility, (enum zr_alpha_mode)mode,
                                                    &window->samples, &window->lists[mode]);
    return status;
}
