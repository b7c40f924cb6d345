/* depth16.h - output: converts metric depth to 16-bit steps.
 *
 * 0 is the clear value of uncovered pixels. Depth outside 1..65535 is clamped and counted, never wrapped.
 * With a range, nearer depths are 0, and farther ones and uncovered pixels are 65535; they are not counted. */
#ifndef ZR_DEPTH16_H
#define ZR_DEPTH16_H

#include <stdatomic.h>

#include "base/isa.h"
#include "output/bytes/rows.h"
#include "shade/frame.h"

/* Returns the scene units per step: `given`, or, if that is 0, the scale at which the far plane (without one: the
 * deepest pixel) is step 65535. */
float zr_depth16_scale(const struct zr_frame *frame, float given);

/* Converts a row and returns the number of clamped pixels. A kernel. */
typedef uint32_t zr_depth16_fn(const float *depth, float scale, uint32_t width, uint16_t *out);

ZR_KERNEL_TABLE(zr_depth16_fn, zr_depth16)

/* Converts rows of depth, or of another length, while they are written. */
struct zr_depth16 {
    const struct zr_frame *frame;
    const float *values;                /* of the frame's size; infinity if uncovered */
    const struct zr_column_span *spans; /* pixels outside of them are uncovered; NULL: unknown */
    float scale;
    const float *range; /* nearest and farthest depth, scene units; NULL: any */
    zr_depth16_fn *quantize;
    atomic_uint_fast64_t clamped; /* clamped pixels so far */
};

/* Returns rows of uint16_t in native byte order; `depth16` must outlive them. */
struct zr_rows zr_depth16_rows(struct zr_depth16 *depth16);

#endif
