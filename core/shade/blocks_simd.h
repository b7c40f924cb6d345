/* blocks_simd.h - shade: converts parts to 4-byte pixels, one block of the tile at a time. For the shading kernel. */
#ifndef ZR_BLOCKS_SIMD_H
#define ZR_BLOCKS_SIMD_H

#include "base/rgba_simd.h"
#include "raster/tile_simd.h"
#include "shade/per_pixel_simd.h"

/* ---- pixels ---- */

/* Returns the words of a patch, whose parts are `count` from `first` on. Parts are read in groups of ZR_PARTS_AT_ONCE,
 * since loops of varying length cost branch mispredictions (a twentieth of the flat bunny's time). Excess parts do no
 * harm: their owners are not in the patch or have the same word, or the pixel has an early colour, which is stored
 * instead. Entries behind the last part match no owner. */
static inline zr_vi zr_words_at(const struct zr_shader *s, uint32_t first, uint32_t count, zr_vi owner)
{
    zr_vi words = zr_vi_set((int32_t)s->words[0]);
    for (uint32_t i = first; i < first + count; i += ZR_PARTS_AT_ONCE)
        for (uint32_t k = i; k < i + ZR_PARTS_AT_ONCE; k++) {
            const zr_vm here = zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[k]));
            words = zr_vi_select(here, zr_vi_set((int32_t)s->words[k]), words);
        }
    return words;
}

/* Returns the words of samples whose parts have planes. */
ZR_INLINED zr_vi zr_planes_at(const struct zr_shader *s, const struct zr_samples_v *in, unsigned mask)
{
    if (!(mask & ZR_VARY_PER_PIXEL))
        return zr_color_over_w(
            zr_shaded_value(in->planes, 0, in->x, in->y), zr_shaded_value(in->planes, 1, in->x, in->y),
            zr_shaded_value(in->planes, 2, in->x, in->y), zr_shaded_value(in->planes, 3, in->x, in->y));
    struct zr_vec3_v color =
        zr_varying3(in, zr_first_plane(mask, ZR_VARY_COLOR), zr_color_w(s, in, mask, zr_varying_w(in)));
    if (s->any_per_pixel) zr_shade_per_pixel(s, in, mask, &color, NULL);
    return zr_rgba_opaque_v(color.x, color.y, color.z);
}

/* Returns the words of a patch that has `count` parts starting at `first`. */
ZR_INLINED zr_vi zr_shade_at(const struct zr_shader *s, uint32_t first, uint32_t count, zr_vi owner, zr_vf x, zr_vf y,
                             unsigned mask)
{
    if (!s->any_planes || count == 0) return zr_words_at(s, first, count, owner);
    zr_vi words = zr_vi_set((int32_t)s->words[0]);
    zr_vf planes[ZR_PLANES_MOST][3];
    const struct zr_samples_v in = {.first = first, .count = count, .owner = owner, .x = x, .y = y, .planes = planes};
    zr_vm smooth = zr_vi_lt(zr_vi_set(0), zr_vi_set(0));
    zr_select_planes(s, first, count, owner, zr_plane_count(mask), planes);
    for (uint32_t i = first; i < first + count; i++) {
        const zr_vm here = zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[i]));
        if (s->has_planes[i])
            smooth = zr_vm_or(smooth, here);
        else
            words = zr_vi_select(here, zr_vi_set((int32_t)s->words[i]), words);
    }
    return zr_vi_select(smooth, zr_planes_at(s, &in, mask), words);
}

/* ---- stores ---- */

/* Destination of a tile's pixels. */
struct zr_store {
    const struct zr_tile *tile;
    bool with_early;                    /* the tile's early colours replace these */
    const struct zr_pixel_rows *behind; /* supplies uncovered pixels; or NULL */
    const struct zr_pixel_rows *out;
};

static inline zr_vi zr_early_or(const struct zr_tile *tile, int32_t at, zr_vi words)
{
    const zr_vi early = zr_vi_load(tile->early_color + at);
    return zr_vi_select(zr_vi_eq(early, zr_vi_set(0)), words, early);
}

