/* srgb.h - base: sRGB-encoded values as linear light, many at once. A kernel.
 *
 * Exact:  those of base/srgb_simd.h, on every machine.
 */
#ifndef ZR_SRGB_H
#define ZR_SRGB_H

#include <stddef.h>

#include "base/isa.h"

/* out[i] is the light of i / last, i from 0 to last; `out` has room for last + 16. */
typedef void zr_srgb_ramp_fn(size_t last, float *out);

zr_srgb_ramp_fn zr_srgb_ramp_scalar, zr_srgb_ramp_sse2, zr_srgb_ramp_avx2, zr_srgb_ramp_avx512, zr_srgb_ramp_neon;

zr_srgb_ramp_fn *zr_srgb_ramp_of(enum zr_isa isa);

#endif
