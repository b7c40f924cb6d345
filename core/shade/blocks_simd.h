/* blocks_simd.h - shade: from parts to pixels of four bytes, a block of the tile at a time, for the kernel that shades.
 */
#ifndef ZR_BLOCKS_SIMD_H
#define ZR_BLOCKS_SIMD_H

#include "base/rgba_simd.h"
#include "raster/tile_simd.h"
#include "shade/shader_simd.h"

/* ---- pixels ---- */

/* What `count` parts from `first` on show in a patch, whose pixels x, y are. */
static inline zr_vi zr_words_at(const struct zr_shader *s, uint32_t first, uint32_t count, zr_vi owner)
{
    zr_vi words = zr_vi_set((int32_t)s->nothing);
    for (uint32_t i = first; i < first + count; i++) {
        const zr_vm here = zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[i]));
        words = zr_vi_select(here, zr_vi_set((int32_t)s->words[i]), words);
    }
    return words;
}

/* Pixels of parts that are shaded late take their model's colour; the others stay. */
static inline zr_vi zr_shade_late(const struct zr_shader *s, uint32_t first, uint32_t count, zr_vi owner,
                                  zr_vf (*planes)[3], zr_vf x, zr_vf y, int plane_count, zr_vi words)
{
    const bool in_fog = plane_count > 1 + ZR_VALUES_LATE;
    const zr_vf one = zr_vf_set(1.0f), w = one / zr_shaded_value(planes, 0, x, y);
    zr_vf color_w = w;
    for (uint32_t i = first; in_fog && i < first + count; i++)
        if (s->is_constant[i])
            color_w = zr_vf_select(zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[i])), one, color_w);
    const struct zr_model_inputs in = {zr_shaded_three(planes, 1, color_w, x, y), zr_shaded_three(planes, 4, w, x, y),
                                       zr_shaded_three(planes, 7, w, x, y)};
    const struct zr_material *done = NULL; /* most often there is one */
    for (uint32_t i = first; i < first + count; i++) {
        const struct zr_material *material = s->materials[i];
        if (!material || material == done) continue;
        zr_vm of_it = zr_vi_lt(zr_vi_set(0), zr_vi_set(0));
        for (uint32_t other = i; other < first + count; other++)
            if (s->materials[other] == material)
                of_it = zr_vm_or(of_it, zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[other])));
        struct zr_vec3_v color = zr_model_color(&s->model, material, &in);
        if (in_fog) color = zr_fogged_v(&s->model, color, zr_shaded_value(planes, 1 + ZR_VALUES_LATE, x, y) * w);
        words = zr_vi_select(of_it, zr_rgba_opaque_v(color.x, color.y, color.z), words);
        done = material;
    }
    return words;
}

static inline zr_vi zr_shade_at(const struct zr_shader *s, uint32_t first, uint32_t count, zr_vi owner, zr_vf x,
                                zr_vf y, int plane_count)
{
    if (!s->any_planes || count == 0) return zr_words_at(s, first, count, owner);
    zr_vi words = zr_vi_set((int32_t)s->nothing);
    zr_vf planes[1 + ZR_VALUES_MOST][3];
    zr_vm smooth = zr_vi_lt(zr_vi_set(0), zr_vi_set(0));
    zr_select_planes(s, first, count, owner, plane_count, planes);
    for (uint32_t i = first; i < first + count; i++) {
        const zr_vm here = zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[i]));
        if (s->has_planes[i])
            smooth = zr_vm_or(smooth, here);
        else
            words = zr_vi_select(here, zr_vi_set((int32_t)s->words[i]), words);
    }
    words = zr_vi_select(smooth,
                         zr_color_over_w(zr_shaded_value(planes, 0, x, y), zr_shaded_value(planes, 1, x, y),
                                         zr_shaded_value(planes, 2, x, y), zr_shaded_value(planes, 3, x, y)),
                         words);
    if (plane_count > 1 + ZR_VALUES_FEW && s->any_late)
        return zr_shade_late(s, first, count, owner, planes, x, y, plane_count, words);
    return words;
}

/* ---- a block ---- */

/* A block before it is written. */
struct zr_block_pixels {
    _Alignas(64) uint32_t pixels[ZR_BLOCK_HEIGHT][ZR_BLOCK_WIDTH];
};

/* All of one part's. */
static inline void zr_shade_whole_block(const struct zr_shader *s, const struct zr_tile *tile, int number,
                                        int plane_count, struct zr_block_pixels *out)
{
    const uint32_t part = s->parts.blocks[number].first;
    const zr_vi word = zr_vi_set((int32_t)s->words[part]), owner = zr_vi_set((int32_t)s->parts.owners[part]);
    const bool has_planes = s->has_planes[part], late = plane_count > 1 + ZR_VALUES_FEW && s->materials[part];
    zr_vf planes[1 + ZR_VALUES_MOST][3];
    const int32_t left = tile->x + number % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH;
    zr_vf y = zr_vf_set((float)(tile->y + number / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT));
    zr_select_planes(s, part, 1, owner, plane_count, planes);
    for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, y = y + zr_vf_set(1.0f))
        for (int v = 0; v < ZR_BLOCK_WIDTH; v += ZR_LANES) {
            const zr_vf x = zr_vf_of(zr_vi_set(left + v) + zr_vi_ramp());
            zr_vi words = word;
            if (late)
                words = zr_shade_late(s, part, 1, owner, planes, x, y, plane_count, words);
            else if (has_planes)
                words = zr_color_over_w(zr_shaded_value(planes, 0, x, y), zr_shaded_value(planes, 1, x, y),
                                        zr_shaded_value(planes, 2, x, y), zr_shaded_value(planes, 3, x, y));
            zr_vi_store(&out->pixels[row][v], words);
        }
}

