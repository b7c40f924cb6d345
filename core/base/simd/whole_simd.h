/* whole_simd.h - base: floats of any magnitude rounded to whole floats, for kernels. A result of 0 is +0. */
#ifndef ZR_WHOLE_SIMD_H
#define ZR_WHOLE_SIMD_H

#include "base/simd/simd.h"

#if defined ZR_KERNEL_AVX512 || defined ZR_KERNEL_AVX2

/* One instruction rounds. The sum makes -0 to +0, as below. */
#ifdef ZR_KERNEL_AVX512
#define ZR_WHOLE(v, how) ((zr_vf)_mm512_roundscale_ps((__m512)(v), (how) | _MM_FROUND_NO_EXC))
#else
#define ZR_WHOLE(v, how) ((zr_vf)_mm256_round_ps((__m256)(v), (how) | _MM_FROUND_NO_EXC))
#endif

/* Rounds to the nearest whole float, ties to even. */
static inline zr_vf zr_nearest_v(zr_vf v)
{
    return ZR_WHOLE(v, _MM_FROUND_TO_NEAREST_INT) + zr_vf_set(0.0f);
}

/* Rounds down. */
static inline zr_vf zr_floor_v(zr_vf v)
{
    return ZR_WHOLE(v, _MM_FROUND_TO_NEG_INF) + zr_vf_set(0.0f);
}

#undef ZR_WHOLE

#else

/* Adding 2^23 to a smaller magnitude rounds it to an integer; all floats from 2^23 on are integers. */
static inline zr_vf zr_nearest_v(zr_vf v)
{
    const zr_vf whole = zr_vf_set(8388608.0f), size = zr_vf_abs(v), zero = zr_vf_set(0.0f);
    const zr_vf near = zr_vf_select(zr_vf_lt(size, whole), (size + whole) - whole, size);
    return zr_vf_select(zr_vf_lt(v, zero), zero - near, near);
}

static inline zr_vf zr_floor_v(zr_vf v)
{
    const zr_vf near = zr_nearest_v(v);
    return zr_vf_select(zr_vf_lt(v, near), near - zr_vf_set(1.0f), near);
}

#endif

#endif
