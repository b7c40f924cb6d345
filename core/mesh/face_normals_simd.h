/* face_normals_simd.h - mesh: normals of ZR_LANES triangles, for kernels. */
#ifndef ZR_FACE_NORMALS_SIMD_H
#define ZR_FACE_NORMALS_SIMD_H

#include "base/vec3_simd.h"

/* zr_vec4_over_w of each lane. */
static inline struct zr_vec3_v zr_over_w_v(struct zr_vec3_v v, zr_vf w)
{
    const zr_vf one = zr_vf_set(1.0f), zero = zr_vf_set(0.0f);
    if (zr_vm_bits(zr_vf_eq(w, one)) == ZR_ALL_BITS) return v;
    w = zr_vf_select(zr_vf_eq(w, zero), one, w); /* a direction */
    return (struct zr_vec3_v){v.x / w, v.y / w, v.z / w};
}

/* Equals zr_normal_of_face, whose sum has a single term for a triangle. */
static inline struct zr_vec3_v zr_triangle_normal_v(const struct zr_vec3_v corners[3])
{
    const struct zr_vec3_v none = zr_spread_v((zr_vec3){0.0f, 0.0f, 0.0f});
    return zr_add_v(none, zr_cross_v(zr_minus_v(corners[1], corners[0]), zr_minus_v(corners[2], corners[0])));
}

#endif
