/* blocks_simd.h - shade: from parts to pixels of four bytes, a block of the tile at a time, for the kernel that shades.
 */
#ifndef ZR_BLOCKS_SIMD_H
#define ZR_BLOCKS_SIMD_H

#include "base/rgba_simd.h"
#include "raster/tile_simd.h"
#include "shade/shader_simd.h"
#include "shade/texture_simd.h"

/* Set by the kernel that has textures: where they only depend on plane_count, compilers find what is left too large to
 * be inlined (a twentieth of phong's time). */
#ifndef ZR_WITH_TEXTURES
#define ZR_WITH_TEXTURES false
#endif

/* ---- pixels ---- */

/* What `count` parts from `first` on show in a patch. Some that follow are looked at with them, since the processor
 * cannot foretell how many there are (a twentieth of the flat bunny's time). They are other owners', or have the same
 * word, but for pixels whose words the tile knows, which are put over these. Behind the last part there is nobody. */
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

/* A pixel's place in a texture. GL's fixed functions divide by the fourth coordinate, too, which is 1 at all corners
 * and, rounded, not always in between; programs, as phong's, do not. */
struct zr_texture_place_v {
    zr_vf s, t;
};

static inline struct zr_texture_place_v zr_texture_place_of(zr_vf (*planes)[3], bool is_projected, zr_vf x, zr_vf y)
{
    const zr_vf one = zr_vf_set(1.0f), oow = zr_shaded_value(planes, 0, x, y), w = one / oow;
    const zr_vf s = zr_shaded_value(planes, 1 + ZR_VALUES_FOG, x, y) * w,
                t = zr_shaded_value(planes, 2 + ZR_VALUES_FOG, x, y) * w;
    if (!is_projected) return (struct zr_texture_place_v){s, t};
    const zr_vf over_q = one / (oow * w);
    return (struct zr_texture_place_v){s * over_q, t * over_q};
}

/* How far the places of pixels are from one to the next, as the reference has it: in each quad of 2x2 from its lowest
 * row and its left column, for all four alike. */
static inline zr_vf zr_rho_of_quads_v(const struct zr_texture_map *map, zr_vf (*planes)[3], bool is_projected, zr_vf x,
                                      zr_vf y)
{
    const zr_vf half = zr_vf_set(0.5f), two = zr_vf_set(2.0f), one = zr_vf_set(1.0f);
    const zr_vf left = zr_floor_v(x * half) * two, low = zr_floor_v(y * half) * two;
    const struct zr_texture_place_v at = zr_texture_place_of(planes, is_projected, left, low),
                                    right = zr_texture_place_of(planes, is_projected, left + one, low),
                                    above = zr_texture_place_of(planes, is_projected, left, low + one);
    return zr_rho_squared_v(map, right.s - at.s, right.t - at.t, above.s - at.s, above.t - at.t);
}

static inline struct zr_vec3_v zr_textured_v(const struct zr_texture_map *map, const struct zr_material *material,
                                             struct zr_vec3_v color, zr_vf (*planes)[3], zr_vf x, zr_vf y)
{
    const bool is_projected = material->shading != ZR_SHADING_PHONG;
    const struct zr_texture_place_v at = zr_texture_place_of(planes, is_projected, x, y);
    zr_vf rho = zr_vf_set(0.0f);
    if (zr_texture_needs_rho(map)) rho = zr_rho_of_quads_v(map, planes, is_projected, x, y);
    return zr_mul_v(color, zr_texture_color_v(map, at.s, at.t, rho, true));
}

