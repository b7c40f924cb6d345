/* angle_simd.h - mesh: angles between vectors, one per lane; for kernels. */
#ifndef ZR_ANGLE_SIMD_H
#define ZR_ANGLE_SIMD_H

#include "base/simd.h"

/* Returns atan2(y, x) for y >= 0: 0 .. pi, within 1e-6; 0 for (0, 0). Source: the Chebyshev series of the arc tangent,
 * 2 (-1)^k q^(2k+1) / (2k+1) T(2k+1) with q = sqrt 2 - 1; the terms up to T13 leave an error below 3e-7 on 0..1. */
static inline zr_vf zr_angle_v(zr_vf y, zr_vf x)
{
    static const float c[] = {0.999995623f,  -0.33316002f,   0.19796892f,   -0.131959022f,
                              0.0789998337f, -0.0331052509f, 0.00665828962f};
    const float half_turn = 3.14159265f, quarter = 1.57079633f;
    const zr_vf wide = zr_vf_abs(x), zero = zr_vf_set(0.0f);
    const zr_vf most = zr_vf_max(wide, y), least = zr_vf_min(wide, y);
    const zr_vf t = least / zr_vf_select(zr_vf_eq(most, zero), zr_vf_set(1.0f), most), square = t * t;
    zr_vf sum = zr_vf_set(c[6]);
    for (int i = 5; i >= 0; i--)
        sum = sum * square + zr_vf_set(c[i]);
    sum = sum * t;
    sum = zr_vf_select(zr_vf_lt(wide, y), zr_vf_set(quarter) - sum, sum);
    return zr_vf_select(zr_vf_lt(x, zero), zr_vf_set(half_turn) - sum, sum);
}

#endif
