/* model.h - shade: inputs of the shading models, ZR_LANES pixels at a time; for kernels.
 *
 * Space:  eye space; the normal is that of the visible side, of any length.
 * A model is a file in models/, included in models_simd.h, and a row of scene/shadings.h.
 */
#ifndef ZR_MODEL_H
#define ZR_MODEL_H

#include "base/mutant.h"
#include "base/vec3_simd.h"
#include "shade/lights/light.h"

/* Values that are constant over the picture. */
struct zr_model_context {
    const struct zr_lights *lighting;
    bool is_parallel; /* view rays are parallel */
    zr_vec3 to_eye;   /* unit vector to the eye, if they are */
    zr_vec3 fog;      /* fog's colour; at depth d, a surface keeps the share d slope + start of its own colour, clamped
                       * to 0..1 */
    float fog_slope, fog_start;
};

/* Makes the context. Fog is resolved as in Mesa. */
static inline struct zr_model_context zr_model_context_of(const struct zr_lights *lighting, zr_vec4 eye,
                                                          const struct zr_fog *fog)
{
    struct zr_model_context context = {lighting, eye.w == 0.0f, {eye.x, eye.y, eye.z}, fog->color, 0.0f, 1.0f};
    if (!fog->is_on) return context;
    context.fog_slope = -1.0f / (fog->far - fog->near);
    context.fog_start = fog->far * -context.fog_slope;
    return context;
}

/* Values that vary: the surface's own colour, its normal, and the vector from the eye to the visible point, of any
 * length. */
struct zr_model_inputs {
    struct zr_vec3_v color, normal, point;
};

/* Mixes colours, clamped to 0..1, with fog, as in GL 2.1.
 * Exact: Mesa's order. */
static inline struct zr_vec3_v zr_fogged_v(const struct zr_model_context *context, struct zr_vec3_v color, zr_vf depth)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f);
    const zr_vf linear = depth * zr_vf_set(context->fog_slope) + zr_vf_set(context->fog_start);
    const zr_vf own = zr_vf_min(zr_vf_max(ZR_MUTANT(fog_turned, linear, one - linear), zero), one), other = one - own;
    const struct zr_vec3_v fog = zr_spread_v(context->fog);
    const zr_vf x = zr_vf_min(zr_vf_max(color.x, zero), one), y = zr_vf_min(zr_vf_max(color.y, zero), one),
                z = zr_vf_min(zr_vf_max(color.z, zero), one);
    return (struct zr_vec3_v){fog.x * other + x * own, fog.y * other + y * own, fog.z * other + z * own};
}

#endif
