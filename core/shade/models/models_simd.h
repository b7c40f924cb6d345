/* models_simd.h - shade: calls the model of each shading, by its row (scene/shadings.h); for the shading kernel. */
#ifndef ZR_MODELS_SIMD_H
#define ZR_MODELS_SIMD_H

#include "shade/models/model.h"
#include "shade/models/phong_simd.h"

/* Normals in camera space as colours: -1 .. 1 becomes 0 .. 1. */
static inline struct zr_vec3_v zr_shade_by_normals(const struct zr_model_context *context,
                                                   const struct zr_material *material, const struct zr_model_inputs *in)
{
    const struct zr_vec3_v n = zr_normalize_v(in->normal);
    const zr_vf half = zr_vf_set(0.5f);
    (void)context;
    (void)material;
    return (struct zr_vec3_v){n.x * half + half, n.y * half + half, n.z * half + half};
}

/* A model is zr_shade_by_NAME, in models/. This one keeps colours that were lit before. */
static inline struct zr_vec3_v zr_shade_by_colors(const struct zr_model_context *context,
                                                  const struct zr_material *material, const struct zr_model_inputs *in)
{
    (void)context;
    (void)material;
    return in->color;
}

static inline struct zr_vec3_v zr_shade_by_phong(const struct zr_model_context *context,
                                                 const struct zr_material *material, const struct zr_model_inputs *in)
{
    if (context->lighting->placed_count == 0) return zr_model_phong(context, material, in);
    const struct zr_model_inputs copy = *in; /* the copy is passed by address, so that *in stays in registers */
    return zr_model_phong_placed(context, material, &copy);
}

static inline struct zr_vec3_v zr_model_color(const struct zr_model_context *context,
                                              const struct zr_material *material, const struct zr_model_inputs *in)
{
    switch (material->shading) {
#define ZR_MODEL_CASE(ID, word, text, rate, light, smooth, specular, linear, layered, model)                           \
    case ZR_SHADING_##ID:                                                                                              \
        return zr_shade_by_##model(context, material, in);
        ZR_SHADINGS(ZR_MODEL_CASE)
#undef ZR_MODEL_CASE
    default:
        return in->color;
    }
}

#endif
