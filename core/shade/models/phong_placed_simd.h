/* phong_placed_simd.h - shade: phong_simd.h where some light has a place (lamp_place.h).
 *
 * Why:    a loop of its own: where all lights are directional, nothing is asked for each of them. It is kept apart, for
 *         the code of other shadings is slower with it.
 * Exact:  what arrives is multiplied with the cosine, or with the highlight, and that with light times surface, as
 *         Mesa's fixed functions do it.
 */
#ifndef ZR_PHONG_PLACED_SIMD_H
#define ZR_PHONG_PLACED_SIMD_H

#include "shade/lights/lamp_place_simd.h"
#include "shade/models/phong_simd.h"

static inline zr_vf zr_phong_shine_v(const struct zr_material *material, struct zr_vec3_v n, struct zr_vec3_v to_light,
                                     struct zr_vec3_v to_eye)
{
    const struct zr_vec3_v half = zr_normalize_v(zr_add_v(to_light, to_eye));
    const zr_vf cosine = zr_vf_min(zr_not_negative(zr_dot_v(n, half)), zr_vf_set(1.0f));
    return zr_pow_v(cosine, zr_vf_set(material->shininess));
}

static __attribute__((noinline)) struct zr_vec3_v zr_model_phong_placed(const struct zr_model_context *context,
                                                                        const struct zr_material *material,
                                                                        const struct zr_model_inputs *in)
{
    const struct zr_gl_lighting *lighting = context->lighting;
    const struct zr_vec3_v n = zr_normalize_v(in->normal), away = zr_scale_v(in->point, zr_vf_set(-1.0f));
    const struct zr_vec3_v to_eye = context->is_parallel ? zr_spread_v(context->to_eye) : zr_normalize_v(away);
    const zr_vec3 specular = material->specular;
    const bool shines = specular.x > 0.0f || specular.y > 0.0f || specular.z > 0.0f;
    struct zr_vec3_v sum = zr_mul_v(zr_spread_v(lighting->ambient), in->color);
    for (uint32_t i = 0; i < lighting->count; i++) {
        const struct zr_arriving_v arriving = zr_arriving_of_v(lighting, i, in->point);
        const struct zr_vec3_v color = zr_spread_v(lighting->colors[i]);
        const zr_vf facing = zr_dot_v(n, arriving.to_light);
        const zr_vm lit = zr_vf_lt(zr_vf_set(0.0f), facing);
        const zr_vf share = zr_not_negative(facing) * arriving.share;
        sum = zr_add_v(sum, zr_scale_v(zr_mul_v(color, in->color), share));
        if (!shines || !zr_vm_any(lit)) continue;
        const zr_vf power = zr_phong_shine_v(material, n, arriving.to_light, to_eye);
        const zr_vf shine = zr_vf_select(lit, power * arriving.share, zr_vf_set(0.0f));
        sum = zr_add_v(sum, zr_scale_v(zr_mul_v(color, zr_spread_v(specular)), shine));
    }
    return sum;
}

#endif
