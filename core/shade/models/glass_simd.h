/* glass_simd.h - shade: how much of the light behind glass passes straight through it, for kernels.
 *
 * Source: KHR_materials_transmission; Schlick's term, by the normal without the normal map. KHR_materials_volume:
 *         Beer's law.
 */
#ifndef ZR_GLASS_SIMD_H
#define ZR_GLASS_SIMD_H

#include "base/simd/pow_simd.h"
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

/* Returns the power of a material's attenuation for rays that pass straight. */
static inline float zr_power_of(const struct zr_linear_lighting *lighting, uint32_t material)
{
    return lighting->backdrop ? lighting->backdrop->power[material] : 0.0f;
}

/* True if the light behind the material is looked up in the backdrop. */
static inline bool zr_has_backdrop(const struct zr_linear_lighting *lighting, const struct zr_material *material)
{
    return lighting->backdrop && lighting->backdrop->texels && zr_material_refracts(material);
}

/* Returns the share of red, green and blue that a volume leaves. power: length of the ray over the distance after which
 * white has the attenuation's colour, 0 .. ZR_BACKDROP_POWER_MAX. */
static inline struct zr_vec3_v zr_attenuated_v(struct zr_vec3_v color, zr_vf power)
{
    const zr_vf one = zr_vf_set(1.0f);
    const zr_vm any = zr_vf_lt(zr_vf_set(0.0f), power); /* black, too, attenuates nothing without a path */
    return (struct zr_vec3_v){zr_vf_select(any, zr_pow_v(color.x, power), one),
                              zr_vf_select(any, zr_pow_v(color.y, power), one),
                              zr_vf_select(any, zr_pow_v(color.z, power), one)};
}

#endif
