/* vec.h - base: base/simd.h in C's own vectors (vector_size).
 *
 * The first part serves any number of lanes: types, and all operations that need no instruction of their own. The
 * second part completes it for one lane (plain C) and for four (SSE2, NEON); avx2.h and avx512.h complete it for eight
 * and sixteen.
 */
#ifndef ZR_SIMD_VEC_H
#define ZR_SIMD_VEC_H

#if defined ZR_KERNEL_NEON
#include <arm_neon.h>
#elif !defined ZR_KERNEL_SCALAR
#include <immintrin.h>
#endif

/* ZR_EACH_LANE(AT) is AT(0), AT(1) and so on. */
#define ZR_4_LANES(AT, i) AT(i), AT((i) + 1), AT((i) + 2), AT((i) + 3)
#define ZR_8_LANES(AT, i) ZR_4_LANES(AT, i), ZR_4_LANES(AT, (i) + 4)
#if ZR_LANES == 1
#define ZR_EACH_LANE(AT) AT(0)
#elif ZR_LANES == 4
#define ZR_EACH_LANE(AT) ZR_4_LANES(AT, 0)
#elif ZR_LANES == 8
#define ZR_EACH_LANE(AT) ZR_8_LANES(AT, 0)
#else
#define ZR_EACH_LANE(AT) ZR_8_LANES(AT, 0), ZR_8_LANES(AT, 8)
#endif
#define ZR_NUMBER(i) (i)
#define ZR_ALIKE(i)  a
#define ZR_BIT(i)    (1 << (i))

#if ZR_LANES == 1
typedef float zr_vf;
typedef int32_t zr_vi;
typedef uint32_t zr_vm; /* 1 or 0 */
typedef double zr_vd;
typedef float zr_half_vf;
enum { ZR_DOUBLES = 1 };
#define ZR_LANE(v, i)       ((void)(i), (v))
#define ZR_CONVERT(v, type) ((type)(v))
#else
#define ZR_VECTOR __attribute__((vector_size(4 * ZR_LANES)))
typedef float zr_vf ZR_VECTOR;
typedef int32_t zr_vi ZR_VECTOR;
#if defined ZR_HAS_MASKS
typedef __mmask16 zr_vm;
#else
typedef uint32_t zr_vm ZR_VECTOR; /* all bits of a lane, or none */
#endif
typedef double zr_vd ZR_VECTOR;
typedef float zr_half_vf __attribute__((vector_size(2 * ZR_LANES)));
enum { ZR_DOUBLES = ZR_LANES / 2 };
#define ZR_LANE(v, i)       ((v)[i])
#define ZR_CONVERT(v, type) __builtin_convertvector(v, type)
#endif
typedef int16_t zr_vp __attribute__((vector_size(4 * ZR_LANES)));

/* An operation that is one function: `function` takes and returns `native` vectors. */
#define ZR_UNARY(result, name, operand, native, function)                                                              \
    static inline result name(operand a)                                                                               \
    {                                                                                                                  \
        return (result)function((native)a);                                                                            \
    }
#define ZR_BINARY(result, name, operand, native, function)                                                             \
    static inline result name(operand a, operand b)                                                                    \
    {                                                                                                                  \
        return (result)function((native)a, (native)b);                                                                 \
    }

/* ---- any number of lanes ---- */

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
static inline zr_vf zr_vf_of(zr_vi a)
{
    return ZR_CONVERT(a, zr_vf);
}
/* x - 0 is x for every number, -0 too. */
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
#if ZR_LANES == 4 /* gcc 12 converts a vector of two one by one */
    return (zr_vd){(double)p[0], (double)p[1]};
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

#if !defined ZR_HAS_MASKS
/* name(a, b), and name_where(m, a, b): m and the comparison. */
#define ZR_COMPARISON(name, type, compares)                                                                            \
    static inline zr_vm name(type a, type b)                                                                           \
    {                                                                                                                  \
        return (zr_vm)(a compares b);                                                                                  \
    }                                                                                                                  \
    static inline zr_vm name##_where(zr_vm m, type a, type b)                                                          \
    {                                                                                                                  \
        return m & (zr_vm)(a compares b);                                                                              \
    }
ZR_COMPARISON(zr_vf_lt, zr_vf, <)
ZR_COMPARISON(zr_vf_le, zr_vf, <=)
ZR_COMPARISON(zr_vf_eq, zr_vf, ==)
ZR_COMPARISON(zr_vi_lt, zr_vi, <)
ZR_COMPARISON(zr_vi_eq, zr_vi, ==)

static inline zr_vm zr_vm_and(zr_vm a, zr_vm b)
{
    return a & b;
}
static inline zr_vm zr_vm_or(zr_vm a, zr_vm b)
{
    return a | b;
}
static inline zr_vm zr_vm_andnot(zr_vm a, zr_vm b)
{
    return a & ~b;
}
static inline zr_vm zr_vm_of(uint32_t bits)
{
    const zr_vi own = {ZR_EACH_LANE(ZR_BIT)};
    return zr_vi_eq(zr_vi_set((int32_t)bits) & own, own);
}
#endif