/* Pixels of parts that are shaded late take their model's colour; the others stay. */
static inline zr_vi zr_shade_late(const struct zr_shader *s, uint32_t first, uint32_t count, zr_vi owner,
                                  zr_vf (*planes)[3], zr_vf x, zr_vf y, int plane_count, zr_vi words)
{
    const bool has_constants = plane_count > 1 + ZR_VALUES_LATE,
               has_textures = ZR_WITH_TEXTURES && plane_count > 1 + ZR_VALUES_FOG;
    const bool in_fog = has_textures ? s->surfaces->fog.is_on : has_constants;
    const zr_vf one = zr_vf_set(1.0f), w = one / zr_shaded_value(planes, 0, x, y);
    zr_vf color_w = w;
    for (uint32_t i = first; has_constants && i < first + count; i++)
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
        struct zr_model_inputs of_material = in;
        const struct zr_texture_map *map =
            has_textures ? zr_texture_map_of(&s->surfaces->textures, material, ZR_TEXTURE_BASE_COLOR) : NULL;
        if (map) of_material.color = zr_textured_v(map, material, in.color, planes, x, y);
        struct zr_vec3_v color = zr_model_color(&s->model, material, &of_material);
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
    zr_vi words = zr_vi_set((int32_t)s->words[0]);
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

/* ---- to the picture ---- */

/* Where pixels of a tile go. */
struct zr_store {
    const struct zr_tile *tile;
    bool with_known;                    /* words that the tile knows come first */
    const struct zr_pixel_rows *behind; /* where nobody is seen, what is behind; or NULL */
    const struct zr_pixel_rows *out;
};

static inline zr_vi zr_known_or(const struct zr_tile *tile, int32_t at, zr_vi words)
{
    const zr_vi known = zr_vi_load(tile->words + at);
    return zr_vi_select(zr_vi_eq(known, zr_vi_set(0)), words, known);
}

static inline zr_vi zr_behind_or(const struct zr_tile *tile, int32_t at, const uint32_t *behind, int32_t columns,
                                 zr_vi words)
{
    uint32_t pixels[ZR_LANES] = {0};
    memcpy(pixels, behind, sizeof *pixels * (size_t)(columns < ZR_LANES ? columns : ZR_LANES));
    return zr_vi_select(zr_vi_eq(zr_vi_load(tile->owner + at), zr_vi_set(0)), zr_vi_load(pixels), words);
}

/* ZR_LANES pixels of a row, from x, y of the tile on; what lies outside of the window is left out. */
static inline void zr_store_pixels(const struct zr_store *to, int32_t x, int32_t y, zr_vi words)
{
    const int32_t columns = to->tile->width - x, at = y * ZR_TILE_STRIDE + x;
    if (y >= to->tile->height || columns <= 0) return;
    if (to->with_known) words = zr_known_or(to->tile, at, words);
    if (to->behind) words = zr_behind_or(to->tile, at, to->behind->first + y * to->behind->stride + x, columns, words);
    uint32_t *out = to->out->first + y * to->out->stride + x;
    if (columns >= ZR_LANES)
        zr_vi_put(out, words, to->out->streamed);
    else
        zr_vi_store_first(out, words, (uint32_t)columns);
}

/* ---- a block ---- */

/* Its first column and row, in the tile. */
static inline int32_t zr_block_left(int block)
{
    return block % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH;
}

static inline int32_t zr_block_low(int block)
{
    return block / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT;
}

/* Whether its pixels go to the picture as they are. */
static inline bool zr_block_is_plain(const struct zr_store *to, int block)
{
    return !to->with_known && !to->behind && zr_block_left(block) + ZR_BLOCK_WIDTH <= to->tile->width &&
           zr_block_low(block) + ZR_BLOCK_HEIGHT <= to->tile->height;
}

/* All pixels of a block. */
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

/* All pixels of a block, whose colour is planes of 1/w and of red, green and blue over that. */
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

/* All of one part's, who is shaded late. */
static inline void zr_store_late(const struct zr_shader *s, int block, int plane_count, const struct zr_store *to)
{
    const uint32_t part = s->parts.blocks[block].first;
    const zr_vi owner = zr_vi_set((int32_t)s->parts.owners[part]);
    const int32_t left = zr_block_left(block), low = zr_block_low(block);
    zr_vf planes[1 + ZR_VALUES_MOST][3], y = zr_vf_set((float)(to->tile->y + low));
    zr_select_planes(s, part, 1, owner, plane_count, planes);
    for (int32_t row = 0; row < ZR_BLOCK_HEIGHT; row++, y = y + zr_vf_set(1.0f))
        for (int32_t column = 0; column < ZR_BLOCK_WIDTH; column += ZR_LANES) {
            const zr_vf x = zr_vf_of(zr_vi_set(to->tile->x + left + column) + zr_vi_ramp());
            const zr_vi words = zr_vi_set(0); /* all are replaced */
            zr_store_pixels(to, left + column, low + row,
                            zr_shade_late(s, part, 1, owner, planes, x, y, plane_count, words));
        }
}

/* All of one part's. */
static inline void zr_store_whole_block(const struct zr_shader *s, int block, int plane_count,
                                        const struct zr_store *to)
{
    const uint32_t part = s->parts.blocks[block].first;
    if (!s->has_planes[part])
        zr_store_alike(to, block, zr_vi_set((int32_t)s->words[part]));
    else if (plane_count > 1 + ZR_VALUES_FEW && s->materials[part])
        zr_store_late(s, block, plane_count, to);
    else
        zr_store_smooth(to, block, &s->planes[part * (uint32_t)plane_count]);
}

/* Where the patches of a block lie. */
struct zr_patch_place {
    zr_vi column, row; /* of each lane in its patch */
    int32_t left, low; /* of the block, in the window */
};

static inline struct zr_patch_place zr_patch_place_of(const struct zr_tile *tile, int number)
{
    const zr_vi lane = zr_vi_ramp(), column = lane & zr_vi_set(ZR_PATCH_COLUMNS - 1);
    return (struct zr_patch_place){column, (lane - column) >> (ZR_PATCH_COLUMNS == 4 ? 2 : 0),
                                   tile->x + zr_block_left(number), tile->y + zr_block_low(number)};
}
_Static_assert(ZR_PATCH_COLUMNS == 4 || ZR_LANES == 1, "rows are a shift");

/* Patch by patch, as many side by side as make whole rows of ZR_LANES. */
static inline void zr_store_patches(const struct zr_shader *s, int number, int plane_count, const struct zr_store *to)
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
            rows[k] = zr_shade_at(s, part, count, owner, fx, fy, plane_count);
            part += count;
        }
        zr_vi_rows_of_patches(rows);
        for (int k = 0; k < ZR_PATCH_ROWS; k++)
            zr_store_pixels(to, place.left - to->tile->x + x, place.low - to->tile->y + y + k, rows[k]);
    }
}

/* Blocks begin .. end - 1 of a channel, whose parts have been made. */
static inline void zr_store_blocks(const struct zr_shader *s, const struct zr_store *to, int begin, int end,
                                   int plane_count)
{
    const int across = (to->tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    for (int b = begin; b < end; b++) {
        if (b % ZR_BLOCK_COLUMNS >= across) continue;
        if (s->parts.blocks[b].is_whole)
            zr_store_whole_block(s, b, plane_count, to);
        else
            zr_store_patches(s, b, plane_count, to);
    }
}

#endif
