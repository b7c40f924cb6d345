/* srgb.h - base: table of sRGB-encoded values as linear light. A kernel.
 *
 * Exact:  the values of base/srgb_simd.h, the same on every machine.
 */
#ifndef ZR_SRGB_H
#define ZR_SRGB_H

#include <stddef.h>

#include "base/isa.h"

/* out[i] is the linear light of i / last, 0 <= i <= last. Writes up to last + 16 floats. */
typedef void zr_srgb_ramp_fn(size_t last, float *out);

ZR_KERNEL_TABLE(zr_srgb_ramp_fn, zr_srgb_ramp)

#endif
