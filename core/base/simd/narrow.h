/* narrow.h - base: the rest of base/simd/simd.h for vectors of one lane (plain C) and of four (SSE2, NEON,
 * WebAssembly). */
#ifndef ZR_SIMD_NARROW_H
#define ZR_SIMD_NARROW_H

/* ---- all three: constants, memory, conversions ---- */

static inline zr_vf zr_vf_set(float a)
{
    return (zr_vf){ZR_EACH_LANE(ZR_ALIKE)};
}
static inline zr_vi zr_vi_set(int32_t a)
{
    return (zr_vi){ZR_EACH_LANE(ZR_ALIKE)};
}
static inline zr_vi zr_vi_ramp(void)
{
    return (zr_vi){ZR_EACH_LANE(ZR_NUMBER)};
}
static inline zr_vf zr_vf_ramp(void)
{
    return (zr_vf){ZR_EACH_LANE(ZR_NUMBER)};
}
static inline zr_vf zr_vf_load(const float *p)
{
    zr_vf v;
    memcpy(&v, p, sizeof v);
    return v;
}
static inline zr_vi zr_vi_load(const void *p)
{
    zr_vi v;
    memcpy(&v, p, sizeof v);
    return v;
}
static inline void zr_vf_store(float *p, zr_vf v)
{
    memcpy(p, &v, sizeof v);
}
static inline void zr_vi_store(void *p, zr_vi v)
{
    memcpy(p, &v, sizeof v);
}
static inline zr_vf zr_vf_of(zr_vi a)
{
    return ZR_CONVERT(a, zr_vf);
}
/* a - 0 is a for every number, -0 as well. */
static inline zr_vd zr_vd_set(double a)
{
    return a - (zr_vd){0};
}
static inline void zr_vd_store(double *p, zr_vd v)
{
    memcpy(p, &v, sizeof v);
}
static inline zr_vd zr_vd_widen(const float *p)
{
#if defined ZR_KERNEL_SSE2 /* gcc 12 converts a vector of two one by one */
    return (zr_vd)_mm_cvtps_pd((__m128)_mm_loadl_epi64((const __m128i *)(const void *)p));
#else
    zr_half_vf v;
    memcpy(&v, p, sizeof v);
    return ZR_CONVERT(v, zr_vd);
#endif
}
static inline void zr_vd_narrow(float *p, zr_vd v)
{
    const zr_half_vf narrow = ZR_CONVERT(v, zr_half_vf);
    memcpy(p, &narrow, sizeof narrow);
}

/* ---- one lane ---- */

#if defined ZR_KERNEL_SCALAR

#include <math.h>

ZR_UNARY(zr_vf, zr_vf_abs, zr_vf, float, fabsf)
ZR_UNARY(zr_vf, zr_vf_sqrt, zr_vf, float, sqrtf)
ZR_UNARY(zr_vd, zr_vd_sqrt, zr_vd, double, sqrt)

static inline zr_vf zr_vf_bits(zr_vi a)
{
    zr_vf v;
    memcpy(&v, &a, sizeof v);
    return v;
}
static inline zr_vi zr_vi_bits_of(zr_vf a)
{
    zr_vi v;
    memcpy(&v, &a, sizeof v);
    return v;
}
static inline zr_vf zr_vf_select(zr_vm m, zr_vf a, zr_vf b)
{
    return m ? a : b;
}
static inline zr_vi zr_vi_select(zr_vm m, zr_vi a, zr_vi b)
{
    return m ? a : b;
}
static inline zr_vi zr_vi_later(zr_vi v, int n)
{
    (void)n;
    return v;
}
static inline uint32_t zr_vm_bits(zr_vm m)
{
    return m;
}
/* Out of range: INT32_MIN, as with SSE2. No kernel reads it. */
static inline zr_vi zr_vi_round(zr_vf a)
{
    return fabsf(a) < 0x1p31f ? (int32_t)rintf(a) : INT32_MIN;
}
static inline zr_vd zr_vd_min(zr_vd a, zr_vd b)
{
    return a < b ? a : b;
}
static inline zr_vd zr_vd_max(zr_vd a, zr_vd b)
{
    return a > b ? a : b;
}
static inline zr_vd zr_vd_gather(const double *p, const int32_t *i)
{
    return p[*i];
}
static inline void zr_transpose4(zr_vf a0, zr_vf a1, zr_vf a2, zr_vf a3, zr_vf *x, zr_vf *y, zr_vf *z, zr_vf *w)
{
    *x = a0, *y = a1, *z = a2, *w = a3;
}
#define ZR_LOAD4(x, y, z, w, AT)                                                                                       \
    do {                                                                                                               \
        const float *const at = AT(0);                                                                                 \
        (x) = at[0], (y) = at[1], (z) = at[2], (w) = at[3];                                                            \
    } while (0)
