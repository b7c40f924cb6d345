/* rsqrt_simd.h - base: 1 / sqrt(x), for kernels, in a third of the time of a root and a quotient.
 *
 * Exact:  products and differences only, so the same on every machine, which no machine's own estimate is. Within 3e-7
 *         of the value.
 * Source: the first guess is the well-known one from the bits of the exponent; then Newton's method, three times.
 */
#ifndef ZR_RSQRT_SIMD_H
#define ZR_RSQRT_SIMD_H

#include "base/simd.h"

/* Of what is from 2^-126 up. */
static inline zr_vf zr_rsqrt_v(zr_vf x)
{
    const zr_vf half = zr_vf_set(0.5f) * x, three_halves = zr_vf_set(1.5f);
    zr_vf y = zr_vf_bits(zr_vi_set(0x5f375a86) - (zr_vi_bits_of(x) >> 1));
    y = y * (three_halves - half * y * y);
    y = y * (three_halves - half * y * y);
    return y * (three_halves - half * y * y);
}

#endif
