/* classic_simd.h - shade: the textbook's shadings in linear light (flat, gouraud and phong, which differ only in their
 * normals), and Gooch's, for kernels. */
#ifndef ZR_CLASSIC_SIMD_H
#define ZR_CLASSIC_SIMD_H

#include "base/inlined.h"
#include "base/simd/pow_simd.h"
#include "shade/models/linear_simd.h"

static inline struct zr_vec3_v zr_highlight_v(const struct zr_material *material, zr_vf cosine)
{
    const zr_vec3 specular = material->specular;
    const zr_vf zero = zr_vf_set(0.0f);
    const bool shines = specular.x > 0.0f || specular.y > 0.0f || specular.z > 0.0f;
    if (!shines) return (struct zr_vec3_v){zero, zero, zero};
    return zr_scale_v(zr_spread_v(specular), zr_pow_v(cosine, zr_vf_set(material->shininess)));
}

ZR_INLINED struct zr_vec3_v zr_shade_classic_v(const struct zr_linear_lighting *lighting,
                                               const struct zr_material *material, const struct zr_shading_v *s)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f);
    struct zr_vec3_v ambient = zr_spread_v(lighting->lights.ambient), direct = {zero, zero, zero}, shine = direct;
    for (uint32_t i = 0; i < lighting->lights.count; i++) {
        const struct zr_lamp *lamp = &lighting->lights.lamps[i];
        if (!lamp->lights_classic) continue;
        if (lamp->is_hemisphere) {
            ambient = zr_add_v(ambient, zr_hemisphere_v(lamp, s->normal));
            continue;
        }
        const struct zr_arriving_v arriving = zr_lit_by_v(lamp, s);
        const zr_vf facing = zr_vf_max(zr_dot_v(s->normal, arriving.to_light), zero);
        const struct zr_vec3_v color = zr_scale_v(zr_spread_v(lamp->color), arriving.share);
        direct = zr_add_v(direct, zr_scale_v(color, facing));
        if (!zr_shading_has_specular(material->shading)) continue;
        const struct zr_vec3_v half = zr_normalize_v(zr_add_v(arriving.to_light, s->to_eye));
        const zr_vf cosine = zr_vf_min(zr_vf_max(zr_dot_v(s->normal, half), zero), one);
        const zr_vf lit = zr_vf_select(zr_vf_lt(zero, facing), one, zero);
        shine = zr_add_v(shine, zr_mul_v(color, zr_scale_v(zr_highlight_v(material, cosine), lit)));
    }
    struct zr_vec3_v reaching = zr_mul_v(ambient, zr_bounced3_v(s->ao, s->base));
    if (s->textured) reaching = zr_scale_v(reaching, s->textured->occlusion);
    return zr_add_v(zr_mul_v(s->base, zr_add_v(reaching, direct)), shine);
}

/* Shades from the surface's colour times the material's cool one, on the side away from a lamp at the upper left, to
 * the surface's own colour. Creases are darkened. Source: Gooch and others, "A Non-Photorealistic Lighting Model For
 * Automatic Technical Illustration", 1998. */
ZR_INLINED struct zr_vec3_v zr_shade_gooch_v(const struct zr_gooch *gooch, struct zr_vec3_v cool,
                                             const struct zr_shading_v *s)
{
    const zr_vec3 to_lamp = zr_vec3_normalize((zr_vec3){-0.45f, 0.65f, 0.61f});
    const zr_vf half = zr_vf_set(0.5f);
    const zr_vf facing = zr_clamp01_v(half + half * zr_dot_v(s->normal, zr_spread_v(to_lamp)));
    const zr_vf share = ZR_MUTANT(gooch_linear, facing * zr_vf_sqrt(facing), facing);
    const struct zr_vec3_v color = zr_mix3_v(zr_mul_v(cool, s->base), s->base, share);
    const zr_vf ao = s->textured ? s->ao * s->textured->occlusion : s->ao;
    return zr_scale_v(color, zr_vf_set(gooch->least) + zr_vf_set(gooch->rise) * ao);
}

#endif
