/* avx512.h - base: the rest of base/simd/simd.h for AVX-512 F, BW, DQ and VL with BMI2: sixteen lanes, and registers
 * for masks. */
#ifndef ZR_SIMD_AVX512_H
#define ZR_SIMD_AVX512_H

#define ZR_PATCH_ROWS 4

ZR_BINARY(zr_vf, zr_vf_min, zr_vf, __m512, _mm512_min_ps)
ZR_BINARY(zr_vf, zr_vf_max, zr_vf, __m512, _mm512_max_ps)
ZR_BINARY(zr_vi, zr_vi_min, zr_vi, __m512i, _mm512_min_epi32)
ZR_BINARY(zr_vi, zr_vi_max, zr_vi, __m512i, _mm512_max_epi32)
ZR_UNARY(zr_vf, zr_vf_sqrt, zr_vf, __m512, _mm512_sqrt_ps)
ZR_UNARY(zr_vf, zr_vf_of, zr_vi, __m512i, _mm512_cvtepi32_ps)
ZR_UNARY(zr_vi, zr_vi_round, zr_vf, __m512, _mm512_cvtps_epi32)
ZR_UNARY(zr_vd, zr_vd_sqrt, zr_vd, __m512d, _mm512_sqrt_pd)
ZR_BINARY(zr_vd, zr_vd_min, zr_vd, __m512d, _mm512_min_pd)
ZR_BINARY(zr_vd, zr_vd_max, zr_vd, __m512d, _mm512_max_pd)
ZR_BINARY(zr_vp, zr_vp_pack, zr_vi, __m512i, _mm512_packs_epi32)
ZR_BINARY(zr_vp, zr_vp_min, zr_vp, __m512i, _mm512_min_epi16)
ZR_BINARY(zr_vp, zr_vp_max, zr_vp, __m512i, _mm512_max_epi16)

static inline zr_vf zr_vf_set(float a)
{
    return (zr_vf)_mm512_set1_ps(a);
}
static inline zr_vi zr_vi_set(int32_t a)
{
    return (zr_vi)_mm512_set1_epi32(a);
}
static inline zr_vi zr_vi_ramp(void)
{
    return (zr_vi){0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
}
static inline zr_vf zr_vf_ramp(void)
{
    return (zr_vf){0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
}
static inline zr_vf zr_vf_load(const float *p)
{
    return (zr_vf)_mm512_loadu_ps(p);
}
static inline zr_vi zr_vi_load(const void *p)
{
    return (zr_vi)_mm512_loadu_si512(p);
}
static inline void zr_vf_store(float *p, zr_vf v)
{
    _mm512_storeu_ps(p, (__m512)v);
}
static inline void zr_vi_store(void *p, zr_vi v)
{
    _mm512_storeu_si512(p, (__m512i)v);
}
static inline void zr_vi_store_first(void *p, zr_vi v, uint32_t n)
{
    _mm512_mask_storeu_epi32(p, (__mmask16)_bzhi_u32(0xffff, n), (__m512i)v);
}
static inline zr_vi zr_vi_load_patch(const uint32_t *p, size_t stride)
{
    const __m128i r0 = _mm_loadu_si128((const __m128i *)p), r1 = _mm_loadu_si128((const __m128i *)(p + stride));
    const __m128i r2 = _mm_loadu_si128((const __m128i *)(p + 2 * stride));
    const __m128i r3 = _mm_loadu_si128((const __m128i *)(p + 3 * stride));
    const __m256i low = _mm256_inserti128_si256(_mm256_castsi128_si256(r0), r1, 1);
    const __m256i high = _mm256_inserti128_si256(_mm256_castsi128_si256(r2), r3, 1);
    return (zr_vi)_mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
}
static inline void zr_vi_rows_of_patches(zr_vi v[ZR_PATCH_ROWS])
{
    const __m512i a = (__m512i)v[0], b = (__m512i)v[1], c = (__m512i)v[2], d = (__m512i)v[3];
    const __m512i low_ab = _mm512_shuffle_i32x4(a, b, 0x44), high_ab = _mm512_shuffle_i32x4(a, b, 0xee);
    const __m512i low_cd = _mm512_shuffle_i32x4(c, d, 0x44), high_cd = _mm512_shuffle_i32x4(c, d, 0xee);
    v[0] = (zr_vi)_mm512_shuffle_i32x4(low_ab, low_cd, 0x88);
    v[1] = (zr_vi)_mm512_shuffle_i32x4(low_ab, low_cd, 0xdd);
    v[2] = (zr_vi)_mm512_shuffle_i32x4(high_ab, high_cd, 0x88);
    v[3] = (zr_vi)_mm512_shuffle_i32x4(high_ab, high_cd, 0xdd);
}
#define zr_vi_later(v, n) ((zr_vi)_mm512_alignr_epi32((__m512i)(v), (__m512i)(v), 16 - (n)))
static inline void zr_vi_store_where(void *p, zr_vm m, zr_vi v)
{
    _mm512_mask_storeu_epi32(p, m, (__m512i)v);
}
static inline void zr_vi_stream(void *p, zr_vi v)
{
    _mm512_stream_si512(p, (__m512i)v);
}
static inline zr_vm zr_vf_lt(zr_vf a, zr_vf b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ);
}
static inline zr_vm zr_vf_le(zr_vf a, zr_vf b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LE_OQ);
}
static inline zr_vm zr_vf_eq(zr_vf a, zr_vf b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_EQ_OQ);
}
static inline zr_vm zr_vi_lt(zr_vi a, zr_vi b)
{
    return _mm512_cmplt_epi32_mask((__m512i)a, (__m512i)b);
}
static inline zr_vm zr_vi_eq(zr_vi a, zr_vi b)
{
    return _mm512_cmpeq_epi32_mask((__m512i)a, (__m512i)b);
}
static inline zr_vm zr_vf_lt_where(zr_vm m, zr_vf a, zr_vf b)
{
    return _mm512_mask_cmp_ps_mask(m, (__m512)a, (__m512)b, _CMP_LT_OQ);
}
static inline zr_vm zr_vf_eq_where(zr_vm m, zr_vf a, zr_vf b)
{
    return _mm512_mask_cmp_ps_mask(m, (__m512)a, (__m512)b, _CMP_EQ_OQ);
}
static inline zr_vm zr_vi_lt_where(zr_vm m, zr_vi a, zr_vi b)
{
    return _mm512_mask_cmplt_epi32_mask(m, (__m512i)a, (__m512i)b);
}
static inline zr_vm zr_vm_and(zr_vm a, zr_vm b)
{
    return _kand_mask16(a, b);
}
static inline zr_vm zr_vm_or(zr_vm a, zr_vm b)
{
    return _kor_mask16(a, b);
}
static inline zr_vm zr_vm_andnot(zr_vm a, zr_vm b)
{
    return _kandn_mask16(b, a);
}
static inline uint32_t zr_vm_bits(zr_vm m)
{
    return _cvtmask16_u32(m);
}
static inline zr_vm zr_vm_of(uint32_t bits)
{
    return _cvtu32_mask16(bits);
}
static inline zr_vf zr_vf_select(zr_vm m, zr_vf a, zr_vf b)
{
    return (zr_vf)_mm512_mask_blend_ps(m, (__m512)b, (__m512)a);
}
static inline zr_vi zr_vi_select(zr_vm m, zr_vi a, zr_vi b)
{
    return (zr_vi)_mm512_mask_blend_epi32(m, (__m512i)b, (__m512i)a);
}

