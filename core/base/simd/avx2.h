/* avx2.h - base: the rest of base/simd/simd.h for AVX2 with BMI2: eight lanes. */
#ifndef ZR_SIMD_AVX2_H
#define ZR_SIMD_AVX2_H

#define ZR_PATCH_ROWS 2

ZR_BINARY(zr_vf, zr_vf_min, zr_vf, __m256, _mm256_min_ps)
ZR_BINARY(zr_vf, zr_vf_max, zr_vf, __m256, _mm256_max_ps)
ZR_BINARY(zr_vi, zr_vi_min, zr_vi, __m256i, _mm256_min_epi32)
ZR_BINARY(zr_vi, zr_vi_max, zr_vi, __m256i, _mm256_max_epi32)
ZR_UNARY(zr_vf, zr_vf_sqrt, zr_vf, __m256, _mm256_sqrt_ps)
ZR_UNARY(zr_vf, zr_vf_of, zr_vi, __m256i, _mm256_cvtepi32_ps)
ZR_UNARY(zr_vi, zr_vi_round, zr_vf, __m256, _mm256_cvtps_epi32)
ZR_UNARY(uint32_t, zr_vm_bits, zr_vm, __m256, _mm256_movemask_ps)
ZR_UNARY(zr_vd, zr_vd_sqrt, zr_vd, __m256d, _mm256_sqrt_pd)
ZR_BINARY(zr_vd, zr_vd_min, zr_vd, __m256d, _mm256_min_pd)
ZR_BINARY(zr_vd, zr_vd_max, zr_vd, __m256d, _mm256_max_pd)
ZR_BINARY(zr_vp, zr_vp_pack, zr_vi, __m256i, _mm256_packs_epi32)
ZR_BINARY(zr_vp, zr_vp_min, zr_vp, __m256i, _mm256_min_epi16)
ZR_BINARY(zr_vp, zr_vp_max, zr_vp, __m256i, _mm256_max_epi16)

static inline zr_vf zr_vf_set(float a)
{
    return (zr_vf)_mm256_set1_ps(a);
}
static inline zr_vi zr_vi_set(int32_t a)
{
    return (zr_vi)_mm256_set1_epi32(a);
}
static inline zr_vi zr_vi_ramp(void)
{
    return (zr_vi){0, 1, 2, 3, 4, 5, 6, 7};
}
static inline zr_vf zr_vf_ramp(void)
{
    return (zr_vf){0, 1, 2, 3, 4, 5, 6, 7};
}
static inline zr_vf zr_vf_load(const float *p)
{
    return (zr_vf)_mm256_loadu_ps(p);
}
static inline zr_vi zr_vi_load(const void *p)
{
    return (zr_vi)_mm256_loadu_si256((const __m256i *)p);
}
static inline void zr_vf_store(float *p, zr_vf v)
{
    _mm256_storeu_ps(p, (__m256)v);
}
static inline void zr_vi_store(void *p, zr_vi v)
{
    _mm256_storeu_si256((__m256i *)p, (__m256i)v);
}
static inline zr_vf zr_vf_select(zr_vm m, zr_vf a, zr_vf b)
{
    return (zr_vf)_mm256_blendv_ps((__m256)b, (__m256)a, (__m256)m);
}
static inline zr_vi zr_vi_select(zr_vm m, zr_vi a, zr_vi b)
{
    return (zr_vi)zr_vf_select(m, (zr_vf)a, (zr_vf)b);
}
static inline void zr_vi_store_first(void *p, zr_vi v, uint32_t n)
{
    _mm256_maskstore_epi32((int *)p, (__m256i)zr_vi_lt(zr_vi_ramp(), zr_vi_set((int32_t)n)), (__m256i)v);
}
static inline zr_vi zr_vi_load_patch(const uint32_t *p, size_t stride)
{
    const __m128i r0 = _mm_loadu_si128((const __m128i *)p), r1 = _mm_loadu_si128((const __m128i *)(p + stride));
    return (zr_vi)_mm256_inserti128_si256(_mm256_castsi128_si256(r0), r1, 1);
}
static inline void zr_vi_rows_of_patches(zr_vi v[ZR_PATCH_ROWS])
{
    const __m256i a = (__m256i)v[0], b = (__m256i)v[1];
    v[0] = (zr_vi)_mm256_permute2x128_si256(a, b, 0x20);
    v[1] = (zr_vi)_mm256_permute2x128_si256(a, b, 0x31);
}
static inline zr_vi zr_vi_later(zr_vi v, int n)
{
    return (zr_vi)_mm256_permutevar8x32_epi32((__m256i)v, (__m256i)(zr_vi_ramp() - zr_vi_set(n)));
}
static inline void zr_vi_stream(void *p, zr_vi v)
{
    _mm256_stream_si256((__m256i *)p, (__m256i)v);
}

