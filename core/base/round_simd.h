/* round_simd.h - base: floats to whole floats, of any size, for kernels. */
#ifndef ZR_ROUND_SIMD_H
#define ZR_ROUND_SIMD_H

#include "base/simd.h"

/* To the nearest, ties to even. From 2^23 on every float is whole; up to there the sum with it has no digits behind the
 * point. */
static inline zr_vf zr_nearest_v(zr_vf v)
{
    const zr_vf whole = zr_vf_set(8388608.0f), size = zr_vf_abs(v), zero = zr_vf_set(0.0f);
    const zr_vf near = zr_vf_select(zr_vf_lt(size, whole), (size + whole) - whole, size);
    return zr_vf_select(zr_vf_lt(v, zero), zero - near, near);
}

/* Downwards. */
static inline zr_vf zr_floor_v(zr_vf v)
{
    const zr_vf near = zr_nearest_v(v);
    return zr_vf_select(zr_vf_lt(v, near), near - zr_vf_set(1.0f), near);
}

#endif
