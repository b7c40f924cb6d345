/* immintrin.h - tests: AVX-512 for machines without it. `make emulated` compiles the kernels with this folder before
 * the system's, so that intrinsics of AVX-512 are SIMDe's functions, or those below where SIMDe has none yet: what
 * base/simd/avx512.h says is run in 16 lanes and compared, slowly. As by the instructions, lanes that a mask leaves out
 * are neither read nor written, and what is streamed is aligned.
 */
#ifndef ZR_EMULATED_IMMINTRIN_H
#define ZR_EMULATED_IMMINTRIN_H

#pragma GCC system_header /* what macros of a header like this one make is as quiet */
#include_next <immintrin.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define SIMDE_ENABLE_NATIVE_ALIASES
#include <simde/x86/avx512.h>

enum { EMULATED_LANES = 16, EMULATED_DOUBLES = 8 };
typedef uint16_t emulated_u16s __attribute__((vector_size(64)));
typedef int32_t emulated_i32s __attribute__((vector_size(64)));

/* ---- masks ---- */

#define _cvtmask16_u32(m)                     ((uint32_t)(m))
#define _cvtu32_mask16(bits)                  ((__mmask16)(bits))
#define _kand_mask16(a, b)                    ((__mmask16)((a) & (b)))
#define _kor_mask16(a, b)                     ((__mmask16)((a) | (b)))
#define _kandn_mask16(a, b)                   ((__mmask16)(~(a) & (b)))
#define _mm512_mask_cmp_ps_mask(m, a, b, how) ((__mmask16)((m)&_mm512_cmp_ps_mask(a, b, how)))
#define _mm512_cmplt_epi32_mask(a, b)         _mm512_cmpgt_epi32_mask(b, a)
#define _mm512_mask_cmplt_epi32_mask(m, a, b) ((__mmask16)((m)&_mm512_cmpgt_epi32_mask(b, a)))

/* ---- memory ---- */

static inline void emulated_mask_storeu(void *p, __mmask16 m, __m512i v)
{
    const emulated_i32s lanes = (emulated_i32s)v;
    for (int i = 0; i < EMULATED_LANES; i++)
        if (m >> i & 1) memcpy((char *)p + i * 4, (const char *)&lanes + i * 4, 4);
}
#define _mm512_mask_storeu_epi32(p, m, v) emulated_mask_storeu(p, m, v)

static inline void emulated_stream(void *p, __m512i v)
{
    if ((uintptr_t)p % 64) abort();
    memcpy(p, &v, 64);
}
#define _mm512_stream_si512(p, v) emulated_stream(p, v)

/* 4 bytes of each lane that m has, from p + scale * its index, signed; the others are `instead`'s. */
static inline __m512i emulated_gather(__m512i instead, __mmask16 m, __m512i index, const void *p, int scale)
{
    const emulated_i32s from = (emulated_i32s)index;
    for (int i = 0; i < EMULATED_LANES; i++)
        if (m >> i & 1) memcpy((char *)&instead + i * 4, (const char *)p + (ptrdiff_t)from[i] * scale, 4);
    return instead;
}
#define _mm512_mask_i32gather_epi32(instead, m, index, p, scale) emulated_gather(instead, m, index, p, scale)
/* All lanes. */
#define _mm512_i32gather_ps(index, p, scale) ((__m512)emulated_gather(_mm512_setzero_si512(), 0xffff, index, p, scale))

/* 8 bytes of each. */
static inline __m512i emulated_gather_pairs(__m256i index, const void *p, int scale)
{
    int32_t from[EMULATED_DOUBLES];
    int64_t pairs[EMULATED_DOUBLES];
    _mm256_storeu_si256((__m256i *)(void *)from, index);
    for (int i = 0; i < EMULATED_DOUBLES; i++)
        memcpy(pairs + i, (const char *)p + (ptrdiff_t)from[i] * scale, 8);
    return _mm512_loadu_si512(pairs);
}
#define _mm512_i32gather_epi64(index, p, scale) emulated_gather_pairs(index, p, scale)
#define _mm512_i32gather_pd(index, p, scale)    ((__m512d)emulated_gather_pairs(index, p, scale))

/* ---- lanes ---- */

static inline __m512i emulated_align(__m512i high, __m512i low, int n)
{
    __m512i v;
    memcpy(&v, (const char *)&low + n * 4, (size_t)(64 - n * 4));
    memcpy((char *)&v + 64 - n * 4, &high, (size_t)(n * 4));
    return v;
}
#define _mm512_alignr_epi32(high, low, n) emulated_align(high, low, n)
#define _mm512_shuffle_f32x4(a, b, which) simde_mm512_shuffle_f32x4(a, b, which)

static inline __m512i emulated_mask_sub(__m512i instead, __mmask32 m, __m512i a, __m512i b)
{
    emulated_u16s v = (emulated_u16s)instead;
    const emulated_u16s difference = (emulated_u16s)a - (emulated_u16s)b;
    for (int i = 0; i < 2 * EMULATED_LANES; i++)
        if (m >> i & 1) v[i] = difference[i];
    return (__m512i)v;
}
#define _mm512_mask_sub_epi16(instead, m, a, b) emulated_mask_sub(instead, m, a, b)

/* SIMDe leaves the sign of what is no number. */
#undef _mm512_abs_ps
#define _mm512_abs_ps(a) ((__m512)((emulated_i32s)(a)&INT32_MAX))

#undef _mm512_madd_epi16 /* SIMDe's macro has arguments of another function */
#define _mm512_madd_epi16(a, b) simde_mm512_madd_epi16(a, b)

/* ---- numbers, rounded to nearest, halves to even ---- */

static inline __m512i emulated_round(__m512 v)
{
    const __m256i low = _mm256_cvtps_epi32(_mm512_castps512_ps256(v));
    const __m256i high = _mm256_cvtps_epi32(_mm512_castps512_ps256(_mm512_shuffle_f32x4(v, v, 0xee)));
    return _mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
}
#define _mm512_cvtps_epi32(v) emulated_round(v)

static inline __m512 emulated_to_floats(__m512i v)
{
    const emulated_i32s lanes = (emulated_i32s)v;
    float floats[EMULATED_LANES];
    for (int i = 0; i < EMULATED_LANES; i++)
        floats[i] = (float)lanes[i];
    return _mm512_loadu_ps(floats);
}
#define _mm512_cvtepi32_ps(v) emulated_to_floats(v)

static inline __m512d emulated_widen(__m256 v)
{
    double doubles[EMULATED_DOUBLES];
    _mm256_storeu_pd(doubles, _mm256_cvtps_pd(_mm256_castps256_ps128(v)));
    _mm256_storeu_pd(doubles + 4, _mm256_cvtps_pd(_mm256_extractf128_ps(v, 1)));
    return _mm512_loadu_pd(doubles);
}
#define _mm512_cvtps_pd(v) emulated_widen(v)

static inline __m256 emulated_narrow(__m512d v)
{
    double doubles[EMULATED_DOUBLES];
    _mm512_storeu_pd(doubles, v);
    return _mm256_set_m128(_mm256_cvtpd_ps(_mm256_loadu_pd(doubles + 4)), _mm256_cvtpd_ps(_mm256_loadu_pd(doubles)));
}
#define _mm512_cvtpd_ps(v) emulated_narrow(v)

#endif