/* The fours at AT(i), AT(i + 4), AT(i + 8) and AT(i + 12). */
#define ZR_LOAD_EVERY_FOURTH(AT, i)                                                                                    \
    _mm512_insertf32x4(_mm512_insertf32x4(_mm512_insertf32x4(_mm512_castps128_ps512(_mm_loadu_ps(AT(i))),              \
                                                             _mm_loadu_ps(AT(i + 4)), 1),                              \
                                          _mm_loadu_ps(AT(i + 8)), 2),                                                 \
                       _mm_loadu_ps(AT(i + 12)), 3)

#define ZR_LOAD4(x, y, z, w, AT)                                                                                       \
    do {                                                                                                               \
        const __m512 a0 = ZR_LOAD_EVERY_FOURTH(AT, 0), a1 = ZR_LOAD_EVERY_FOURTH(AT, 1);                               \
        const __m512 a2 = ZR_LOAD_EVERY_FOURTH(AT, 2), a3 = ZR_LOAD_EVERY_FOURTH(AT, 3);                               \
        zr_transpose4((zr_vf)a0, (zr_vf)a1, (zr_vf)a2, (zr_vf)a3, &(x), &(y), &(z), &(w));                             \
    } while (0)

static inline void zr_transpose4(zr_vf a0, zr_vf a1, zr_vf a2, zr_vf a3, zr_vf *x, zr_vf *y, zr_vf *z, zr_vf *w)
{
    const __m512d low01 = (__m512d)_mm512_unpacklo_ps((__m512)a0, (__m512)a1);
    const __m512d high01 = (__m512d)_mm512_unpackhi_ps((__m512)a0, (__m512)a1);
    const __m512d low23 = (__m512d)_mm512_unpacklo_ps((__m512)a2, (__m512)a3);
    const __m512d high23 = (__m512d)_mm512_unpackhi_ps((__m512)a2, (__m512)a3);
    *x = (zr_vf)_mm512_unpacklo_pd(low01, low23);
    *y = (zr_vf)_mm512_unpackhi_pd(low01, low23);
    *z = (zr_vf)_mm512_unpacklo_pd(high01, high23);
    *w = (zr_vf)_mm512_unpackhi_pd(high01, high23);
}

