/* srgb_simd.h - look: sRGB-encoded values to linear light and back; for kernels.
 *
 * Range:  what is outside of 0..1 is clamped, and what is no number becomes 0. 0 and 1 stay what they are.
 * Exact:  within 6e-7 of IEC 61966-2-1. The powers 2.4 and 1 / 2.4 are minimax polynomials, in (x + 0.055)^(1/2)
 * (1.2e-7, relatively) and in x^(1/8) (8e-9); the rest is the rounding of floats. Of 2^24 values evenly spaced 317
 * become another byte than the nearest one.
 */
#ifndef ZR_SRGB_SIMD_H
#define ZR_SRGB_SIMD_H

#include "base/rgba_simd.h"
#include "look/tone_simd.h"

static inline zr_vf zr_srgb_decode_v(zr_vf x)
{
    static const float powers[] = {6.81213205e-5f, -0.001187086854f, 0.009299770997f, -0.04525288123f,
                                   0.1862796388f,  0.7969653487f,    -0.07690086535f, 0.01014335221f};
    x = zr_clamp01_v(x);
    const zr_vf root = zr_vf_sqrt(x + zr_vf_set(0.055f));
    zr_vf sum = zr_vf_set(powers[7]);
    for (int i = 6; i >= 0; i--)
        sum = sum * root + zr_vf_set(powers[i]);
    const zr_vf curve = zr_vf_min(sum, zr_vf_set(1.0f));
    return zr_vf_select(zr_vf_le(x, zr_vf_set(0.04045f)), x * zr_vf_set(1.0f / 12.92f), curve);
}

static inline zr_vf zr_srgb_encode_v(zr_vf x)
{
    static const float powers[] = {-0.05641629544f, 0.01739486415f,  -0.1078595299f, 0.8064848023f,
                                   0.4194788376f,   -0.09211857114f, 0.01303590029f};
    x = zr_clamp01_v(x);
    const zr_vf root = zr_vf_sqrt(zr_vf_sqrt(zr_vf_sqrt(x)));
    zr_vf sum = zr_vf_set(powers[6]);
    for (int i = 5; i >= 0; i--)
        sum = sum * root + zr_vf_set(powers[i]);
    const zr_vf curve = zr_vf_min(sum, zr_vf_set(1.0f));
    return zr_vf_select(zr_vf_le(x, zr_vf_set(0.0031308f)), x * zr_vf_set(12.92f), curve);
}

/* Of colours. */
static inline struct zr_vec3_v zr_srgb_decode_color_v(struct zr_vec3_v c)
{
    return (struct zr_vec3_v){zr_srgb_decode_v(c.x), zr_srgb_decode_v(c.y), zr_srgb_decode_v(c.z)};
}

#endif