static inline void zr_load_corners(const float *vertices, const uint32_t *corners, zr_vf low[3], zr_vf high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = vertices[4 * (size_t)corners[k]];
        high[k] = vertices[4 * (size_t)corners[k] + 1];
    }
}
static inline zr_vp zr_vp_pack(zr_vi low, zr_vi high)
{
    const zr_vi least = INT16_MIN, most = INT16_MAX;
    const zr_vi x = low < least ? least : low > most ? most : low;
    const zr_vi y = high < least ? least : high > most ? most : high;
    return (zr_vp)(y << 16 | (x & 0xffff));
}
static inline zr_vp zr_vp_min(zr_vp a, zr_vp b)
{
    return (zr_vp){a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1]};
}
static inline zr_vp zr_vp_max(zr_vp a, zr_vp b)
{
    return (zr_vp){a[0] > b[0] ? a[0] : b[0], a[1] > b[1] ? a[1] : b[1]};
}

/* ---- four lanes ---- */

#else

static inline zr_vi zr_vi_select(zr_vm m, zr_vi a, zr_vi b)
{
    return ((zr_vi)m & a) | (~(zr_vi)m & b);
}
static inline zr_vf zr_vf_select(zr_vm m, zr_vf a, zr_vf b)
{
    return (zr_vf)zr_vi_select(m, (zr_vi)a, (zr_vi)b);
}
static inline zr_vi zr_vi_later(zr_vi v, int n)
{
    return n == 1 ? (zr_vi){v[0], v[0], v[1], v[2]}
           : n == 2 ? (zr_vi){v[0], v[1], v[0], v[1]}
                    : (zr_vi){v[0], v[1], v[2], v[0]};
}
static inline zr_vd zr_vd_gather(const double *p, const int32_t *i)
{
    return (zr_vd){p[i[0]], p[i[1]]};
}
/* Lanes of a (0 .. 3) and b (4 .. 7). */
#ifdef __clang__
#define ZR_SHUFFLE(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#else
#define ZR_SHUFFLE(a, b, ...) __builtin_shuffle(a, b, (zr_vi){__VA_ARGS__})
#endif
static inline void zr_transpose4(zr_vf a0, zr_vf a1, zr_vf a2, zr_vf a3, zr_vf *x, zr_vf *y, zr_vf *z, zr_vf *w)
{
    const zr_vf low01 = ZR_SHUFFLE(a0, a1, 0, 4, 1, 5), high01 = ZR_SHUFFLE(a0, a1, 2, 6, 3, 7);
    const zr_vf low23 = ZR_SHUFFLE(a2, a3, 0, 4, 1, 5), high23 = ZR_SHUFFLE(a2, a3, 2, 6, 3, 7);
    *x = ZR_SHUFFLE(low01, low23, 0, 1, 4, 5);
    *y = ZR_SHUFFLE(low01, low23, 2, 3, 6, 7);
    *z = ZR_SHUFFLE(high01, high23, 0, 1, 4, 5);
    *w = ZR_SHUFFLE(high01, high23, 2, 3, 6, 7);
}
#define ZR_LOAD4(x, y, z, w, AT)                                                                                       \
    zr_transpose4(zr_vf_load(AT(0)), zr_vf_load(AT(1)), zr_vf_load(AT(2)), zr_vf_load(AT(3)), &(x), &(y), &(z), &(w))
#define ZR_LOAD_PAIRS(AT, i) zr_load_pair(AT(i), AT((i) + 1))

#endif

/* ---- SSE2 ---- */

#if defined ZR_KERNEL_SSE2

ZR_BINARY(zr_vf, zr_vf_min, zr_vf, __m128, _mm_min_ps)
ZR_BINARY(zr_vf, zr_vf_max, zr_vf, __m128, _mm_max_ps)
ZR_UNARY(zr_vf, zr_vf_sqrt, zr_vf, __m128, _mm_sqrt_ps)
ZR_UNARY(zr_vi, zr_vi_round, zr_vf, __m128, _mm_cvtps_epi32)
ZR_UNARY(uint32_t, zr_vm_bits, zr_vm, __m128, _mm_movemask_ps)
ZR_UNARY(zr_vd, zr_vd_sqrt, zr_vd, __m128d, _mm_sqrt_pd)
ZR_BINARY(zr_vd, zr_vd_min, zr_vd, __m128d, _mm_min_pd)
ZR_BINARY(zr_vd, zr_vd_max, zr_vd, __m128d, _mm_max_pd)
ZR_BINARY(zr_vp, zr_vp_pack, zr_vi, __m128i, _mm_packs_epi32)
ZR_BINARY(zr_vp, zr_vp_min, zr_vp, __m128i, _mm_min_epi16)
ZR_BINARY(zr_vp, zr_vp_max, zr_vp, __m128i, _mm_max_epi16)

