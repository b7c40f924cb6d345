/* phong_simd.h - shade: lit pixel by pixel: diffuse as Gouraud's vertices are, and specular as Blinn has it.
 *
 * Exact:  the order of operations is that of geometry/light_kernel.c, and, of what is specular, of Mesa's fixed
 * function, but for the power (base/pow_simd.h). The viewer is local: at the eye, or, where rays are parallel, far
 * away. Source: Phong, "Illumination for Computer Generated Pictures", 1975; Blinn, "Models of Light Reflection for
 * Computer Synthesized Pictures", 1977.
 */
#ifndef ZR_PHONG_SIMD_H
#define ZR_PHONG_SIMD_H

#include "base/mutant.h"
#include "base/pow_simd.h"
#include "shade/models/model.h"

static inline zr_vf zr_not_negative(zr_vf v)
{
    return zr_vf_max(v, zr_vf_set(0.0f));
}

static inline struct zr_vec3_v zr_model_phong(const struct zr_model_context *context,
                                              const struct zr_material *material, const struct zr_model_inputs *in)
{
    const struct zr_gl_lighting *lighting = context->lighting;
    const struct zr_vec3_v n = zr_normalize_v(in->normal), ambient = zr_spread_v(lighting->ambient);
    const struct zr_vec3_v away = zr_scale_v(in->point, zr_vf_set(-1.0f));
    const struct zr_vec3_v to_eye = context->is_parallel ? zr_spread_v(context->to_eye) : zr_normalize_v(away);
    const zr_vec3 specular = material->specular;
    const bool shines = specular.x > 0.0f || specular.y > 0.0f || specular.z > 0.0f;
    struct zr_vec3_v sum = {ambient.x * in->color.x, ambient.y * in->color.y, ambient.z * in->color.z};
    for (uint32_t i = 0; i < lighting->count; i++) {
        const struct zr_vec3_v l = zr_spread_v(lighting->to_light[i]), color = zr_spread_v(lighting->colors[i]);
        const zr_vf facing = zr_dot_v(n, l);
        const zr_vm lit = zr_vf_lt(zr_vf_set(0.0f), facing);
        const zr_vf share = zr_not_negative(facing);
        sum.x = sum.x + share * (color.x * in->color.x);
        sum.y = sum.y + share * (color.y * in->color.y);
        sum.z = sum.z + share * (color.z * in->color.z);
        if (!shines || !zr_vm_any(lit)) continue;
        const struct zr_vec3_v between = {l.x + to_eye.x, l.y + to_eye.y, l.z + to_eye.z};
        const struct zr_vec3_v half = ZR_MUTANT(half_not_unit, zr_normalize_v(between), between);
        const zr_vf cosine = zr_vf_min(zr_not_negative(zr_dot_v(n, half)), zr_vf_set(1.0f));
        const zr_vf power = zr_pow_v(cosine, zr_vf_set(material->shininess));
        const zr_vf shine = zr_vf_select(lit, power, zr_vf_set(0.0f));
        sum.x = sum.x + shine * (color.x * zr_vf_set(specular.x));
        sum.y = sum.y + shine * (color.y * zr_vf_set(specular.y));
        sum.z = sum.z + shine * (color.z * zr_vf_set(specular.z));
    }
    return sum;
}

#endif