/* The fours at AT(i) and AT(i + 4). */
#define ZR_LOAD_EVERY_FOURTH(AT, i)                                                                                    \
    _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(AT(i))), _mm_loadu_ps(AT((i) + 4)), 1)

#define ZR_LOAD4(x, y, z, w, AT)                                                                                       \
    do {                                                                                                               \
        const __m256 a0 = ZR_LOAD_EVERY_FOURTH(AT, 0), a1 = ZR_LOAD_EVERY_FOURTH(AT, 1);                               \
        const __m256 a2 = ZR_LOAD_EVERY_FOURTH(AT, 2), a3 = ZR_LOAD_EVERY_FOURTH(AT, 3);                               \
        zr_transpose4((zr_vf)a0, (zr_vf)a1, (zr_vf)a2, (zr_vf)a3, &(x), &(y), &(z), &(w));                             \
    } while (0)

static inline void zr_transpose4(zr_vf a0, zr_vf a1, zr_vf a2, zr_vf a3, zr_vf *x, zr_vf *y, zr_vf *z, zr_vf *w)
{
    const __m256d low01 = (__m256d)_mm256_unpacklo_ps((__m256)a0, (__m256)a1);
    const __m256d high01 = (__m256d)_mm256_unpackhi_ps((__m256)a0, (__m256)a1);
    const __m256d low23 = (__m256d)_mm256_unpacklo_ps((__m256)a2, (__m256)a3);
    const __m256d high23 = (__m256d)_mm256_unpackhi_ps((__m256)a2, (__m256)a3);
    *x = (zr_vf)_mm256_unpacklo_pd(low01, low23);
    *y = (zr_vf)_mm256_unpackhi_pd(low01, low23);
    *z = (zr_vf)_mm256_unpacklo_pd(high01, high23);
    *w = (zr_vf)_mm256_unpackhi_pd(high01, high23);
}

/* Pairs i, i + 1, i + 4, i + 5: the order of zr_vp_pack. */
#define ZR_LOAD_PAIRS(AT, i)                                                                                           \
    _mm256_insertf128_ps(_mm256_castps128_ps256(zr_load_pair(AT(i), AT((i) + 1))),                                     \
                         zr_load_pair(AT((i) + 4), AT((i) + 5)), 1)

static inline zr_vi zr_vp_cross(zr_vp a, zr_vp b)
{
    const __m256i y_x = _mm256_or_si256(_mm256_slli_epi32((__m256i)b, 16), _mm256_srli_epi32((__m256i)b, 16));
    return (zr_vi)_mm256_madd_epi16((__m256i)a, _mm256_sign_epi16(y_x, _mm256_set1_epi32((int32_t)0xffff0001)));
}

static inline zr_vf zr_vf_pick(zr_vf v, zr_vi i)
{
    return (zr_vf)_mm256_permutevar8x32_ps((__m256)v, (__m256i)i);
}
static inline zr_vi zr_vi_gather(zr_vm m, const void *p, zr_vi i)
{
    return (zr_vi)_mm256_mask_i32gather_epi32(_mm256_setzero_si256(), (const int *)p, (__m256i)i, (__m256i)m, 4);
}

