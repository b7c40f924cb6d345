#include "raster/binned_scene.h"

#include <string.h>

#include "base/fast.h"
#include "base/prefetch.h"
#include "base/run.h"
#include "geometry/geometry.h"
#include "raster/line_draw.h"
#include "raster/oddeven.h"
#include "raster/point.h"

/* Triangles, or edges and triangles of shapes, between two checks for cancellation: less than a millisecond. */
enum { PARTS_PER_CANCEL_CHECK = 1024 };

/* Number of blocks of fragments, or of small triangles, from which on a tile keeps early colours. Fewer pixels are
 * shaded faster than stored and merged; fewer small triangles are larger than stamps. An estimate that affects time
 * only: it counts the blocks of all threads and draws, full or not, with early colours or without. */
enum { BLOCKS_WITH_COLOR = 3, SMALL_BLOCKS_WITH_COLOR = 9 };

/* ---- large and wide triangles ---- */

enum { CHOSEN_AT_ONCE = 128 };

/* Triangles that touch the tile, with their nearest depth there. */
struct candidates {
    int count;
    float near[CHOSEN_AT_ONCE];
    const struct zr_wide *items[CHOSEN_AT_ONCE];
};

static int nearest_of(const struct candidates *c)
{
    int nearest = 0;
    for (int i = 1; i < c->count; i++)
        if (c->near[i] < c->near[nearest]) nearest = i;
    return nearest;
}

/* Draws candidates, the nearest first, until the rest is hidden. Most are then never tested per sample, nor sorted. */
static void draw_candidates(const struct zr_binned_scene *binned, struct candidates *c, struct zr_tile *tile)
{
    while (c->count > 0) {
        const int i = ZR_FAST(nearest_first, true) ? nearest_of(c) : 0;
        if (ZR_FAST(nearest_first, c->near[i] > tile->far)) break;
        binned->halfspace->draw(tile, &c->items[i]->setup, c->items[i]->owner);
        c->count--;
        c->near[i] = c->near[c->count];
        c->items[i] = c->items[c->count];
    }
    c->count = 0;
}

static void add_candidate(const struct zr_binned_scene *binned, const struct zr_wide *wide, struct candidates *c,
                          struct zr_tile *tile)
{
    const struct zr_setup *setup = &wide->setup;
    if (!zr_tile_touches(tile, (const int32_t[4]){setup->min_x, setup->min_y, setup->max_x, setup->max_y})) return;
    const int32_t x1 = tile->x + tile->width - 1, y1 = tile->y + tile->height - 1;
    const float near = zr_depth_range_of(&setup->depth, tile->x, tile->y, x1, y1).near;
    if (ZR_FAST(nearest_first, near > tile->far)) return;
    c->near[c->count] = near;
    c->items[c->count++] = wide;
    if (c->count == CHOSEN_AT_ONCE) draw_candidates(binned, c, tile);
}

/* Draws the large triangles, which every tile tests, and the wide ones that are listed in this tile. With the nearest
 * first, the back of a cube costs half. */
