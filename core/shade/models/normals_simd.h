/* normals_simd.h - shade: normals in camera space as colours: -1 .. 1 becomes 0 .. 1. */
#ifndef ZR_NORMALS_SIMD_H
#define ZR_NORMALS_SIMD_H

#include "shade/models/model.h"

static inline struct zr_vec3_v zr_shade_by_normals(const struct zr_model_context *context,
                                                   const struct zr_material *material, const struct zr_model_inputs *in)
{
    const struct zr_vec3_v n = zr_normalize_v(in->normal);
    const zr_vf half = zr_vf_set(0.5f);
    (void)context;
    (void)material;
    return (struct zr_vec3_v){n.x * half + half, n.y * half + half, n.z * half + half};
}

#endif