static inline zr_vi zr_vp_cross(zr_vp a, zr_vp b)
{
    const __m128i y_x = _mm_or_si128(_mm_slli_epi32((__m128i)b, 16), _mm_srli_epi32((__m128i)b, 16));
    const __m128i upper = _mm_set1_epi32((int32_t)0xffff0000);
    return (zr_vi)_mm_madd_epi16((__m128i)a, _mm_sub_epi16(_mm_xor_si128(y_x, upper), upper)); /* y, -x */
}
static inline void zr_vi_stream(void *p, zr_vi v)
{
    _mm_stream_si128((__m128i *)p, (__m128i)v);
}

/* ---- WebAssembly ---- */

#elif defined ZR_KERNEL_WASM

/* pmin(b, a) is a < b ? a : b. */
ZR_UNARY(zr_vf, zr_vf_sqrt, zr_vf, v128_t, wasm_f32x4_sqrt)
ZR_UNARY(zr_vd, zr_vd_sqrt, zr_vd, v128_t, wasm_f64x2_sqrt)
ZR_UNARY(uint32_t, zr_vm_bits, zr_vm, v128_t, wasm_i32x4_bitmask)
ZR_BINARY(zr_vi, zr_vi_min, zr_vi, v128_t, wasm_i32x4_min)
ZR_BINARY(zr_vi, zr_vi_max, zr_vi, v128_t, wasm_i32x4_max)
ZR_BINARY(zr_vp, zr_vp_pack, zr_vi, v128_t, wasm_i16x8_narrow_i32x4)
ZR_BINARY(zr_vp, zr_vp_min, zr_vp, v128_t, wasm_i16x8_min)
ZR_BINARY(zr_vp, zr_vp_max, zr_vp, v128_t, wasm_i16x8_max)

static inline zr_vf zr_vf_min(zr_vf a, zr_vf b)
{
    return (zr_vf)wasm_f32x4_pmin((v128_t)b, (v128_t)a);
}
static inline zr_vf zr_vf_max(zr_vf a, zr_vf b)
{
    return (zr_vf)wasm_f32x4_pmax((v128_t)b, (v128_t)a);
}
static inline zr_vd zr_vd_min(zr_vd a, zr_vd b)
{
    return (zr_vd)wasm_f64x2_pmin((v128_t)b, (v128_t)a);
}
static inline zr_vd zr_vd_max(zr_vd a, zr_vd b)
{
    return (zr_vd)wasm_f64x2_pmax((v128_t)b, (v128_t)a);
}
/* 1.5 * 2^23 leaves no bits behind the point: the sum is rounded to even, and its bits count from those of 1.5 * 2^23.
 * Conversions of WebAssembly truncate and check for NaN, which takes five times as many instructions. */
static inline zr_vi zr_vi_round(zr_vf a)
{
    return (zr_vi)(a + 0x1.8p23f) - 0x4b400000;
}
static inline zr_vi zr_vp_cross(zr_vp a, zr_vp b)
{
    const zr_vi y_x = (zr_vi)((zr_vm)b << 16 | (zr_vm)b >> 16);
    const zr_vp sign = (zr_vp)zr_vi_set((int32_t)0xffff0000);
    return (zr_vi)wasm_i32x4_dot_i16x8((v128_t)a, (v128_t)(((zr_vp)y_x ^ sign) - sign)); /* y, -x */
}
static inline void zr_vi_stream(void *p, zr_vi v)
{
    zr_vi_store(p, v);
}

/* ---- plain C and NEON ---- */

#else

/* NEON's vminq and vmaxq give NaN where either operand is one, and order -0 and 0. */
static inline zr_vf zr_vf_min(zr_vf a, zr_vf b)
{
    return zr_vf_select(zr_vf_lt(a, b), a, b);
}
static inline zr_vf zr_vf_max(zr_vf a, zr_vf b)
{
    return zr_vf_select(zr_vf_lt(b, a), a, b);
}
static inline zr_vi zr_vp_cross(zr_vp a, zr_vp b)
{
    const zr_vi ax = (zr_vi)a << 16 >> 16, ay = (zr_vi)a >> 16, bx = (zr_vi)b << 16 >> 16, by = (zr_vi)b >> 16;
    return ax * by - ay * bx;
}
/* No intrinsic gives NEON's stnp. */
static inline void zr_vi_stream(void *p, zr_vi v)
{
    zr_vi_store(p, v);
}

