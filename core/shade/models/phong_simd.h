/* phong_simd.h - shade: lighting per pixel: diffuse as for Gouraud's vertices, specular as by Blinn.
 *
 * Exact:  order of operations as in shade/lights/light_kernel.c, and for the specular term as in Mesa's fixed function,
 *         except for the power (base/simd/pow_simd.h). The viewer is local: at the eye, or infinitely far if view rays are
 *         parallel.
 * Source: Phong, "Illumination for Computer Generated Pictures", 1975; Blinn, "Models of Light Reflection for Computer
 *         Synthesized Pictures", 1977.
 */
#ifndef ZR_PHONG_SIMD_H
#define ZR_PHONG_SIMD_H

#include "base/mutant.h"
#include "base/simd/pow_simd.h"
#include "shade/lights/lamp_place_simd.h"
#include "shade/models/model.h"

static inline zr_vf zr_not_negative(zr_vf v)
{
    return zr_vf_max(v, zr_vf_set(0.0f));
}

/* Returns N.H to the power of the shininess. */
static inline __attribute__((always_inline)) zr_vf zr_phong_shine_v(const struct zr_material *material,
                                                                    struct zr_vec3_v n, struct zr_vec3_v to_light,
                                                                    struct zr_vec3_v to_eye)
{
    const struct zr_vec3_v between = zr_add_v(to_light, to_eye);
    const struct zr_vec3_v half = ZR_MUTANT(half_not_unit, zr_normalize_v(between), between);
    const zr_vf cosine = zr_vf_min(zr_not_negative(zr_dot_v(n, half)), zr_vf_set(1.0f));
    return zr_pow_v(cosine, zr_vf_set(material->shininess));
}

/* Shades by Phong's model. `placed`, a constant: lamps may have a position. */
static inline __attribute__((always_inline)) struct zr_vec3_v zr_phong_v(const struct zr_model_context *context,
                                                                         const struct zr_material *material,
                                                                         const struct zr_model_inputs *in, bool placed)
{
    const struct zr_lights *lights = context->lighting;
    const struct zr_vec3_v n = zr_normalize_v(in->normal), away = zr_scale_v(in->point, zr_vf_set(-1.0f));
    const struct zr_vec3_v to_eye = context->is_parallel ? zr_spread_v(context->to_eye) : zr_normalize_v(away);
    const zr_vec3 specular = material->specular;
    const bool shines = specular.x > 0.0f || specular.y > 0.0f || specular.z > 0.0f;
    struct zr_vec3_v sum = zr_mul_v(zr_spread_v(lights->ambient), in->color);
    for (uint32_t i = 0; i < lights->count; i++) {
        const struct zr_lamp *lamp = &lights->lamps[i];
        const struct zr_arriving_v arriving = zr_arriving_v(lamp, in->point, placed);
        const struct zr_vec3_v color = zr_spread_v(lamp->color);
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

/* Flattened: calls of zr_normalize_v would take a twentieth of the time. */
static inline __attribute__((flatten)) struct zr_vec3_v zr_model_phong(const struct zr_model_context *context,
                                                                       const struct zr_material *material,
                                                                       const struct zr_model_inputs *in)
{
    return zr_phong_v(context, material, in, false);
}

/* Not inlined, since its code slows down other shadings. */
static __attribute__((noinline)) struct zr_vec3_v zr_model_phong_placed(const struct zr_model_context *context,
                                                                        const struct zr_material *material,
                                                                        const struct zr_model_inputs *in)
{
    return zr_phong_v(context, material, in, true);
}

#endif