static inline zr_vf zr_vf_pick(zr_vf v, zr_vi i)
{
    return (zr_vf)_mm512_permutexvar_ps((__m512i)i, (__m512)v);
}
static inline zr_vi zr_vi_gather(zr_vm m, const void *p, zr_vi i)
{
    return (zr_vi)_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), m, (__m512i)i, p, 4);
}
/* x and y are one gather of 8 bytes: a tenth of the time of painting a million flat triangles. */
#define ZR_HAS_GATHER_FOURS
static inline void zr_vf_gather_fours(const float *p, zr_vi i, zr_vf *x, zr_vf *y, zr_vf *z)
{
    const __m512i pair = _mm512_slli_epi32((__m512i)i, 1);
    const __m256i low = _mm512_castsi512_si256(pair), high = _mm512_extracti64x4_epi64(pair, 1);
    const __m512 a = (__m512)_mm512_i32gather_epi64(low, p, 8);
    const __m512 b = (__m512)_mm512_i32gather_epi64(high, p, 8);
    const __m512i even = (__m512i)(zr_vi_ramp() * 2), odd = _mm512_or_si512(even, _mm512_set1_epi32(1));
    *x = (zr_vf)_mm512_permutex2var_ps(a, even, b);
    *y = (zr_vf)_mm512_permutex2var_ps(a, odd, b);
    *z = (zr_vf)_mm512_i32gather_ps(_mm512_slli_epi32(pair, 1), p + 2, 4);
}

static inline zr_vd zr_vd_set(double a)
{
    return (zr_vd)_mm512_set1_pd(a);
}
static inline void zr_vd_store(double *p, zr_vd v)
{
    _mm512_storeu_pd(p, (__m512d)v);
}
static inline zr_vd zr_vd_widen(const float *p)
{
    return (zr_vd)_mm512_cvtps_pd(_mm256_loadu_ps(p));
}
static inline void zr_vd_narrow(float *p, zr_vd v)
{
    _mm256_storeu_ps(p, _mm512_cvtpd_ps((__m512d)v));
}
static inline zr_vd zr_vd_gather(const double *p, const int32_t *i)
{
    return (zr_vd)_mm512_i32gather_pd(_mm256_loadu_si256((const __m256i *)(const void *)i), p, 8);
}

/* Pairs i, i + 1, i + 4, i + 5 and so on: the order of zr_vp_pack. Gathers of pairs need fewer instructions, but with
 * them sorting a million triangles took 8 % longer on a Zen 5. */
#define ZR_LOAD_PAIRS(AT, i)                                                                                           \
    _mm512_insertf32x4(_mm512_insertf32x4(_mm512_insertf32x4(_mm512_castps128_ps512(zr_load_pair(AT(i), AT((i) + 1))), \
                                                             zr_load_pair(AT((i) + 4), AT((i) + 5)), 1),               \
                                          zr_load_pair(AT((i) + 8), AT((i) + 9)), 2),                                  \
                       zr_load_pair(AT((i) + 12), AT((i) + 13)), 3)

static inline zr_vi zr_vp_cross(zr_vp a, zr_vp b)
{
    const __m512i y_x = _mm512_rol_epi32((__m512i)b, 16);
    const __m512i turned = _mm512_mask_sub_epi16(y_x, 0xaaaaaaaa, _mm512_setzero_si512(), y_x); /* y, -x */
    return (zr_vi)_mm512_madd_epi16((__m512i)a, turned);
}

static inline uint32_t zr_vi_compress(void *p, zr_vm m, zr_vi v)
{
    _mm512_storeu_si512(p, _mm512_maskz_compress_epi32(m, (__m512i)v));
    return (uint32_t)__builtin_popcount(_cvtmask16_u32(m));
}

static inline void zr_vf_store4(float *p, zr_vf x, zr_vf y, zr_vf z, zr_vf w)
{
    const __m512d xy_low = (__m512d)_mm512_unpacklo_ps((__m512)x, (__m512)y);
    const __m512d xy_high = (__m512d)_mm512_unpackhi_ps((__m512)x, (__m512)y);
    const __m512d zw_low = (__m512d)_mm512_unpacklo_ps((__m512)z, (__m512)w);
    const __m512d zw_high = (__m512d)_mm512_unpackhi_ps((__m512)z, (__m512)w);
    const __m512 every[4] = {(__m512)_mm512_unpacklo_pd(xy_low, zw_low), (__m512)_mm512_unpackhi_pd(xy_low, zw_low),
                             (__m512)_mm512_unpacklo_pd(xy_high, zw_high),
                             (__m512)_mm512_unpackhi_pd(xy_high, zw_high)};
    const __m512 a = _mm512_shuffle_f32x4(every[0], every[1], 0x44), b = _mm512_shuffle_f32x4(every[2], every[3], 0x44);
    const __m512 c = _mm512_shuffle_f32x4(every[0], every[1], 0xee), d = _mm512_shuffle_f32x4(every[2], every[3], 0xee);
    _mm512_storeu_ps(p, _mm512_shuffle_f32x4(a, b, 0x88));
    _mm512_storeu_ps(p + 16, _mm512_shuffle_f32x4(a, b, 0xdd));
    _mm512_storeu_ps(p + 32, _mm512_shuffle_f32x4(c, d, 0x88));
    _mm512_storeu_ps(p + 48, _mm512_shuffle_f32x4(c, d, 0xdd));
}

#endif