static inline zr_vi zr_behind_or(const struct zr_tile *tile, int32_t at, const uint32_t *behind, int32_t columns,
                                 zr_vi words)
{
    uint32_t pixels[ZR_LANES] = {0};
    memcpy(pixels, behind, sizeof *pixels * (size_t)(columns < ZR_LANES ? columns : ZR_LANES));
    return zr_vi_select(zr_vi_eq(zr_vi_load(tile->owner + at), zr_vi_set(0)), zr_vi_load(pixels), words);
}

/* Stores ZR_LANES pixels of a row, starting at x, y of the tile. Pixels outside of the window are skipped. */
static inline void zr_store_pixels(const struct zr_store *to, int32_t x, int32_t y, zr_vi words)
{
    const int32_t columns = to->tile->width - x, at = y * ZR_TILE_STRIDE + x;
    if (y >= to->tile->height || columns <= 0) return;
    if (to->with_early) words = zr_early_or(to->tile, at, words);
    if (to->behind) words = zr_behind_or(to->tile, at, to->behind->first + y * to->behind->stride + x, columns, words);
    uint32_t *out = to->out->first + y * to->out->stride + x;
    if (columns >= ZR_LANES)
        zr_vi_put(out, words, to->out->streamed);
    else
        zr_vi_store_first(out, words, (uint32_t)columns);
}

/* ---- a block ---- */

/* Returns true if the block lies in the window and its pixels need no merging. */
static inline bool zr_block_is_plain(const struct zr_store *to, int block)
{
    return !to->with_early && !to->behind && zr_block_left(block) + ZR_BLOCK_WIDTH <= to->tile->width &&
           zr_block_low(block) + ZR_BLOCK_HEIGHT <= to->tile->height;
}

/* Stores one word in all pixels of a block. */
static inline void zr_store_alike(const struct zr_store *to, int block, zr_vi words)
{
    const int32_t left = zr_block_left(block), low = zr_block_low(block);
    const bool plain = zr_block_is_plain(to, block);
    uint32_t *out = to->out->first + low * to->out->stride + left;
    for (int32_t y = 0; y < ZR_BLOCK_HEIGHT; y++, out += to->out->stride)
        for (int32_t x = 0; x < ZR_BLOCK_WIDTH; x += ZR_LANES)
            if (plain)
                zr_vi_put(out + x, words, to->out->streamed);
            else
                zr_store_pixels(to, left + x, low + y, words);
}

/* Stores a block whose colour is planes: 1/w, then red, green and blue, each times 1/w. */
static inline void zr_store_smooth(const struct zr_store *to, int block, const float (*planes)[4])
{
    const int32_t left = zr_block_left(block), low = zr_block_low(block);
    const bool plain = zr_block_is_plain(to, block);
    uint32_t *out = to->out->first + low * to->out->stride + left;
    zr_vf across[ZR_BLOCK_PARTS][4], y = zr_vf_set((float)(to->tile->y + low));
    for (int v = 0; v < ZR_BLOCK_PARTS; v++) {
        const zr_vf x = zr_vf_of(zr_vi_set(to->tile->x + left + v * ZR_LANES) + zr_vi_ramp());
        for (int k = 0; k < 4; k++)
            across[v][k] = zr_vf_set(planes[k][0]) + zr_vf_set(planes[k][1]) * x;
    }
    for (int32_t row = 0; row < ZR_BLOCK_HEIGHT; row++, out += to->out->stride, y = y + zr_vf_set(1.0f))
        for (int v = 0; v < ZR_BLOCK_PARTS; v++) {
            const zr_vi words =
                zr_color_over_w(across[v][0] + zr_vf_set(planes[0][2]) * y, across[v][1] + zr_vf_set(planes[1][2]) * y,
                                across[v][2] + zr_vf_set(planes[2][2]) * y, across[v][3] + zr_vf_set(planes[3][2]) * y);
            if (plain)
                zr_vi_put(out + v * ZR_LANES, words, to->out->streamed);
            else
                zr_store_pixels(to, left + v * ZR_LANES, low + row, words);
        }
}

