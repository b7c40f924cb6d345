/* x86.h - base: what the headers of x86's instruction sets share. */
#ifndef ZR_SIMD_X86_H
#define ZR_SIMD_X86_H

#include <immintrin.h>
#include <stddef.h>

#define ZR_HAS_CROSS /* madd: pairs multiplied and added */

/* Two floats from p, two from q; neither need be aligned as double is. */
static inline __m128 zr_load_pair(const float *p, const float *q)
{
    const __m128 low = _mm_castsi128_ps(_mm_loadl_epi64((const __m128i *)(const void *)p));
    return _mm_loadh_pi(low, (const __m64 *)(const void *)q);
}

#endif
