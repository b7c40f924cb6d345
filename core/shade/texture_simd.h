/* texture_simd.h - shade: samples textures at ZR_LANES points, for kernels.
 *
 * Exact:  for 8-bit images, equal to the last bit to Mesa's llvmpipe when it samples in floats
 *         (tests/reference/RULES.md, rule 31): coordinates times the size of the level, then wrapped; a + t (b - a),
 *         along u first.
 */
#ifndef ZR_TEXTURE_SIMD_H
#define ZR_TEXTURE_SIMD_H

#include "base/inlined.h"
#include "base/mutant.h"
#include "base/simd/lookup_simd.h"
#include "base/simd/pow_simd.h"
#include "base/simd/simd.h"
#include "base/simd/whole_simd.h"
#include "base/vec3_simd.h"
#include "shade/texture_maps.h"

/* ---- one axis ---- */

/* Two neighbouring texels, and the weight of the second: 0 at the first one's centre, 1 at its own. */
struct zr_taps_v {
    zr_vi low, high;
    zr_vf share;
};

/* Converts a whole float to a texel number, clamped to 0..last. */
static inline zr_vi zr_texel_number_v(zr_vf whole, float last)
{
    return zr_vi_round(zr_vf_min(zr_vf_max(whole, zr_vf_set(0.0f)), zr_vf_set(last)));
}

static inline bool zr_is_power_of_2(uint32_t size)
{
    return (size & (size - 1)) == 0;
}

/* Returns a whole float modulo a power of 2. */
static inline zr_vf zr_modulo_v(zr_vf whole, float size)
{
    return whole - zr_floor_v(whole * zr_vf_set(1.0f / size)) * zr_vf_set(size);
}

/* Returns s with every other unit mirrored: 0 .. 1. */
static inline zr_vf zr_mirrored_v(zr_vf s)
{
    const zr_vf half = s * zr_vf_set(0.5f), rest = half - zr_nearest_v(half);
    return zr_vf_abs(rest + rest);
}

static inline zr_vf zr_fraction_v(zr_vf s)
{
    return s - zr_floor_v(s);
}

static inline zr_vi zr_nearest_texel_v(enum zr_wrap wrap, uint32_t size, zr_vf s)
{
    const zr_vf length = zr_vf_set((float)size), below_1 = zr_vf_set(0.99999994f);
    const float last = (float)(size - 1);
    if (wrap == ZR_WRAP_CLAMP) return zr_texel_number_v(zr_floor_v(s * length), last);
    if (wrap == ZR_WRAP_MIRROR) return zr_texel_number_v(zr_floor_v(zr_mirrored_v(s) * length), last);
    if (zr_is_power_of_2(size)) return zr_texel_number_v(zr_modulo_v(zr_floor_v(s * length), (float)size), last);
    return zr_texel_number_v(zr_floor_v(zr_vf_min(zr_fraction_v(s), below_1) * length), last);
}

/* Returns the distance from a texel's corner to its centre. */
static inline zr_vf zr_half_texel_v(void)
{
    return zr_vf_set(ZR_MUTANT(texels_from_corners, 0.5f, 0.0f));
}

static inline struct zr_taps_v zr_repeated_taps_v(uint32_t size, zr_vf s)
{
    const zr_vf length = zr_vf_set((float)size), half = zr_half_texel_v(), zero = zr_vf_set(0.0f);
    const zr_vi last = zr_vi_set((int32_t)size - 1), none = zr_vi_set(0);
    const bool is_even = zr_is_power_of_2(size);
    const zr_vf at = (is_even ? s : zr_fraction_v(s)) * length - half, whole = zr_floor_v(at);
    const zr_vf wrapped = is_even ? zr_modulo_v(whole, (float)size)
                                  : zr_vf_select(zr_vf_lt(whole, zero), length - zr_vf_set(1.0f), whole);
    const zr_vi low = zr_texel_number_v(wrapped, (float)(size - 1));
    return (struct zr_taps_v){low, zr_vi_select(zr_vi_eq(low, last), none, low + zr_vi_set(1)), at - whole};
}

