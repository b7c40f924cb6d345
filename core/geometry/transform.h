/* transform.h - geometry, first step: positions -> vertices in the window. A kernel.
 *
 * Space:  object space -> clip space (one matrix) -> window space (viewport.h).
 * Exact:  the reference's rules 1, 2 and 4.
 */
#ifndef ZR_TRANSFORM_H
#define ZR_TRANSFORM_H

#include <stdbool.h>
#include <stddef.h>

#include "base/isa.h"
#include "geometry/viewport.h"

/* Beside the six bits of zr_clip_outcode: inside the volume, but without a place in the window. */
enum { ZR_OUTCODE_UNPLACED = 1 << 7 };

/* Each position once. out[i] is undefined where outcodes[i] is not 0. Returns the OR of all outcodes.
 * written by non-temporal stores (zr_vi_stream), `out` being a multiple of 64 bytes. */
typedef unsigned zr_transform_fn(const zr_mat4 *object_to_clip, const struct zr_viewport *viewport,
                                 const zr_vec4 *positions, size_t count, struct zr_window_vertex *out,
                                 uint8_t *outcodes, bool streamed);

zr_transform_fn zr_transform_scalar, zr_transform_sse2, zr_transform_avx2, zr_transform_avx512, zr_transform_neon;

zr_transform_fn *zr_transform_of(enum zr_isa isa);

#endif