static inline void zr_vf_store4(float *p, zr_vf x, zr_vf y, zr_vf z, zr_vf w)
{
    zr_vf a, b, c, d; /* lanes 0 and 4, 1 and 5, 2 and 6, 3 and 7 */
    zr_transpose4(x, y, z, w, &a, &b, &c, &d);
    _mm256_storeu_ps(p, _mm256_permute2f128_ps((__m256)a, (__m256)b, 0x20));
    _mm256_storeu_ps(p + 8, _mm256_permute2f128_ps((__m256)c, (__m256)d, 0x20));
    _mm256_storeu_ps(p + 16, _mm256_permute2f128_ps((__m256)a, (__m256)b, 0x31));
    _mm256_storeu_ps(p + 24, _mm256_permute2f128_ps((__m256)c, (__m256)d, 0x31));
}

/* zr_fronts[bits] lists the lanes of a mask, one byte each. Without this table a million triangles take a sixth
 * longer. */
#define ZR_HAS_LIST_BITS
#define ZR_FRONT_LANE(m, i) ((uint64_t)((m) >> (i)&1u ? (i) : 0u) << (8 * __builtin_popcount((m) & ((1u << (i)) - 1u))))
#define ZR_FRONT(m)                                                                                                    \
    (ZR_FRONT_LANE(m, 0u) | ZR_FRONT_LANE(m, 1u) | ZR_FRONT_LANE(m, 2u) | ZR_FRONT_LANE(m, 3u) |                       \
     ZR_FRONT_LANE(m, 4u) | ZR_FRONT_LANE(m, 5u) | ZR_FRONT_LANE(m, 6u) | ZR_FRONT_LANE(m, 7u))
#define ZR_FRONTS_4(m)  ZR_FRONT(m), ZR_FRONT((m) + 1u), ZR_FRONT((m) + 2u), ZR_FRONT((m) + 3u)
#define ZR_FRONTS_16(m) ZR_FRONTS_4(m), ZR_FRONTS_4((m) + 4u), ZR_FRONTS_4((m) + 8u), ZR_FRONTS_4((m) + 12u)
#define ZR_FRONTS_64(m) ZR_FRONTS_16(m), ZR_FRONTS_16((m) + 16u), ZR_FRONTS_16((m) + 32u), ZR_FRONTS_16((m) + 48u)
static const uint64_t zr_fronts[256] = {ZR_FRONTS_64(0u), ZR_FRONTS_64(64u), ZR_FRONTS_64(128u), ZR_FRONTS_64(192u)};

static inline zr_vi zr_front_of(uint32_t bits)
{
    return (zr_vi)_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)&zr_fronts[bits]));
}
static inline uint32_t zr_vi_compress(void *p, zr_vm m, zr_vi v)
{
    const uint32_t bits = zr_vm_bits(m);
    zr_vi_store(p, (zr_vi)_mm256_permutevar8x32_epi32((__m256i)v, (__m256i)zr_front_of(bits)));
    return (uint32_t)__builtin_popcount(bits);
}
static inline uint32_t zr_vi_list_bits(void *p, uint32_t bits, int32_t first)
{
    zr_vi_store(p, zr_front_of(bits) + zr_vi_set(first));
    return (uint32_t)__builtin_popcount(bits);
}

static inline zr_vd zr_vd_set(double a)
{
    return (zr_vd)_mm256_set1_pd(a);
}
static inline void zr_vd_store(double *p, zr_vd v)
{
    _mm256_storeu_pd(p, (__m256d)v);
}
static inline zr_vd zr_vd_widen(const float *p)
{
    return (zr_vd)_mm256_cvtps_pd(_mm_loadu_ps(p));
}
static inline void zr_vd_narrow(float *p, zr_vd v)
{
    _mm_storeu_ps(p, _mm256_cvtpd_ps((__m256d)v));
}
static inline zr_vd zr_vd_gather(const double *p, const int32_t *i)
{
    return (zr_vd)_mm256_i32gather_pd(p, _mm_loadu_si128((const __m128i *)(const void *)i), 8);
}

#endif