static inline struct zr_taps_v zr_taps_of(enum zr_wrap wrap, uint32_t size, zr_vf s)
{
    const zr_vf length = zr_vf_set((float)size), half = zr_half_texel_v();
    const float last = (float)(size - 1);
    if (wrap == ZR_WRAP_REPEAT) return zr_repeated_taps_v(size, s);
    zr_vf at = zr_vf_min((wrap == ZR_WRAP_MIRROR ? zr_mirrored_v(s) : s) * length, length) - half;
    if (wrap == ZR_WRAP_CLAMP) at = zr_vf_max(at, zr_vf_set(0.0f));
    const zr_vf whole = zr_floor_v(at);
    return (struct zr_taps_v){zr_texel_number_v(whole, last), zr_texel_number_v(whole + zr_vf_set(1.0f), last),
                              at - whole};
}

/* ---- texels ---- */

static inline zr_vf zr_texel_value_v(const struct zr_texture_map *map, zr_vi value)
{
    if (map->decoded && map->bits == 8) return zr_vf_lookup_256(map->decoded, value);
    if (map->decoded) return zr_vf_bits(zr_vi_gather(ZR_ALL_LANES, map->decoded, value));
    return zr_vf_of(value) * zr_vf_set(map->bits == 8 ? 1.0f / 255.0f : 1.0f / 65535.0f);
}

/* Returns byte k or 16-bit half k of words, in memory order. */
static inline zr_vi zr_word_part_v(zr_vi word, int k, int bits)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    const int shift = k * bits;
#else
    const int shift = 32 - bits - k * bits;
#endif
    return (shift ? word >> shift : word) & zr_vi_set((1 << bits) - 1);
}

/* Returns the colour of a texel of 8 bits. */
static inline struct zr_vec3_v zr_texel_of_word_v(const struct zr_texture_map *map, zr_vi word)
{
    return (struct zr_vec3_v){zr_texel_value_v(map, zr_word_part_v(word, 0, 8)),
                              zr_texel_value_v(map, zr_word_part_v(word, 1, 8)),
                              zr_texel_value_v(map, zr_word_part_v(word, 2, 8))};
}

static inline struct zr_vec3_v zr_texel_v(const struct zr_texture_map *map, const struct zr_texture_level *level,
                                          zr_vi x, zr_vi y)
{
    const zr_vi number = y * zr_vi_set((int32_t)level->width) + x;
    if (map->bits == 8) return zr_texel_of_word_v(map, zr_vi_gather(ZR_ALL_LANES, level->texels, number));
    const zr_vi first = zr_vi_gather(ZR_ALL_LANES, level->texels, number + number);
    const zr_vi second = zr_vi_gather(ZR_ALL_LANES, level->texels, number + number + zr_vi_set(1));
    return (struct zr_vec3_v){zr_texel_value_v(map, zr_word_part_v(first, 0, 16)),
                              zr_texel_value_v(map, zr_word_part_v(first, 1, 16)),
                              zr_texel_value_v(map, zr_word_part_v(second, 0, 16))};
}