#if ZR_LANES > 1
static inline zr_vf zr_vf_abs(zr_vf a)
{
    return (zr_vf)((zr_vi)a & INT32_MAX);
}
#endif

/* Two floats from p and two from q; neither need be aligned as uint64_t is. */
typedef float zr_four_floats __attribute__((vector_size(16)));
static inline zr_four_floats zr_load_pair(const float *p, const float *q)
{
    typedef uint64_t two_pairs __attribute__((vector_size(16)));
    uint64_t low, high;
    memcpy(&low, p, sizeof low);
    memcpy(&high, q, sizeof high);
    return (zr_four_floats)(two_pairs){low, high};
}

#if ZR_LANES <= 4

/* ---- one lane ---- */

#if defined ZR_KERNEL_SCALAR

#include <math.h>

ZR_UNARY(zr_vf, zr_vf_abs, zr_vf, float, fabsf)
ZR_UNARY(zr_vf, zr_vf_sqrt, zr_vf, float, sqrtf)

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
/* Out of range gives what the vectors of x86 give, though no kernel reads it. */
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
    return n == 1   ? (zr_vi){v[0], v[0], v[1], v[2]}
           : n == 2 ? (zr_vi){v[0], v[1], v[0], v[1]}
                    : (zr_vi){v[0], v[1], v[2], v[0]};
}
static inline zr_vd zr_vd_gather(const double *p, const int32_t *i)
{
    return (zr_vd){p[i[0]], p[i[1]]};
}
static inline void zr_transpose4(zr_vf a0, zr_vf a1, zr_vf a2, zr_vf a3, zr_vf *x, zr_vf *y, zr_vf *z, zr_vf *w)
{
    const zr_vf low01 = {a0[0], a1[0], a0[1], a1[1]}, high01 = {a0[2], a1[2], a0[3], a1[3]};
    const zr_vf low23 = {a2[0], a3[0], a2[1], a3[1]}, high23 = {a2[2], a3[2], a2[3], a3[3]};
    *x = (zr_vf){low01[0], low01[1], low23[0], low23[1]};
    *y = (zr_vf){low01[2], low01[3], low23[2], low23[3]};
    *z = (zr_vf){high01[0], high01[1], high23[0], high23[1]};
    *w = (zr_vf){high01[2], high01[3], high23[2], high23[3]};
}
#define ZR_LOAD4(x, y, z, w, AT)                                                                                       \
    zr_transpose4(zr_vf_load(AT(0)), zr_vf_load(AT(1)), zr_vf_load(AT(2)), zr_vf_load(AT(3)), &(x), &(y), &(z), &(w))
#define ZR_LOAD_PAIRS(AT, i) zr_load_pair(AT(i), AT((i) + 1))

#endif

/* ---- one lane or four ---- */

#if defined ZR_KERNEL_SSE2

ZR_BINARY(zr_vf, zr_vf_min, zr_vf, __m128, _mm_min_ps)
ZR_BINARY(zr_vf, zr_vf_max, zr_vf, __m128, _mm_max_ps)
ZR_UNARY(zr_vf, zr_vf_sqrt, zr_vf, __m128, _mm_sqrt_ps)
ZR_UNARY(zr_vi, zr_vi_round, zr_vf, __m128, _mm_cvtps_epi32)
ZR_UNARY(uint32_t, zr_vm_bits, zr_vm, __m128, _mm_movemask_ps)
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

#else /* minima compare: NEON's own give NaN where either is, and order -0 and 0 */

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
/* NEON's hint for it, stnp, has no intrinsic. */
static inline void zr_vi_stream(void *p, zr_vi v)
{
    zr_vi_store(p, v);
}

#endif

#if defined ZR_KERNEL_NEON

ZR_UNARY(zr_vf, zr_vf_sqrt, zr_vf, float32x4_t, vsqrtq_f32)
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

#else

static inline zr_vi zr_vi_min(zr_vi a, zr_vi b)
{
    return zr_vi_select(zr_vi_lt(a, b), a, b);
}
static inline zr_vi zr_vi_max(zr_vi a, zr_vi b)
{
    return zr_vi_select(zr_vi_lt(b, a), a, b);
}

#endif

/* Writes no byte behind lane n - 1, as a store of all lanes would; SSE2's masked store is a non-temporal one. */
static inline void zr_vi_store_first(void *p, zr_vi v, uint32_t n)
{
    if (n == ZR_LANES) {
        zr_vi_store(p, v);
        return;
    }
    const int32_t last = n & 2 ? ZR_LANE(v, 2) : ZR_LANE(v, 0);
    if (n & 2) memcpy(p, &v, ZR_LANES > 1 ? 8 : 0);
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
/* Stores every lane, and the next one over it if it is not wanted: no branch, and no table. */
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
#endif
