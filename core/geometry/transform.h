/* transform.h - geometry, first step: transforms positions to window vertices. A kernel.
 *
 * Space:  object space -> clip space (one matrix) -> window space (viewport.h).
 * Exact:  the reference's rules 1, 2 and 4. */
#ifndef ZR_TRANSFORM_H
#define ZR_TRANSFORM_H

#include <stdbool.h>
#include <stddef.h>

#include "base/isa.h"
#include "geometry/viewport.h"

/* Extends the six bits of zr_clip_outcode: inside the volume, but without a window position. */
enum { ZR_OUTCODE_UNPLACED = 1 << 7 };

/* Returns the bits that drop a point. */
static inline unsigned zr_outcode_of_point(unsigned code)
{
    return ZR_MUTANT(points_cut_by_depth_alone, code, code & (3u << 4 | ZR_OUTCODE_UNPLACED));
}

/* Transforms each position once and returns the OR of all outcodes. out[i] is undefined if outcodes[i] is not 0. With
 * `streamed`, `out` is written by non-temporal stores (zr_vi_stream) and must be aligned to 64 bytes. */
typedef unsigned zr_transform_fn(const zr_mat4 *object_to_clip, const struct zr_viewport *viewport,
                                 const zr_vec4 *positions, size_t count, struct zr_window_vertex *out,
                                 uint8_t *outcodes, bool streamed);

ZR_KERNEL_TABLE(zr_transform_fn, zr_transform)

#endif
