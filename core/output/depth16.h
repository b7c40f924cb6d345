/* depth16.h - output: metric depth -> 16-bit steps.
 *
 * 0 is kept for "nothing there". Depth that does not fit 1..65535 is moved to the
 * nearer of the two ends and counted, never wrapped.
 */
#ifndef ZR_DEPTH16_H
#define ZR_DEPTH16_H

#include <stdatomic.h>

#include "base/isa.h"
#include "output/rows.h"
#include "shade/frame.h"

/* Scene units a step: what was asked for, or, where that is 0, what makes the far plane
 * (without one: the deepest pixel) step 65535. */
float zr_depth16_scale(const struct zr_frame *frame, float asked);

/* A row's steps, for a kernel: returns how many pixels did not fit. */
typedef uint32_t zr_depth16_fn(const float *depth, float scale, uint32_t width, uint16_t *out);

zr_depth16_fn zr_depth16_scalar, zr_depth16_sse2, zr_depth16_avx2, zr_depth16_avx512, zr_depth16_neon;

zr_depth16_fn *zr_depth16_of(enum zr_isa isa);

/* A frame's rows, made while they are written. */
struct zr_depth16 {
    const struct zr_frame *frame;
    float scale;
    zr_depth16_fn *make_steps;
    atomic_uint_fast64_t misfits; /* pixels that did not fit, so far */
};

/* Of rows of uint16_t in the machine's order; `depth16` must outlive them. */
struct zr_rows zr_depth16_rows(struct zr_depth16 *depth16);

#endif
