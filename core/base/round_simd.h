/* round_simd.h - base: floats rounded to integers, as floats of any magnitude, for kernels. */
#ifndef ZR_ROUND_SIMD_H
#define ZR_ROUND_SIMD_H

#include "base/simd.h"

/* Rounds to the nearest, ties to even. Adding 2^23 to a smaller magnitude rounds it to an integer; all floats from 2^23
 * on are integers. */
static inline zr_vf zr_nearest_v(zr_vf v)
{
    const zr_vf whole = zr_vf_set(8388608.0f), size = zr_vf_abs(v), zero = zr_vf_set(0.0f);
    const zr_vf near = zr_vf_select(zr_vf_lt(size, whole), (size + whole) - whole, size);
    return zr_vf_select(zr_vf_lt(v, zero), zero - near, near);
}

/* Rounds down. */
static inline zr_vf zr_floor_v(zr_vf v)
{
    const zr_vf near = zr_nearest_v(v);
    return zr_vf_select(zr_vf_lt(v, near), near - zr_vf_set(1.0f), near);
}

#endif
