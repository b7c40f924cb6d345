/* models_simd.h - shade: the models that need more than a colour, by their names; for the kernel that shades. */
#ifndef ZR_MODELS_SIMD_H
#define ZR_MODELS_SIMD_H

#include "shade/models/normals_simd.h"
#include "shade/models/phong_simd.h"

static inline struct zr_vec3_v zr_model_color(const struct zr_model_context *context,
                                              const struct zr_material *material, const struct zr_model_inputs *in)
{
    switch (material->shading) {
    case ZR_SHADING_PHONG:
        if (context->lighting->placed_count > 0) {
            const struct zr_model_inputs copy = *in; /* what is handed over by its address is in no register */
            return zr_model_phong_placed(context, material, &copy);
        }
        return zr_model_phong(context, material, in);
    case ZR_SHADING_NORMALS:
        return zr_model_normals(context, material, in);
    default:
        return in->color;
    }
}

#endif
