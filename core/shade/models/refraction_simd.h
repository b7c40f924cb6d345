/* refraction_simd.h - shade: light of the backdrop (backdrop.h) that passes through glass, for kernels.
 *
 * Path:   a ray to the eye is refracted by the normal and runs on for the material's thickness t. It ends at a point
 *         whose place in the window is looked up: between texels, and between levels, by log2 of the picture's smaller
 *         side times roughness times min(2 ior - 2, 1). Beyond the window is its border.
 * Colour: base colour times c^(t/d), for the attenuation's colour c and distance d. With dispersion, red and blue have
 *         the index of refraction ior -+ 0.025 dispersion (ior - 1).
 * Source: KHR_materials_volume, KHR_materials_dispersion, and the sample renderer of Khronos.
 */
#ifndef ZR_REFRACTION_SIMD_H
#define ZR_REFRACTION_SIMD_H

#include "base/simd/pow_simd.h"
#include "shade/lights/backdrop.h"
#include "shade/models/glass_simd.h"

/* ---- the backdrop ---- */

/* Texels around a place in one level, for each lane. */
struct zr_backdrop_place_v {
    zr_vi columns[2], rows[2]; /* rows: numbers of their first texels */
    zr_vf across, up;
};

/* Finds both texels along one side of `count` of a level; at: in texels. */
static inline zr_vf zr_backdrop_pair_v(zr_vf at, zr_vi count, zr_vi out[2])
{
    const zr_vi next = zr_vi_round(at), none = zr_vi_set(0), one = zr_vi_set(1);
    out[0] = zr_vi_min(zr_vi_max(next - one, none), count - one);
    out[1] = zr_vi_min(zr_vi_max(next, none), count - one);
    return at + zr_vf_set(0.5f) - zr_vf_of(next);
}

static inline struct zr_vec3_v zr_backdrop_level_v(const struct zr_backdrop *backdrop, zr_vi level, const zr_vf at[2])
{
    const zr_vf smaller = zr_vf_bits((zr_vi_set(127) - level) << 23);
    const zr_vi width = zr_vi_gather(ZR_ALL_LANES, backdrop->width, level),
                height = zr_vi_gather(ZR_ALL_LANES, backdrop->height, level),
                first = zr_vi_gather(ZR_ALL_LANES, backdrop->first, level);
    zr_vi columns[2], rows[2];
    const zr_vf across = zr_backdrop_pair_v(at[0] * smaller, width, columns),
                up = zr_backdrop_pair_v(at[1] * smaller, height, rows);
    struct zr_vec3_v mixed[2];
    for (int k = 0; k < 2; k++) {
        const zr_vi row = first + rows[k] * width;
        struct zr_vec3_v left, right;
        zr_vf_gather_fours(backdrop->texels, row + columns[0], &left.x, &left.y, &left.z);
        zr_vf_gather_fours(backdrop->texels, row + columns[1], &right.x, &right.y, &right.z);
        mixed[k] = zr_mix3_v(left, right, across);
    }
    return zr_mix3_v(mixed[0], mixed[1], up);
}

/* Looks up the place `at`, in pixels, at a fraction of levels. */
static inline struct zr_vec3_v zr_backdrop_at_v(const struct zr_backdrop *backdrop, const zr_vf at[2], zr_vf level)
{
    const zr_vi last = zr_vi_set(backdrop->level_count - 1), none = zr_vi_set(0);
    const zr_vi low = zr_vi_min(zr_vi_max(zr_vi_round(level - zr_vf_set(0.5f)), none), last);
    const zr_vf share = zr_clamp01_v(level - zr_vf_of(low));
    return zr_mix3_v(zr_backdrop_level_v(backdrop, low, at),
                     zr_backdrop_level_v(backdrop, zr_vi_min(low + zr_vi_set(1), last), at), share);
}

/* Projects points to pixels within the window; those at the eye or behind it go to a corner. */
static inline void zr_backdrop_place_v(const struct zr_backdrop *backdrop, struct zr_vec3_v p, zr_vf out[2])
{
    const float(*rows)[4] = backdrop->to_window;
    const float sides[2] = {(float)backdrop->width[0], (float)backdrop->height[0]};
    zr_vf sums[3];
    for (int k = 0; k < 3; k++)
        sums[k] = zr_vf_set(rows[k][0]) * p.x + zr_vf_set(rows[k][1]) * p.y + zr_vf_set(rows[k][2]) * p.z +
                  zr_vf_set(rows[k][3]);
    for (int k = 0; k < 2; k++)
        out[k] =
            zr_vf_min(zr_vf_max(sums[k] / zr_vf_max(sums[2], zr_vf_set(1e-30f)), zr_vf_set(0.0f)), zr_vf_set(sides[k]));
}

/* ---- refraction ---- */

/* Returns the light that arrives along the ray that is refracted by `ior`. thickness: of the volume. */
static inline struct zr_vec3_v zr_refracted_v(const struct zr_backdrop *backdrop, const struct zr_shading_v *s,
                                              float ior, zr_vf thickness)
{
    const float eta = 1.0f / ior, blur = 2.0f * ior - 2.0f;
    const zr_vf one = zr_vf_set(1.0f), nv = zr_clamp01_v(zr_dot_v(s->normal, s->to_eye));
    const zr_vf inside = zr_vf_sqrt(one - zr_vf_set(eta * eta) * (one - nv * nv));
    const struct zr_vec3_v way =
        zr_minus_v(zr_scale_v(s->normal, zr_vf_set(eta) * nv - inside), zr_scale_v(s->to_eye, zr_vf_set(eta)));
    zr_vf at[2];
    zr_backdrop_place_v(backdrop, zr_add_v(s->point, zr_scale_v(way, thickness)), at);
    return zr_backdrop_at_v(backdrop, at,
                            s->textured->roughness * zr_vf_set(backdrop->roughest * (blur < 1.0f ? blur : 1.0f)));
}

/* Returns the light that arrives through glass whose rays have the length `thickness`. */
static inline struct zr_vec3_v zr_dispersed_v(const struct zr_backdrop *backdrop, const struct zr_finish *finish,
                                              const struct zr_shading_v *s, zr_vf thickness)
{
    const float apart = 0.025f * finish->dispersion * (finish->ior - 1.0f), red = finish->ior - apart;
    struct zr_vec3_v light = zr_refracted_v(backdrop, s, finish->ior, thickness);
    if (!(apart > 0.0f)) return light;
    light.x = zr_refracted_v(backdrop, s, red > 1.0f ? red : 1.0f, thickness).x;
    light.z = zr_refracted_v(backdrop, s, finish->ior + apart, thickness).z;
    return light;
}

#endif
