/* glass_simd.h - shade: how much of the light behind a thin glass passes through it, for kernels.
 *
 * Source: KHR_materials_transmission; Schlick's term, by the normal without the normal map.
 */
#ifndef ZR_GLASS_SIMD_H
#define ZR_GLASS_SIMD_H

#include "shade/models/linear_simd.h"

/* Least opacity, by which colours are divided. */
#define ZR_GLASS_OPACITY_LEAST 0.01f

/* transmission: of the part that is no metal; reflectance at normal and at grazing incidence. */
struct zr_glass_v {
    zr_vf transmission, f0, f90;
};

static inline zr_vf zr_least_of_v(struct zr_vec3_v v)
{
    return zr_vf_min(v.x, zr_vf_min(v.y, v.z));
}

/* Returns transmission (1 - F). */
static inline zr_vf zr_glass_passing_v(const struct zr_glass_v *glass, struct zr_vec3_v normal, struct zr_vec3_v to_eye)
{
    const zr_vf one = zr_vf_set(1.0f), away = zr_clamp01_v(one - zr_dot_v(normal, to_eye)), square = away * away;
    return glass->transmission * (one - zr_mix_v(glass->f0, glass->f90, square * square * away));
}

#endif