/* Where the patches of a block lie in the window. */
struct zr_patch_place {
    zr_vi column, row; /* of each lane in its patch */
    int32_t left, low; /* of the block */
};

static inline struct zr_patch_place zr_patch_place_of(const struct zr_tile *tile, int number)
{
    const zr_vi lane = zr_vi_ramp(), column = lane & zr_vi_set(ZR_PATCH_COLUMNS - 1);
    return (struct zr_patch_place){column, (lane - column) >> (ZR_PATCH_COLUMNS == 4 ? 2 : 0),
                                   tile->x + number % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH,
                                   tile->y + number / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT};
}

static inline void zr_shade_block(const struct zr_shader *s, const struct zr_tile *tile, int number, int plane_count,
                                  struct zr_block_pixels *out)
{
    const struct zr_block_parts *block = &s->parts.blocks[number];
    if (block->is_whole) {
        zr_shade_whole_block(s, tile, number, plane_count, out);
        return;
    }
    const struct zr_patch_place place = zr_patch_place_of(tile, number);
    uint32_t part = block->first;
    for (int p = 0; p < ZR_BLOCK_PATCHES; p++) {
        const int32_t x = p % ZR_PATCHES_ACROSS * ZR_PATCH_COLUMNS, y = p / ZR_PATCHES_ACROSS * ZR_PATCH_ROWS;
        const uint32_t count = block->patches[p];
        const zr_vi owner = zr_vi_load_patch(tile->owner + zr_patch_first(number, p), ZR_TILE_STRIDE);
        const zr_vf fx = zr_vf_of(place.column + zr_vi_set(place.left + x));
        const zr_vf fy = zr_vf_of(place.row + zr_vi_set(place.low + y));
        zr_vi_store_patch(&out->pixels[y][x], ZR_BLOCK_WIDTH, zr_shade_at(s, part, count, owner, fx, fy, plane_count));
        part += count;
    }
}
_Static_assert(ZR_PATCH_COLUMNS == 4 || ZR_LANES == 1, "rows are a shift");

/* ---- to the picture ---- */

/* Where nobody is seen, what is behind. */
static inline void zr_block_put_behind(const struct zr_tile *tile, int number, const struct zr_pixel_rows *behind,
                                       struct zr_block_pixels *out)
{
    const uint32_t *owners = &tile->owner[zr_block_first(number)], *from = behind->first;
    const int32_t left = number % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH, low = number / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT;
    for (int32_t y = 0; y < ZR_BLOCK_HEIGHT && low + y < tile->height; y++)
        for (int32_t x = 0; x < ZR_BLOCK_WIDTH && left + x < tile->width; x++)
            if (owners[y * ZR_TILE_STRIDE + x] == 0) out->pixels[y][x] = from[(low + y) * behind->stride + left + x];
}

static inline void zr_block_put_known(const struct zr_tile *tile, int number, struct zr_block_pixels *out)
{
    const uint32_t *known = &tile->words[zr_block_first(number)];
    for (int y = 0; y < ZR_BLOCK_HEIGHT; y++, known += ZR_TILE_STRIDE)
        for (int x = 0; x < ZR_BLOCK_WIDTH; x += ZR_LANES) {
            const zr_vi color = zr_vi_load(known + x);
            const zr_vm unknown = zr_vi_eq(color, zr_vi_set(0));
            zr_vi_store(&out->pixels[y][x], zr_vi_select(unknown, zr_vi_load(&out->pixels[y][x]), color));
        }
}

/* The part of the block that lies in the window. */
static inline void zr_block_put(const struct zr_tile *tile, int number, const struct zr_block_pixels *block,
                                const struct zr_pixel_rows *out)
{
    const int32_t left = number % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH, low = number / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT;
    const int32_t columns = tile->width - left < ZR_BLOCK_WIDTH ? tile->width - left : ZR_BLOCK_WIDTH;
    uint32_t *to = out->first + low * out->stride + left;
    for (int32_t y = 0; y < ZR_BLOCK_HEIGHT && low + y < tile->height; y++, to += out->stride) {
        int32_t x = 0;
        for (; x + ZR_LANES <= columns; x += ZR_LANES)
            zr_vi_put(to + x, zr_vi_load(&block->pixels[y][x]), out->streamed);
        if (x < columns) zr_vi_store_first(to + x, zr_vi_load(&block->pixels[y][x]), (uint32_t)(columns - x));
    }
}

static inline void zr_finish_block(const struct zr_shader *s, const struct zr_tile *tile, int number, bool with_known,
                                   int plane_count, const struct zr_pixel_rows *behind, const struct zr_pixel_rows *out)
{
    struct zr_block_pixels block;
    zr_shade_block(s, tile, number, plane_count, &block);
    if (with_known) zr_block_put_known(tile, number, &block);
    if (behind) zr_block_put_behind(tile, number, behind, &block);
    zr_block_put(tile, number, &block, out);
}

/* Blocks begin .. end - 1 of a channel, whose parts have been made. */
static inline void zr_finish_blocks(const struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                    bool with_known, int plane_count, const struct zr_pixel_rows *behind,
                                    const struct zr_pixel_rows *out)
{
    const int across = (tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    for (int b = begin; b < end; b++)
        if (b % ZR_BLOCK_COLUMNS < across) zr_finish_block(s, tile, b, with_known, plane_count, behind, out);
}

#endif