/* Stores a block of one part that is shaded per pixel. */
ZR_INLINED void zr_store_per_pixel(const struct zr_shader *s, int block, unsigned mask, const struct zr_store *to)
{
    const uint32_t part = s->parts.blocks[block].first;
    const zr_vi owner = zr_vi_set((int32_t)s->parts.owners[part]);
    const int32_t left = zr_block_left(block), low = zr_block_low(block);
    zr_vf planes[ZR_PLANES_MOST][3];
    struct zr_samples_v in = {.first = part, .count = 1, .owner = owner, .planes = planes};
    zr_select_planes(s, part, 1, owner, zr_plane_count(mask), planes);
    in.y = zr_vf_set((float)(to->tile->y + low));
    for (int32_t row = 0; row < ZR_BLOCK_HEIGHT; row++, in.y = in.y + zr_vf_set(1.0f))
        for (int32_t column = 0; column < ZR_BLOCK_WIDTH; column += ZR_LANES) {
            in.x = zr_vf_of(zr_vi_set(to->tile->x + left + column) + zr_vi_ramp());
            zr_store_pixels(to, left + column, low + row, zr_planes_at(s, &in, mask));
        }
}

/* Stores a block of one part. */
ZR_INLINED void zr_store_whole_block(const struct zr_shader *s, int block, unsigned mask, const struct zr_store *to)
{
    const uint32_t part = s->parts.blocks[block].first;
    if (!s->has_planes[part])
        zr_store_alike(to, block, zr_vi_set((int32_t)s->words[part]));
    else if (mask & ZR_VARY_PER_PIXEL && s->materials[part])
        zr_store_per_pixel(s, block, mask, to);
    else
        zr_store_smooth(to, block, &s->planes[part * (uint32_t)zr_plane_count(mask)]);
}

/* Stores a block patch by patch, as many side by side as make whole rows of ZR_LANES. */
ZR_INLINED void zr_store_patches(const struct zr_shader *s, int number, unsigned mask, const struct zr_store *to)
{
    const struct zr_block_parts *block = &s->parts.blocks[number];
    const struct zr_patch_place place = zr_patch_place_of(to->tile, number);
    uint32_t part = block->first;
    for (int p = 0; p < ZR_BLOCK_PATCHES; p += ZR_PATCH_ROWS) {
        const int32_t x = p % ZR_PATCHES_ACROSS * ZR_PATCH_COLUMNS, y = p / ZR_PATCHES_ACROSS * ZR_PATCH_ROWS;
        const zr_vf fy = zr_vf_of(place.row + zr_vi_set(place.low + y));
        zr_vi rows[ZR_PATCH_ROWS];
        for (int k = 0; k < ZR_PATCH_ROWS; k++) {
            const uint32_t count = block->patches[p + k];
            const zr_vi owner = zr_vi_load_patch(to->tile->owner + zr_patch_first(number, p + k), ZR_TILE_STRIDE);
            const zr_vf fx = zr_vf_of(place.column + zr_vi_set(place.left + x + k * ZR_PATCH_COLUMNS));
            rows[k] = zr_shade_at(s, part, count, owner, fx, fy, mask);
            part += count;
        }
        zr_vi_rows_of_patches(rows);
        for (int k = 0; k < ZR_PATCH_ROWS; k++)
            zr_store_pixels(to, place.left - to->tile->x + x, place.low - to->tile->y + y + k, rows[k]);
    }
}

/* Stores blocks begin .. end - 1 of a channel, whose parts have their words or planes. */
ZR_INLINED void zr_store_blocks(const struct zr_shader *s, const struct zr_store *to, int begin, int end, unsigned mask)
{
    const int across = (to->tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    for (int b = begin; b < end; b++) {
        if (b % ZR_BLOCK_COLUMNS >= across) continue;
        if (s->parts.blocks[b].is_whole)
            zr_store_whole_block(s, b, mask, to);
        else
            zr_store_patches(s, b, mask, to);
    }
}

#endif
