/* pixel_scale_simd.h - effects: w of points in clip space (struct zr_pixel_scale), for kernels. */
#ifndef ZR_PIXEL_SCALE_SIMD_H
#define ZR_PIXEL_SCALE_SIMD_H

#include "base/vec3_simd.h"
#include "effects/occlusion.h"

static inline zr_vf zr_pixel_scale_w_v(const struct zr_pixel_scale *scale, struct zr_vec3_v point)
{
    const struct zr_vec3_v slope = {zr_vf_set(scale->slope[0]), zr_vf_set(scale->slope[1]), zr_vf_set(scale->slope[2])};
    return zr_dot_v(slope, point) + zr_vf_set(scale->offset);
}

#endif
