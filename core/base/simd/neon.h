/* neon.h - base: base/simd.h for AArch64's Advanced SIMD. */
#ifndef ZR_SIMD_NEON_H
#define ZR_SIMD_NEON_H

#include <arm_neon.h>

#include "base/simd/bytes16.h"

#define ZR_SUFFIX neon

static inline zr_vf zr_vf_load(const float *p)
{
    return (zr_vf)vld1q_f32(p);
}
/* As bytes, which are never aligned to less than they should be. */
static inline zr_vi zr_vi_load(const void *p)
{
    return (zr_vi)vld1q_u8((const uint8_t *)p);
}
static inline void zr_vf_store(float *p, zr_vf v)
{
    vst1q_f32(p, (float32x4_t)v);
}
static inline void zr_vi_store(void *p, zr_vi v)
{
    vst1q_u8((uint8_t *)p, (uint8x16_t)v);
}
static inline zr_vf zr_vf_select(zr_vm m, zr_vf a, zr_vf b)
{
    return (zr_vf)vbslq_f32((uint32x4_t)m, (float32x4_t)a, (float32x4_t)b);
}
static inline zr_vi zr_vi_select(zr_vm m, zr_vi a, zr_vi b)
{
    return (zr_vi)vbslq_s32((uint32x4_t)m, (int32x4_t)a, (int32x4_t)b);
}
static inline void zr_vi_store_first(void *p, zr_vi v, uint32_t n)
{
    if (n == ZR_LANES) {
        zr_vi_store(p, v);
        return;
    }
    uint8_t *to = (uint8_t *)p;
    int32_t last = v[0];
    if (n & 2) {
        vst1_u8(to, vget_low_u8((uint8x16_t)v));
        last = v[2];
        to += 8;
    }
    if (n & 1) memcpy(to, &last, sizeof last);
}
/* stnp is a hint that no intrinsic gives. */
static inline void zr_vi_stream(void *p, zr_vi v)
{
    zr_vi_store(p, v);
}
static inline uint32_t zr_vm_bits(zr_vm m)
{
    const zr_vm own = {1, 2, 4, 8};
    return vaddvq_u32((uint32x4_t)(m & own));
}
static inline zr_vm zr_vm_of(uint32_t bits)
{
    const zr_vm own = {1, 2, 4, 8};
    return (zr_vm)vtstq_u32(vdupq_n_u32(bits), (uint32x4_t)own);
}
/* Not vminq and vmaxq, which give NaN where either is, and order -0 and 0. */
static inline zr_vf zr_vf_min(zr_vf a, zr_vf b)
{
    return zr_vf_select(zr_vf_lt(a, b), a, b);
}
static inline zr_vf zr_vf_max(zr_vf a, zr_vf b)
{
    return zr_vf_select(zr_vf_lt(b, a), a, b);
}
static inline zr_vi zr_vi_min(zr_vi a, zr_vi b)
{
    return (zr_vi)vminq_s32((int32x4_t)a, (int32x4_t)b);
}
static inline zr_vi zr_vi_max(zr_vi a, zr_vi b)
{
    return (zr_vi)vmaxq_s32((int32x4_t)a, (int32x4_t)b);
}
static inline zr_vf zr_vf_abs(zr_vf a)
{
    return (zr_vf)vabsq_f32((float32x4_t)a);
}
static inline zr_vf zr_vf_sqrt(zr_vf a)
{
    return (zr_vf)vsqrtq_f32((float32x4_t)a);
}
static inline zr_vf zr_vf_of(zr_vi a)
{
    return (zr_vf)vcvtq_f32_s32((int32x4_t)a);
}
static inline zr_vi zr_vi_round(zr_vf a)
{
    return (zr_vi)vcvtnq_s32_f32((float32x4_t)a);
}

#define ZR_LOAD4(x, y, z, w, AT)                                                                                       \
    zr_transpose4(zr_vf_load(AT(0)), zr_vf_load(AT(1)), zr_vf_load(AT(2)), zr_vf_load(AT(3)), &(x), &(y), &(z), &(w))

static inline void zr_transpose4(zr_vf a0, zr_vf a1, zr_vf a2, zr_vf a3, zr_vf *x, zr_vf *y, zr_vf *z, zr_vf *w)
{
    const float64x2_t low01 = (float64x2_t)vzip1q_f32((float32x4_t)a0, (float32x4_t)a1);
    const float64x2_t high01 = (float64x2_t)vzip2q_f32((float32x4_t)a0, (float32x4_t)a1);
    const float64x2_t low23 = (float64x2_t)vzip1q_f32((float32x4_t)a2, (float32x4_t)a3);
    const float64x2_t high23 = (float64x2_t)vzip2q_f32((float32x4_t)a2, (float32x4_t)a3);
    *x = (zr_vf)vzip1q_f64(low01, low23);
    *y = (zr_vf)vzip2q_f64(low01, low23);
    *z = (zr_vf)vzip1q_f64(high01, high23);
    *w = (zr_vf)vzip2q_f64(high01, high23);
}

#define ZR_LOAD_PAIRS(AT, i) vcombine_f32(vld1_f32(AT(i)), vld1_f32(AT((i) + 1)))

static inline zr_vp zr_vp_pack(zr_vi low, zr_vi high)
{
    return (zr_vp)vcombine_s16(vqmovn_s32((int32x4_t)low), vqmovn_s32((int32x4_t)high));
}
static inline zr_vp zr_vp_min(zr_vp a, zr_vp b)
{
    return (zr_vp)vminq_s16((int16x8_t)a, (int16x8_t)b);
}
static inline zr_vp zr_vp_max(zr_vp a, zr_vp b)
{
    return (zr_vp)vmaxq_s16((int16x8_t)a, (int16x8_t)b);
}
static inline void zr_vf_store4(float *p, zr_vf x, zr_vf y, zr_vf z, zr_vf w)
{
    const float32x4x4_t all = {{(float32x4_t)x, (float32x4_t)y, (float32x4_t)z, (float32x4_t)w}};
    vst4q_f32(p, all);
}

static inline void zr_vd_store(double *p, zr_vd v)
{
    vst1q_f64(p, (float64x2_t)v);
}
static inline zr_vd zr_vd_widen(const float *p)
{
    return (zr_vd)vcvt_f64_f32(vld1_f32(p));
}
static inline void zr_vd_narrow(float *p, zr_vd v)
{
    vst1_f32(p, vcvt_f32_f64((float64x2_t)v));
}
static inline zr_vd zr_vd_min(zr_vd a, zr_vd b)
{
    return (zr_vd)vbslq_f64(vcltq_f64((float64x2_t)a, (float64x2_t)b), (float64x2_t)a, (float64x2_t)b);
}
static inline zr_vd zr_vd_max(zr_vd a, zr_vd b)
{
    return (zr_vd)vbslq_f64(vcgtq_f64((float64x2_t)a, (float64x2_t)b), (float64x2_t)a, (float64x2_t)b);
}

#include "base/simd/vector_masks.h"

#endif
