/* fours_simd.h - base: loads of structures of doubles, for kernels.
 *
 * Gathers load one double after another: loads of four and transpositions replace them, with the same values.
 */
#ifndef ZR_FOURS_SIMD_H
#define ZR_FOURS_SIMD_H

#include "base/simd/simd.h"

/* Loads four doubles of ZR_DOUBLES structures: out[k] has p[i[lane] + k]. */
static inline void zr_vd_load_fours(const double *p, const int32_t *i, zr_vd out[4])
{
#if defined ZR_KERNEL_AVX512
    const __m512i even = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13),
                  odd = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    __m512d rows[4];
    for (int k = 0; k < 4; k++) /* lanes k and k + 4 */
        rows[k] =
            _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(p + i[k])), _mm256_loadu_pd(p + i[k + 4]), 1);
    for (int k = 0; k < 2; k++) {
        const __m512d a = k ? _mm512_unpackhi_pd(rows[0], rows[1]) : _mm512_unpacklo_pd(rows[0], rows[1]);
        const __m512d b = k ? _mm512_unpackhi_pd(rows[2], rows[3]) : _mm512_unpacklo_pd(rows[2], rows[3]);
        out[k] = (zr_vd)_mm512_permutex2var_pd(a, even, b);
        out[k + 2] = (zr_vd)_mm512_permutex2var_pd(a, odd, b);
    }
#elif defined ZR_KERNEL_AVX2
    __m256d rows[4];
    for (int k = 0; k < 4; k++)
        rows[k] = _mm256_loadu_pd(p + i[k]);
    for (int k = 0; k < 2; k++) {
        const __m256d a = k ? _mm256_unpackhi_pd(rows[0], rows[1]) : _mm256_unpacklo_pd(rows[0], rows[1]);
        const __m256d b = k ? _mm256_unpackhi_pd(rows[2], rows[3]) : _mm256_unpacklo_pd(rows[2], rows[3]);
        out[k] = (zr_vd)_mm256_permute2f128_pd(a, b, 0x20);
        out[k + 2] = (zr_vd)_mm256_permute2f128_pd(a, b, 0x31);
    }
#else
    for (int k = 0; k < 4; k++)
        out[k] = zr_vd_gather(p + k, i);
#endif
}

#endif
