/* sse2.h - base: base/simd.h for any x86-64: SSE2, and nothing that came later. */
#ifndef ZR_SIMD_SSE2_H
#define ZR_SIMD_SSE2_H

#include "base/simd/bytes16.h"
#include "base/simd/x86.h"

#define ZR_SUFFIX sse2

static inline zr_vf zr_vf_load(const float *p)
{
    return (zr_vf)_mm_loadu_ps(p);
}
static inline zr_vi zr_vi_load(const void *p)
{
    return (zr_vi)_mm_loadu_si128((const __m128i *)p);
}
static inline void zr_vf_store(float *p, zr_vf v)
{
    _mm_storeu_ps(p, (__m128)v);
}
static inline void zr_vi_store(void *p, zr_vi v)
{
    _mm_storeu_si128((__m128i *)p, (__m128i)v);
}
static inline zr_vi zr_vi_select(zr_vm m, zr_vi a, zr_vi b)
{
    return ((zr_vi)m & a) | (~(zr_vi)m & b);
}
static inline zr_vf zr_vf_select(zr_vm m, zr_vf a, zr_vf b)
{
    return (zr_vf)zr_vi_select(m, (zr_vi)a, (zr_vi)b);
}
/* maskmovdqu would be a non-temporal store. */
static inline void zr_vi_store_first(void *p, zr_vi v, uint32_t n)
{
    if (n == ZR_LANES) {
        zr_vi_store(p, v);
        return;
    }
    __m128i left = (__m128i)v;
    char *to = (char *)p;
    if (n & 2) {
        _mm_storel_epi64((__m128i *)(void *)to, left);
        left = _mm_unpackhi_epi64(left, left);
        to += 8;
    }
    const int32_t last = _mm_cvtsi128_si32(left);
    if (n & 1) memcpy(to, &last, sizeof last);
}
static inline void zr_vi_stream(void *p, zr_vi v)
{
    _mm_stream_si128((__m128i *)p, (__m128i)v);
}
static inline uint32_t zr_vm_bits(zr_vm m)
{
    return (uint32_t)_mm_movemask_ps((__m128)m);
}
static inline zr_vm zr_vm_of(uint32_t bits)
{
    const zr_vi own = {1, 2, 4, 8};
    return zr_vi_eq(zr_vi_set((int32_t)bits) & own, own);
}
static inline zr_vf zr_vf_min(zr_vf a, zr_vf b)
{
    return (zr_vf)_mm_min_ps((__m128)a, (__m128)b);
}
static inline zr_vf zr_vf_max(zr_vf a, zr_vf b)
{
    return (zr_vf)_mm_max_ps((__m128)a, (__m128)b);
}
static inline zr_vi zr_vi_min(zr_vi a, zr_vi b)
{
    return zr_vi_select(zr_vi_lt(a, b), a, b);
}
static inline zr_vi zr_vi_max(zr_vi a, zr_vi b)
{
    return zr_vi_select(zr_vi_lt(b, a), a, b);
}
static inline zr_vf zr_vf_abs(zr_vf a)
{
    return (zr_vf)((zr_vi)a & zr_vi_set(INT32_MAX));
}
static inline zr_vf zr_vf_sqrt(zr_vf a)
{
    return (zr_vf)_mm_sqrt_ps((__m128)a);
}
static inline zr_vf zr_vf_of(zr_vi a)
{
    return (zr_vf)_mm_cvtepi32_ps((__m128i)a);
}
static inline zr_vi zr_vi_round(zr_vf a)
{
    return (zr_vi)_mm_cvtps_epi32((__m128)a);
}

static inline void zr_transpose4(zr_vf a0, zr_vf a1, zr_vf a2, zr_vf a3, zr_vf *x, zr_vf *y, zr_vf *z, zr_vf *w)
{
    const __m128 low01 = _mm_unpacklo_ps((__m128)a0, (__m128)a1), high01 = _mm_unpackhi_ps((__m128)a0, (__m128)a1);
    const __m128 low23 = _mm_unpacklo_ps((__m128)a2, (__m128)a3), high23 = _mm_unpackhi_ps((__m128)a2, (__m128)a3);
    *x = (zr_vf)_mm_movelh_ps(low01, low23);
    *y = (zr_vf)_mm_movehl_ps(low23, low01);
    *z = (zr_vf)_mm_movelh_ps(high01, high23);
    *w = (zr_vf)_mm_movehl_ps(high23, high01);
}

#define ZR_LOAD4(x, y, z, w, AT)                                                                                       \
    zr_transpose4(zr_vf_load(AT(0)), zr_vf_load(AT(1)), zr_vf_load(AT(2)), zr_vf_load(AT(3)), &(x), &(y), &(z), &(w))

#define ZR_LOAD_PAIRS(AT, i) zr_load_pair(AT(i), AT((i) + 1))

static inline zr_vp zr_vp_pack(zr_vi low, zr_vi high)
{
    return (zr_vp)_mm_packs_epi32((__m128i)low, (__m128i)high);
}
static inline zr_vp zr_vp_min(zr_vp a, zr_vp b)
{
    return (zr_vp)_mm_min_epi16((__m128i)a, (__m128i)b);
}
static inline zr_vp zr_vp_max(zr_vp a, zr_vp b)
{
    return (zr_vp)_mm_max_epi16((__m128i)a, (__m128i)b);
}
static inline zr_vi zr_vp_cross(zr_vp a, zr_vp b)
{
    const __m128i y_x = _mm_or_si128(_mm_slli_epi32((__m128i)b, 16), _mm_srli_epi32((__m128i)b, 16));
    const __m128i upper = _mm_set1_epi32((int32_t)0xffff0000);
    return (zr_vi)_mm_madd_epi16((__m128i)a, _mm_sub_epi16(_mm_xor_si128(y_x, upper), upper)); /* y, -x */
}

static inline void zr_vf_store4(float *p, zr_vf x, zr_vf y, zr_vf z, zr_vf w)
{
    zr_vf a, b, c, d; /* lanes 0, 1, 2, 3 */
    zr_transpose4(x, y, z, w, &a, &b, &c, &d);
    zr_vf_store(p, a);
    zr_vf_store(p + 4, b);
    zr_vf_store(p + 8, c);
    zr_vf_store(p + 12, d);
}

static inline void zr_vd_store(double *p, zr_vd v)
{
    _mm_storeu_pd(p, (__m128d)v);
}
static inline zr_vd zr_vd_widen(const float *p)
{
    return (zr_vd)_mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64((const __m128i *)(const void *)p)));
}
static inline void zr_vd_narrow(float *p, zr_vd v)
{
    _mm_storel_epi64((__m128i *)(void *)p, _mm_castps_si128(_mm_cvtpd_ps((__m128d)v)));
}
static inline zr_vd zr_vd_min(zr_vd a, zr_vd b)
{
    return (zr_vd)_mm_min_pd((__m128d)a, (__m128d)b);
}
static inline zr_vd zr_vd_max(zr_vd a, zr_vd b)
{
    return (zr_vd)_mm_max_pd((__m128d)a, (__m128d)b);
}

#include "base/simd/vector_masks.h"

#endif
