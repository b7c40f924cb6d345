/* srgb.h - base: table of sRGB-encoded values as linear light, and the encoding of linear light. Kernels.
 *
 * Exact:  the values of base/simd/srgb_simd.h, the same on every machine.
 */
#ifndef ZR_SRGB_H
#define ZR_SRGB_H

#include <stddef.h>

#include "base/isa.h"

/* out[i] is the linear light of i / last, 0 <= i <= last. Writes up to last + 16 floats. */
typedef void zr_srgb_ramp_fn(size_t last, float *out);

ZR_KERNEL_TABLE(zr_srgb_ramp_fn, zr_srgb_ramp)

/* Encodes `count` values, clamped to 0..1. Both arrays have ZR_SRGB_EXCESS more floats.
 * Those of `linear` are read and must be defined. */
enum { ZR_SRGB_EXCESS = 16 };
typedef void zr_srgb_encode_fn(const float *linear, size_t count, float *encoded);

ZR_KERNEL_TABLE(zr_srgb_encode_fn, zr_srgb_encode)

#endif
