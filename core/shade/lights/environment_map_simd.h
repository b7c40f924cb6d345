/* environment_map_simd.h - shade: light of an environment image (scene/environment_map.h), ZR_LANES directions at a
 * time, for kernels.
 */
#ifndef ZR_ENVIRONMENT_MAP_SIMD_H
#define ZR_ENVIRONMENT_MAP_SIMD_H

#include "scene/environment_map.h"
#include "shade/lights/tone_simd.h"

/* A level of a map for each lane. */
struct zr_map_level_v {
    zr_vf roughness, side;
    zr_vi first, stride; /* number of its first texel; texels of a row */
};

/* Looks up `numbers`, 0 to ZR_MAP_LEVELS - 1. */
static inline struct zr_map_level_v zr_map_level_v(zr_vi numbers)
{
#define ZR_MAP_ROW(roughness, side, from) {roughness, side},
    static const struct {
        float roughness;
        int32_t side;
    } rows[ZR_MAP_LEVELS] = {ZR_MAP_LEVEL_ROWS(ZR_MAP_ROW)};
#undef ZR_MAP_ROW
    struct zr_map_level_v out = {zr_vf_set(0.0f), zr_vf_set(0.0f), zr_vi_set(0), zr_vi_set(0)};
    int32_t first = 0;
    for (int32_t i = 0; i < ZR_MAP_LEVELS; i++) {
        const zr_vm here = zr_vi_eq(numbers, zr_vi_set(i));
        const int32_t stride = rows[i].side + 2;
        out.roughness = zr_vf_select(here, zr_vf_set(rows[i].roughness), out.roughness);
        out.side = zr_vf_select(here, zr_vf_set((float)rows[i].side), out.side);
        out.first = zr_vi_select(here, zr_vi_set(first), out.first);
        out.stride = zr_vi_select(here, zr_vi_set(stride), out.stride);
        first += stride * stride;
    }
    return out;
}

/* Returns the place of d in an octahedral map, -1 .. 1. */
static inline void zr_octahedral_v(struct zr_vec3_v d, zr_vf out[2])
{
    const zr_vf one = zr_vf_set(1.0f), zero = zr_vf_set(0.0f);
    const zr_vf all = (zr_vf_abs(d.x) + zr_vf_abs(d.y)) + zr_vf_abs(d.z), p = d.x / all, q = d.z / all;
    const zr_vf p_folded = one - zr_vf_abs(q), q_folded = one - zr_vf_abs(p);
    const zr_vm below = zr_vf_lt(d.y, zero);
    out[0] = zr_vf_select(below, zr_vf_select(zr_vf_lt(p, zero), zero - p_folded, p_folded), p);
    out[1] = zr_vf_select(below, zr_vf_select(zr_vf_lt(q, zero), zero - q_folded, q_folded), q);
}

static inline struct zr_vec3_v zr_map_texel_v(const float *map, zr_vi number)
{
    struct zr_vec3_v out;
    zr_vf_gather_fours(map, number, &out.x, &out.y, &out.z);
    return out;
}

/* Returns the light of a level, between the four nearest texels. `place`: that of zr_octahedral_v; NaN is -1. */
static inline struct zr_vec3_v zr_map_light_v(const float *map, const struct zr_map_level_v *level,
                                              const zr_vf place[2])
{
    const zr_vf one = zr_vf_set(1.0f), half = zr_vf_set(0.5f);
    zr_vi texel[2];
    zr_vf share[2];
    for (int k = 0; k < 2; k++) {
        const zr_vf kept = zr_vf_min(zr_vf_max(place[k], zr_vf_set(-1.0f)), one);
        const zr_vf at = (half + half * kept) * level->side; /* in texels, and the border of one less half a texel */
        texel[k] = zr_vi_round(at);
        share[k] = at + half - zr_vf_of(texel[k]);
    }
    const zr_vi number = level->first + texel[1] * level->stride + texel[0], next = number + level->stride;
    const zr_vi right = zr_vi_set(1);
    const struct zr_vec3_v low = zr_mix3_v(zr_map_texel_v(map, number), zr_map_texel_v(map, number + right), share[0]);
    const struct zr_vec3_v high = zr_mix3_v(zr_map_texel_v(map, next), zr_map_texel_v(map, next + right), share[0]);
    return zr_mix3_v(low, high, share[1]);
}

/* Returns L of an image: the levels below and above the roughness. */
static __attribute__((noinline, unused)) struct zr_vec3_v zr_map_gathered_v(const float *map, struct zr_vec3_v d,
                                                                            zr_vf alpha)
{
#define ZR_MAP_ROUGHNESS(roughness, side, from) roughness,
    static const float steps[ZR_MAP_LEVELS] = {ZR_MAP_LEVEL_ROWS(ZR_MAP_ROUGHNESS)};
#undef ZR_MAP_ROUGHNESS
    const zr_vf roughness = zr_vf_sqrt(alpha), one = zr_vf_set(1.0f), zero = zr_vf_set(0.0f);
    zr_vi number = zr_vi_set(0);
    for (int i = 1; i < ZR_MAP_LEVELS - 1; i++)
        number = zr_vi_select(zr_vf_le(zr_vf_set(steps[i]), roughness), zr_vi_set(i), number);
    const struct zr_map_level_v sharp = zr_map_level_v(number), soft = zr_map_level_v(number + zr_vi_set(1));
    zr_vf place[2];
    zr_octahedral_v(d, place);
    const zr_vf share = (roughness - sharp.roughness) / (soft.roughness - sharp.roughness);
    return zr_mix3_v(zr_map_light_v(map, &sharp, place), zr_map_light_v(map, &soft, place),
                     zr_vf_min(zr_vf_max(share, zero), one));
}

#endif