#endif

/* ---- NEON ---- */

#if defined ZR_KERNEL_NEON

ZR_UNARY(zr_vf, zr_vf_sqrt, zr_vf, float32x4_t, vsqrtq_f32)
ZR_UNARY(zr_vd, zr_vd_sqrt, zr_vd, float64x2_t, vsqrtq_f64)
ZR_UNARY(zr_vi, zr_vi_round, zr_vf, float32x4_t, vcvtnq_s32_f32)
ZR_BINARY(zr_vi, zr_vi_min, zr_vi, int32x4_t, vminq_s32)
ZR_BINARY(zr_vi, zr_vi_max, zr_vi, int32x4_t, vmaxq_s32)
ZR_BINARY(zr_vp, zr_vp_min, zr_vp, int16x8_t, vminq_s16)
ZR_BINARY(zr_vp, zr_vp_max, zr_vp, int16x8_t, vmaxq_s16)

static inline uint32_t zr_vm_bits(zr_vm m)
{
    const zr_vm own = {1, 2, 4, 8};
    return vaddvq_u32((uint32x4_t)(m & own));
}
static inline zr_vp zr_vp_pack(zr_vi low, zr_vi high)
{
    return (zr_vp)vcombine_s16(vqmovn_s32((int32x4_t)low), vqmovn_s32((int32x4_t)high));
}
static inline zr_vd zr_vd_min(zr_vd a, zr_vd b)
{
    return (zr_vd)vbslq_f64((uint64x2_t)(a < b), (float64x2_t)a, (float64x2_t)b);
}
static inline zr_vd zr_vd_max(zr_vd a, zr_vd b)
{
    return (zr_vd)vbslq_f64((uint64x2_t)(a > b), (float64x2_t)a, (float64x2_t)b);
}

#elif !defined ZR_KERNEL_WASM

static inline zr_vi zr_vi_min(zr_vi a, zr_vi b)
{
    return zr_vi_select(zr_vi_lt(a, b), a, b);
}
static inline zr_vi zr_vi_max(zr_vi a, zr_vi b)
{
    return zr_vi_select(zr_vi_lt(b, a), a, b);
}

#endif

/* ---- all three: lanes one by one ---- */

/* Not by SSE2's maskmovdqu, which is a non-temporal store. */
static inline void zr_vi_store_first(void *p, zr_vi v, uint32_t n)
{
    if (n == ZR_LANES) {
        zr_vi_store(p, v);
        return;
    }
    const int32_t last = n & 2 ? ZR_LANE(v, 2) : ZR_LANE(v, 0);
    if (n & 2) memcpy(p, &v, sizeof v / 2);
    if (n & 1) memcpy((char *)p + 4 * (n & 2), &last, sizeof last);
}
static inline zr_vf zr_vf_pick(zr_vf v, zr_vi i)
{
#define ZR_PICKED(k) ZR_LANE(v, ZR_LANE(i, k))
    return (zr_vf){ZR_EACH_LANE(ZR_PICKED)};
#undef ZR_PICKED
}
static inline zr_vi zr_vi_gather(zr_vm m, const void *p, zr_vi i)
{
    int32_t lanes[ZR_LANES] = {0};
    for (uint32_t bits = zr_vm_bits(m), k = 0; k < ZR_LANES; k++)
        if (bits >> k & 1u) memcpy(&lanes[k], (const char *)p + 4 * (ptrdiff_t)ZR_LANE(i, k), sizeof lanes[k]);
#define ZR_GATHERED(k) lanes[k]
    return (zr_vi){ZR_EACH_LANE(ZR_GATHERED)};
#undef ZR_GATHERED
}
/* Stores every lane; the next one overwrites it if m leaves it out. This needs no branch and no table. */
static inline uint32_t zr_vi_compress(void *p, zr_vm m, zr_vi v)
{
    const uint32_t bits = zr_vm_bits(m);
    uint32_t count = 0;
    for (int i = 0; i < ZR_LANES; i++) {
        const int32_t lane = ZR_LANE(v, i);
        memcpy((char *)p + 4 * (size_t)count, &lane, sizeof lane);
        count += bits >> i & 1u;
    }
    return count;
}

#endif
