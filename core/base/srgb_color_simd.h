/* srgb_color_simd.h - base: decodes sRGB colours to linear light, for kernels. */
#ifndef ZR_SRGB_COLOR_SIMD_H
#define ZR_SRGB_COLOR_SIMD_H

#include "base/rgba_simd.h"
#include "base/simd/srgb_simd.h"
#include "base/vec3_simd.h"

static inline struct zr_vec3_v zr_srgb_decode_color_v(struct zr_vec3_v c)
{
    return (struct zr_vec3_v){zr_srgb_decode_v(c.x), zr_srgb_decode_v(c.y), zr_srgb_decode_v(c.z)};
}

#endif
