/* pow_simd.h - base: powers, for kernels.
 *
 * Exact:  equal to the last bit to GLSL's pow() in Mesa's llvmpipe, by its polynomials. So they are the same on every
 *         system, which libm does not promise. The relative error is at most 1.5e-5.
 * Source: Mesa, src/gallium/auxiliary/gallivm/lp_bld_arit.c: lp_build_log2_approx, lp_build_exp2, lp_build_pow.
 */
#ifndef ZR_POW_SIMD_H
#define ZR_POW_SIMD_H

#include "base/simd/simd.h"

/* log2(x) for 2^-126 <= x < infinity. Even and odd powers are summed apart, as in Mesa. */
static inline zr_vf zr_log2_v(zr_vf x)
{
    const zr_vi bits = zr_vi_bits_of(x);
    const zr_vf exponent = zr_vf_of((bits >> 23) - zr_vi_set(127));
    const zr_vf mantissa = zr_vf_bits((bits & zr_vi_set(0x7fffff)) | zr_vi_set(0x3f800000)), one = zr_vf_set(1.0f);
    const zr_vf y = (mantissa - one) / (mantissa + one), z = y * y, zz = z * z;
    const zr_vf even = (zr_vf_set(0.406718052498846252698f) * zz + zr_vf_set(0.577440339438736392009f)) * zz +
                       zr_vf_set(2.88539009343309178325f);
    const zr_vf odd = zr_vf_set(0.403343858251329912514f) * zz + zr_vf_set(0.961791550404184197881f);
    return y * (odd * z + even) + exponent;
}

/* 2^x for x <= 127; nearly 0 for x <= -127. */
static inline zr_vf zr_exp2_v(zr_vf x)
{
    x = zr_vf_max(x, zr_vf_set(-126.99999f));
    const zr_vf nearest = zr_vf_of(zr_vi_round(x));
    const zr_vf whole = zr_vf_select(zr_vf_lt(x, nearest), nearest - zr_vf_set(1.0f), nearest);
    const zr_vf f = x - whole, ff = f * f;
    const zr_vf even =
        (zr_vf_set(0.00898934009049466391101f) * ff + zr_vf_set(0.240153617044375388211f)) * ff + zr_vf_set(1.0f);
    const zr_vf odd = (zr_vf_set(0.00187757667519147912699f) * ff + zr_vf_set(0.0558263180532956664775f)) * ff +
                      zr_vf_set(0.693153073200168932794f);
    return zr_vf_bits((zr_vi_round(whole) + zr_vi_set(127)) << 23) * (odd * f + even);
}

/* x^y for x <= 1 and 0 <= y <= 2^15; 0 for x < 2^-126. */
static inline zr_vf zr_pow_v(zr_vf x, zr_vf y)
{
    const zr_vf least = zr_vf_set(1.1754944e-38f);
    return zr_vf_select(zr_vf_le(least, x), zr_exp2_v(zr_log2_v(zr_vf_max(x, least)) * y), zr_vf_set(0.0f));
}

#endif
