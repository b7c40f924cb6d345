/* srgb_simd.h - base: sRGB-encoded values to linear light and back, for kernels; error at most 3e-7.
 * Source: IEC 61966-2-1.
 */
#ifndef ZR_SRGB_VALUES_SIMD_H
#define ZR_SRGB_VALUES_SIMD_H

#include "base/simd/pow_simd.h"

/* Both clamp their argument to 0..1. */
static inline zr_vf zr_srgb_decode_v(zr_vf encoded)
{
    encoded = zr_vf_min(zr_vf_max(encoded, zr_vf_set(0.0f)), zr_vf_set(1.0f));
    const zr_vf line = encoded * zr_vf_set(1.0f / 12.92f);
    const zr_vf curve = zr_pow_v((encoded + zr_vf_set(0.055f)) * zr_vf_set(1.0f / 1.055f), zr_vf_set(2.4f));
    return zr_vf_select(zr_vf_le(encoded, zr_vf_set(0.04045f)), line, curve);
}

static inline zr_vf zr_srgb_encode_v(zr_vf linear)
{
    linear = zr_vf_min(zr_vf_max(linear, zr_vf_set(0.0f)), zr_vf_set(1.0f));
    const zr_vf line = linear * zr_vf_set(12.92f);
    const zr_vf curve = zr_vf_set(1.055f) * zr_pow_v(linear, zr_vf_set(1.0f / 2.4f)) - zr_vf_set(0.055f);
    return zr_vf_select(zr_vf_le(linear, zr_vf_set(0.0031308f)), line, curve);
}

#endif