static inline struct zr_vec3_v zr_lerp3_v(struct zr_vec3_v a, struct zr_vec3_v b, zr_vf share)
{
    return (struct zr_vec3_v){a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
}

/* Texels around ZR_LANES points, for bilinear sampling. */
struct zr_footprint_v {
    struct zr_taps_v x, y;
    bool has_pairs; /* high is low + 1 along x: the usual case, but for those at a seam */
    bool is_boxed;  /* has_pairs, and all texels lie in a box of ZR_PATCH_COLUMNS x ZR_PATCH_ROWS */
    size_t first;   /* number of the box's first texel in the level */
    zr_vi boxed[2]; /* number in the box of the texels at x.low in the rows y.low and y.high */
};

/* A box replaces gathers, and its texels are decoded once. With textures of 512 x 512, the helmet of `make bench-looks`
 * takes a sixth less. Boxes of 8 x 8 beside them save nothing. */
enum { ZR_HAS_BOXES = ZR_PATCH_ROWS >= 4 };

/* Looks for the box. The points are a patch or a row, in a plane or nearly so: the least texel is that of a corner. */
static inline void zr_find_box(const struct zr_texture_level *level, struct zr_footprint_v *out)
{
    enum { COLUMNS = ZR_PATCH_COLUMNS, ROWS = ZR_PATCH_ROWS };
    int32_t x[ZR_LANES], y[ZR_LANES];
    zr_vi_store(x, out->x.low);
    zr_vi_store(y, out->y.low);
    int32_t left = (int32_t)level->width - COLUMNS, low = (int32_t)level->height - ROWS;
    if (left < 0 || low < 0) return;
    for (int k = 0; k < 4; k++) {
        const int corner = (k & 1 ? COLUMNS - 1 : 0) + (k & 2 ? ZR_LANES - COLUMNS : 0);
        left = x[corner] < left ? x[corner] : left;
        low = y[corner] < low ? y[corner] : low;
    }
    const zr_vi column = out->x.low - zr_vi_set(left), one = zr_vi_set(1);
    const zr_vi row[2] = {out->y.low - zr_vi_set(low), out->y.high - zr_vi_set(low)};
    const zr_vi beyond = (column | (column + one) | row[0] | row[1]) & zr_vi_set(~(COLUMNS - 1));
    out->is_boxed = zr_vm_bits(zr_vi_eq(beyond, zr_vi_set(0))) == ZR_ALL_BITS;
    out->first = (size_t)low * level->width + (size_t)left;
    for (int k = 0; k < 2; k++)
        out->boxed[k] = row[k] * zr_vi_set(COLUMNS) + column;
}

static inline struct zr_footprint_v zr_footprint_of(const struct zr_texture_map *map,
                                                    const struct zr_texture_level *level, zr_vf s, zr_vf t)
{
    struct zr_footprint_v out = {.x = zr_taps_of(map->texture->wrap_s, level->width, s),
                                 .y = zr_taps_of(map->texture->wrap_t, level->height, t)};
    out.has_pairs = zr_vm_bits(zr_vi_eq(out.x.high, out.x.low + zr_vi_set(1))) == ZR_ALL_BITS;
    if (ZR_HAS_BOXES && out.has_pairs) zr_find_box(level, &out);
    return out;
}

static inline struct zr_vec3_v zr_pick3_v(struct zr_vec3_v v, zr_vi i)
{
    return (struct zr_vec3_v){zr_vf_pick(v.x, i), zr_vf_pick(v.y, i), zr_vf_pick(v.z, i)};
}

/* Returns the bilinear sample of texels in a box. */
static inline struct zr_vec3_v zr_sample_box_v(const struct zr_texture_map *map, const struct zr_texture_level *level,
                                               const struct zr_footprint_v *at)
{
    const uint32_t *texels = (const uint32_t *)level->texels + at->first;
    const struct zr_vec3_v box = zr_texel_of_word_v(map, zr_vi_load_patch(texels, level->width));
    struct zr_vec3_v rows[2];
    for (int k = 0; k < 2; k++)
        rows[k] = zr_lerp3_v(zr_pick3_v(box, at->boxed[k]), zr_pick3_v(box, at->boxed[k] + zr_vi_set(1)), at->x.share);
    return zr_lerp3_v(rows[0], rows[1], at->y.share);
}

/* Returns the mix of two neighbouring texels of a row. */
static inline struct zr_vec3_v zr_sample_row_v(const struct zr_texture_map *map, const struct zr_texture_level *level,
                                               const struct zr_footprint_v *at, zr_vi y)
{
    zr_vi low, high;
    if (map->bits != 8 || !at->has_pairs)
        return zr_lerp3_v(zr_texel_v(map, level, at->x.low, y), zr_texel_v(map, level, at->x.high, y), at->x.share);
    zr_vi_gather_pairs(level->texels, y * zr_vi_set((int32_t)level->width) + at->x.low, &low, &high);
    return zr_lerp3_v(zr_texel_of_word_v(map, low), zr_texel_of_word_v(map, high), at->x.share);
}

static inline struct zr_vec3_v zr_sample_linear_v(const struct zr_texture_map *map,
                                                  const struct zr_texture_level *level, const struct zr_footprint_v *at)
{
    if (ZR_HAS_BOXES && at->is_boxed && map->bits == 8) return zr_sample_box_v(map, level, at);
    return zr_lerp3_v(zr_sample_row_v(map, level, at, at->y.low), zr_sample_row_v(map, level, at, at->y.high),
                      at->y.share);
}

/* ---- maps of one place ---- */

/* Maps with the same `place`, which are sampled at the same points. */
struct zr_alike_maps {
    const struct zr_texture_map *of[ZR_TEXTURE_SLOTS];
    int count;
};

/* Samples a level of each map. Only lanes of `where` are written. */
static inline void zr_sample_level_v(const struct zr_alike_maps *maps, uint32_t number, bool linear, zr_vf s, zr_vf t,
                                     zr_vm where, struct zr_vec3_v *out)
{
    const struct zr_texture_map *first = maps->of[0];
    const struct zr_texture_level *level = &first->levels[number];
    if (!linear) {
        const zr_vi x = zr_nearest_texel_v(first->texture->wrap_s, level->width, s),
                    y = zr_nearest_texel_v(first->texture->wrap_t, level->height, t);
        for (int i = 0; i < maps->count; i++)
            out[i] = zr_choose_v(where, zr_texel_v(maps->of[i], &maps->of[i]->levels[number], x, y), out[i]);
        return;
    }
    const struct zr_footprint_v at = zr_footprint_of(first, level, s, t);
    for (int i = 0; i < maps->count; i++) {
        const struct zr_texture_map *map = maps->of[i];
        out[i] = zr_choose_v(where, zr_sample_linear_v(map, &map->levels[number], &at), out[i]);
    }
}

/* Samples each lane at its own level. Usually the lanes have one or two. */
static inline void zr_sample_levels_v(const struct zr_alike_maps *maps, zr_vi numbers, bool linear, zr_vf s, zr_vf t,
                                      struct zr_vec3_v *out)
{
    uint32_t each[ZR_LANES], left = ZR_ALL_BITS;
    zr_vi_store(each, numbers);
    while (left) {
        const uint32_t number = each[zr_lowest_bit(left)];
        const zr_vm of_it = zr_vi_eq(numbers, zr_vi_set((int32_t)number));
        zr_sample_level_v(maps, number, linear, s, t, of_it, out);
        left &= ~zr_vm_bits(of_it);
    }
}

/* ---- filters ---- */

/* Returns the squared length of a pixel's step in texels of the largest level: the longer of the steps along x and
 * y. */
static inline zr_vf zr_rho_squared_v(const struct zr_texture_map *map, zr_vf s_x, zr_vf t_x, zr_vf s_y, zr_vf t_y)
{
    const zr_vf width = zr_vf_set((float)map->levels[0].width), height = zr_vf_set((float)map->levels[0].height);
    const zr_vf u_x = s_x * width, v_x = t_x * height, u_y = s_y * width, v_y = t_y * height;
    return zr_vf_max(u_x * u_x + v_x * v_x, u_y * u_y + v_y * v_y);
}

/* Returns true if sampling depends on rho. */
static inline bool zr_texture_needs_rho(const struct zr_texture_map *map)
{
    return map->texture->minify != map->texture->magnify;
}

/* Returns log2 of rho, clamped to a range beyond all levels. as_mesa: Mesa's piecewise linear logarithm. */
static inline zr_vf zr_lod_v(zr_vf rho_squared, bool as_mesa)
{
    const zr_vf square = zr_vf_min(zr_vf_max(rho_squared, zr_vf_set(1e-9f)), zr_vf_set(1e18f));
    const zr_vi bits = zr_vi_bits_of(square);
    const zr_vf mantissa = zr_vf_bits((bits & zr_vi_set(0x7fffff)) | zr_vi_set(0x3f800000));
    const zr_vf line = zr_vf_of((bits >> 23) - zr_vi_set(128)) + mantissa;
    const zr_vf lod = (as_mesa ? line : zr_log2_v(square)) * zr_vf_set(0.5f);
    return ZR_MUTANT(levels_half_off, lod, lod + zr_vf_set(0.5f));
}

static inline void zr_sample_minified_v(const struct zr_alike_maps *maps, zr_vf lod, zr_vf s, zr_vf t,
                                        struct zr_vec3_v *out)
{
    const enum zr_filter filter = maps->of[0]->texture->minify;
    const bool linear = zr_filter_is_linear(filter);
    const zr_vf last = zr_vf_set((float)(maps->of[0]->level_count - 1)), zero = zr_vf_set(0.0f);
    const zr_vf kept = zr_vf_min(zr_vf_max(lod, zero), last);
    if (!zr_filter_has_levels(filter)) {
        zr_sample_level_v(maps, 0, linear, s, t, ZR_ALL_LANES, out);
        return;
    }
    if (filter == ZR_FILTER_NEAREST_MIPMAP_NEAREST || filter == ZR_FILTER_LINEAR_MIPMAP_NEAREST) {
        zr_sample_levels_v(maps, zr_vi_round(zr_floor_v(kept + zr_vf_set(0.5f))), linear, s, t, out);
        return;
    }
    const zr_vf whole = zr_floor_v(kept), share = kept - whole;
    const zr_vi low = zr_vi_round(whole), high = zr_vi_min(low + zr_vi_set(1), zr_vi_round(last));
    zr_sample_levels_v(maps, low, linear, s, t, out);
    if (!zr_vm_any(zr_vf_lt(zero, share))) return;
    struct zr_vec3_v coarse[ZR_TEXTURE_SLOTS] = {0};
    zr_sample_levels_v(maps, high, linear, s, t, coarse);
    for (int i = 0; i < maps->count; i++)
        out[i] = zr_lerp3_v(out[i], coarse[i], share);
}

/* Samples maps at s, t. rho_squared is used only if zr_texture_needs_rho. as_mesa: as in zr_lod_v. Points that do not
 * shrink the image have level 0, also by the filter for smaller ones if both are linear or neither is. */
static inline void zr_texture_colors_v(const struct zr_alike_maps *maps, zr_vf s, zr_vf t, zr_vf rho_squared,
                                       bool as_mesa, struct zr_vec3_v *out)
{
    const struct zr_texture *texture = maps->of[0]->texture;
    const bool linear = zr_filter_is_linear(texture->magnify);
    const zr_vm smaller = zr_vf_lt(zr_vf_set(1.0f), rho_squared);
    if (!zr_texture_needs_rho(maps->of[0]) || !zr_vm_any(smaller)) {
        zr_sample_level_v(maps, 0, linear, s, t, ZR_ALL_LANES, out);
        return;
    }
    const zr_vf lod = zr_vf_select(smaller, zr_lod_v(rho_squared, as_mesa), zr_vf_set(0.0f));
    zr_sample_minified_v(maps, lod, s, t, out);
    if (zr_vm_bits(smaller) != ZR_ALL_BITS && zr_filter_is_linear(texture->minify) != linear)
        zr_sample_level_v(maps, 0, linear, s, t, zr_vm_andnot(ZR_ALL_LANES, smaller), out);
}

#endif