static bool draw_wide_ones(const struct zr_binned_scene *binned, const struct zr_bins *bins, uint32_t number,
                           const struct zr_cancel *cancel, struct zr_tile *tile)
{
    struct candidates candidates;
    candidates.count = 0;
    for (uint32_t i = 0; i < bins->large_count; i++) {
        if (i % PARTS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
        add_candidate(binned, bins->large[i], &candidates, tile);
    }
    for (int i = 0; i < bins->worker_count; i++)
        for (const struct zr_bin_head *b = bins->workers[i].tiles[number].wide.first; b; b = b->next) {
            if (zr_is_cancelled(cancel)) return false;
            for (uint32_t k = 0; k < b->used; k++)
                add_candidate(binned, ((const struct zr_bin_wides *)b)->items[k], &candidates, tile);
        }
    draw_candidates(binned, &candidates, tile);
    return true;
}

/* ---- small and tiny triangles ---- */

/* Draws a block of fragments. Prefetches the next block (a quarter of the time that this takes), and the memory that
 * shading reads first: with a million triangles, each pixel has its own (4 % of their time). Pixels with an early
 * colour read none. */
static void draw_fragments(const struct zr_binned_scene *binned, const struct zr_bin_fragments *block,
                           size_t block_size, struct zr_tile *tile)
{
    const struct zr_geometry *geometry = binned->geometry;
    const bool has_early_color = tile->has_early_color;
    const uint32_t first_number = block->first_owner - 1;
    const struct zr_draw *draw = zr_draw_of(geometry, first_number); /* the draw of most of them */
    const struct zr_prepaint *prepaint = binned->prepaints ? &binned->prepaints[draw - geometry->draws] : NULL;
    const size_t step = prepaint ? prepaint->step : 0;
    const uintptr_t first = prepaint ? prepaint->first + step * (first_number - draw->first) : (uintptr_t)block;
    if (block->head.next) zr_prefetch(block->head.next, 0, block_size);
    for (uint32_t i = 0; i < block->head.used; i++) {
        const uint32_t place = block->places[i] >> ZR_BIN_OWNER_BITS;
        const uint32_t owner = block->places[i] & ((1u << ZR_BIN_OWNER_BITS) - 1);
        if (!zr_tile_put_at(tile, place, block->depths[i], block->first_owner + owner)) continue;
        if (has_early_color)
            tile->early_color[place] = block->words[i];
        else
            __builtin_prefetch((const void *)(first + step * owner));
    }
}

/* If blocks are full, a whole number of groups for any instruction set. */
enum { SMALL_AT_ONCE = 16 * ZR_BIN_NUMBERS_PER_BLOCK };

/* Draws small triangles to the tile or to its lists. Numbers from all lists are collected in one array, so that the
 * kernel has whole groups and can prefetch. */
static bool put_small_ones(const struct zr_binned_scene *binned, const struct zr_bins *bins, uint32_t number,
                           const struct zr_cancel *cancel, struct zr_tile *tile)
{
    uint32_t numbers[SMALL_AT_ONCE], count = 0;
    for (int i = 0; i < bins->worker_count; i++)
        for (const struct zr_bin_head *b = bins->workers[i].tiles[number].small.first; b; b = b->next) {
            if (count + b->used > SMALL_AT_ONCE) {
                if (zr_is_cancelled(cancel)) return false;
                binned->draw_small(tile, binned->geometry, binned->prepaints, numbers, count);
                count = 0;
            }
            memcpy(numbers + count, ((const struct zr_bin_numbers *)b)->numbers, b->used * sizeof *numbers);
            count += b->used;
        }
    if (zr_is_cancelled(cancel)) return false;
    if (count > 0) binned->draw_small(tile, binned->geometry, binned->prepaints, numbers, count);
    return true;
}

static void draw_tiny_ones(const struct zr_binned_scene *binned, const struct zr_bins *bins, uint32_t number,
                           struct zr_tile *tile)
{
    for (int i = 0; i < bins->worker_count; i++)
        for (const struct zr_bin_head *b = bins->workers[i].tiles[number].fragments.first; b; b = b->next)
            draw_fragments(binned, (const struct zr_bin_fragments *)b, bins->fragments_size, tile);
}

/* ---- fragments of masked and blended triangles ---- */

static void list_wide(const struct zr_binned_scene *binned, const struct zr_wide *wide, struct zr_tile *tile)
{
    const struct zr_setup *setup = &wide->setup;
    if (zr_tile_touches(tile, (const int32_t[4]){setup->min_x, setup->min_y, setup->max_x, setup->max_y}))
        binned->halfspace->list(tile, setup, wide->owner);
}

static bool list_wide_ones(const struct zr_binned_scene *binned, const struct zr_bins *bins, uint32_t number,
                           const struct zr_cancel *cancel, struct zr_tile *tile)
{
    for (uint32_t i = 0; i < bins->large_count; i++) {
        if (i % PARTS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return false;
        list_wide(binned, bins->large[i], tile);
    }
    for (int i = 0; i < bins->worker_count; i++)
        for (const struct zr_bin_head *b = bins->workers[i].tiles[number].wide.first; b; b = b->next) {
            if (zr_is_cancelled(cancel)) return false;
            for (uint32_t k = 0; k < b->used; k++)
                list_wide(binned, ((const struct zr_bin_wides *)b)->items[k], tile);
        }
    return true;
}

static void list_tiny_ones(const struct zr_bins *bins, uint32_t number, struct zr_tile *tile)
{
    const uint32_t owners = (1u << ZR_BIN_OWNER_BITS) - 1;
    for (int i = 0; i < bins->worker_count; i++)
        for (const struct zr_bin_head *b = bins->workers[i].tiles[number].fragments.first; b; b = b->next) {
            const struct zr_bin_fragments *block = (const struct zr_bin_fragments *)b;
            for (uint32_t k = 0; k < b->used; k++)
                zr_tile_list_at(tile, block->places[k] >> ZR_BIN_OWNER_BITS, block->depths[k],
                                block->first_owner + (block->places[k] & owners));
        }
}

/* ---- shapes, lines, placed points, triangles with a depth offset ---- */

static void draw_misc_one(const struct zr_binned_scene *binned, const struct zr_draw *draw, uint32_t number,
                          struct zr_tile *tile)
{
    const struct zr_geometry *geometry = binned->geometry;
    if (draw->kind == ZR_DRAW_POINTS) {
        zr_point_draw(geometry, draw, number, tile);
        return;
    }
    const struct zr_triangle triangle = zr_triangle_of(geometry, draw, number);
    if (triangle.line) {
        zr_line_draw(geometry, &triangle, number + 1, tile);
    } else if (triangle.shape == 0) {
        struct zr_setup setup = zr_setup_make(geometry->vertices, &triangle);
        binned->halfspace->draw(tile, &setup, number + 1);
    } else {
        struct zr_primitive primitive;
        zr_primitive_make(geometry, draw, number, binned->width, binned->height, &primitive);
        zr_oddeven_draw(geometry, &primitive, tile);
    }
}

/* Lists a primitive's fragments as those of a polygon of any shape, triangles included, so that all algorithms list the
 * same. */
static void list_misc_one(const struct zr_binned_scene *binned, const struct zr_draw *draw, uint32_t number,
                          struct zr_tile *tile)
{
    struct zr_primitive primitive;
    zr_primitive_make(binned->geometry, draw, number, binned->width, binned->height, &primitive);
    zr_oddeven_draw(binned->geometry, &primitive, tile);
}

static uint32_t parts_of(const struct zr_geometry *geometry, const struct zr_draw *draw, uint32_t number)
{
    if (draw->kind != ZR_DRAW_SHAPES) return 1;
    const struct zr_shape *shape = &geometry->shapes[draw->traits[number - draw->first] / 2];
    return shape->edge_count + shape->triangle_count;
}

static bool draw_list(const struct zr_binned_scene *binned, const uint32_t *misc, size_t count, bool may_miss,
                      const struct zr_cancel *cancel, struct zr_tile *tile)
{
    const struct zr_draw *draw = &binned->geometry->draws[0];
    uint64_t parts = PARTS_PER_CANCEL_CHECK;
    for (size_t i = 0; i < count; i++) {
        draw = zr_draw_next(binned->geometry, draw, misc[i]);
        if (parts >= PARTS_PER_CANCEL_CHECK) {
            if (zr_is_cancelled(cancel)) return false;
            parts = 0;
        }
        int32_t box[4];
        parts += parts_of(binned->geometry, draw, misc[i]);
        if (may_miss) zr_primitive_box(binned->geometry, draw, misc[i], box);
        if (may_miss && !zr_tile_touches(tile, box)) continue;
        if (tile->fragments)
            list_misc_one(binned, draw, misc[i], tile);
        else
            draw_misc_one(binned, draw, misc[i], tile);
    }
    return true;
}

static bool draw_misc(const struct zr_binned_scene *binned, const struct zr_misc_bins *misc, uint32_t number,
                      const struct zr_cancel *cancel, struct zr_tile *tile)
{
    if (misc->count == 0) return true;
    size_t begin = misc->offsets[number], end = misc->offsets[number + 1];
    return draw_list(binned, misc->entries + begin, end - begin, false, cancel, tile) &&
           draw_list(binned, misc->large, misc->large_count, true, cancel, tile);
}

static bool any_listed(const struct zr_misc_bins *misc, uint32_t number)
{
    return misc->count > 0 && (misc->large_count > 0 || misc->offsets[number] < misc->offsets[number + 1]);
}

/* ---- a tile ---- */

/* Returns true if the tile has primitives other than large and wide triangles. */
static bool has_more(const struct zr_mode_bins *mode_bins, uint32_t number)
{
    const struct zr_bins *bins = &mode_bins->bins;
    for (int i = 0; i < bins->worker_count; i++)
        if (bins->workers[i].tiles[number].small.first || bins->workers[i].tiles[number].fragments.first) return true;
    return any_listed(&mode_bins->misc, number) || zr_cloud_bins_any(&mode_bins->clouds, number);
}

static const struct zr_binned_scene *binned_of(const struct zr_visibility *visibility)
{
    return (const struct zr_binned_scene *)visibility; /* its first member */
}

static bool has_any(const struct zr_visibility *visibility, uint32_t number, enum zr_alpha_mode mode)
{
    const struct zr_mode_bins *mode_bins = &binned_of(visibility)->modes[mode];
    if (mode_bins->bins.large_count > 0) return true;
    for (int i = 0; i < mode_bins->bins.worker_count; i++)
        if (mode_bins->bins.workers[i].tiles[number].wide.first) return true;
    return has_more(mode_bins, number);
}

/* Returns true if keeping early colours pays: there are enough of them, and no other primitive is drawn over them. */
static bool keeps_early_color(const struct zr_binned_scene *binned, uint32_t number)
{
    const struct zr_mode_bins *mode_bins = &binned->modes[ZR_ALPHA_OPAQUE];
    const struct zr_bins *bins = &mode_bins->bins;
    if (bins->has_words && has_any(&binned->visibility, number, ZR_ALPHA_OPERAND)) return false;
    uint32_t fragments = 0, small = 0;
    for (int i = 0; bins->has_words && i < bins->worker_count; i++) {
        fragments += bins->workers[i].tiles[number].fragments.block_count;
        small += bins->workers[i].tiles[number].small.block_count;
    }
    return (fragments >= BLOCKS_WITH_COLOR || small >= SMALL_BLOCKS_WITH_COLOR) &&
           !any_listed(&mode_bins->misc, number) && !zr_cloud_bins_any(&mode_bins->clouds, number);
}

/* Draws all but the large and wide triangles to a written tile. */
static bool draw_smaller(const struct zr_binned_scene *binned, const struct zr_mode_bins *mode_bins, uint32_t number,
                         const struct zr_cancel *cancel, struct zr_tile *tile)
{
    if (!put_small_ones(binned, &mode_bins->bins, number, cancel, tile)) return false;
    draw_tiny_ones(binned, &mode_bins->bins, number, tile);
    return draw_misc(binned, &mode_bins->misc, number, cancel, tile) &&
           zr_cloud_bins_draw(&mode_bins->clouds, number, cancel, tile);
}

static bool draw_tile(const struct zr_visibility *visibility, uint32_t number, const struct zr_cancel *cancel,
                      struct zr_tile *tile)
{
    const struct zr_binned_scene *binned = binned_of(visibility);
    const struct zr_base *base = binned->base;
    const struct zr_mode_bins *opaque = &binned->modes[ZR_ALPHA_OPAQUE];
    zr_tile_place(tile, number, binned->width, binned->height);
    tile->has_early_color = false;
    tile->is_empty = !base && !has_any(visibility, number, ZR_ALPHA_OPAQUE);
    if (tile->is_empty) return !zr_is_cancelled(cancel);
    if (base)
        zr_tile_begin(tile, base, binned->width, binned->height);
    else
        binned->halfspace->begin(tile);
    /* The largest first: they hide most, and only they can leave blocks unwritten. */
    if (!draw_wide_ones(binned, &opaque->bins, number, cancel, tile)) return false;
    if (!has_more(opaque, number) && zr_tile_has_whole_blocks(tile)) return true;
    binned->halfspace->flush(tile);
    tile->has_block_owners = false;
    tile->has_early_color = keeps_early_color(binned, number);
    if (tile->has_early_color) memset(tile->early_color, 0, sizeof tile->early_color);
    return draw_smaller(binned, opaque, number, cancel, tile);
}

static bool draw_over(const struct zr_visibility *visibility, uint32_t number, enum zr_alpha_mode mode,
                      const struct zr_cancel *cancel, struct zr_tile *tile)
{
    const struct zr_binned_scene *binned = binned_of(visibility);
    const struct zr_mode_bins *mode_bins = &binned->modes[mode];
    return draw_wide_ones(binned, &mode_bins->bins, number, cancel, tile) &&
           draw_smaller(binned, mode_bins, number, cancel, tile);
}

static bool list_fragments(const struct zr_visibility *visibility, uint32_t number, enum zr_alpha_mode mode,
                           const struct zr_cancel *cancel, struct zr_tile *tile)
{
    const struct zr_binned_scene *binned = binned_of(visibility);
    const struct zr_mode_bins *mode_bins = &binned->modes[mode];
    if (!list_wide_ones(binned, &mode_bins->bins, number, cancel, tile)) return false;
    if (!put_small_ones(binned, &mode_bins->bins, number, cancel, tile)) return false;
    list_tiny_ones(&mode_bins->bins, number, tile);
    return draw_misc(binned, &mode_bins->misc, number, cancel, tile) &&
           zr_cloud_bins_draw(&mode_bins->clouds, number, cancel, tile);
}

/* ---- binning ---- */

enum zr_status zr_binned_scene_make(const struct zr_run *run, const struct zr_geometry *geometry,
                                    const struct zr_prepaint *prepaints, uint32_t width, uint32_t height,
                                    const struct zr_base *base, struct zr_binned_scene *binned)
{
    binned->visibility =
        (struct zr_visibility){.tile = draw_tile, .has_any = has_any, .fragments = list_fragments, .draw = draw_over};
    binned->geometry = geometry;
    binned->prepaints = prepaints;
    binned->halfspace = zr_halfspace_of(zr_team_isa(run->team));
    binned->draw_small = zr_small_of(zr_team_isa(run->team));
    binned->width = width;
    binned->height = height;
    binned->base = base;
    enum zr_status status = ZR_OK;
    for (int i = 0; status == ZR_OK && i < ZR_ALPHA_COUNT; i++) {
        const enum zr_alpha_mode mode = (enum zr_alpha_mode)i;
        struct zr_mode_bins *mode_bins = &binned->modes[mode];
        status = zr_bins_build(run, geometry, mode, prepaints, width, height, &mode_bins->bins);
        if (status == ZR_OK) status = zr_misc_bins_build(run, geometry, mode, width, height, &mode_bins->misc);
        if (status == ZR_OK) status = zr_cloud_bins_build(run, geometry, mode, width, height, &mode_bins->clouds);
        if (status != ZR_OK) break;
        zr_counts_add(&binned->visibility.counts, &mode_bins->bins.counts);
        zr_counts_add(&binned->visibility.counts, &mode_bins->clouds.counts);
    }
    return status;
}
