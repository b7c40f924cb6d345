/* crease_sums.h - mesh: kernels of crease normals (crease_normals.h).
 *
 * Space:  object space. */
#ifndef ZR_CREASE_SUMS_H
#define ZR_CREASE_SUMS_H

#include <stddef.h>

#include "base/isa.h"
#include "scene/scene.h"

enum { ZR_FAN_CORNERS_MOST = 16, ZR_CREASE_EXACT = 256 };

/* Writes the unit face normal and, in w, its weight to all corners of the faces first .. first + count - 1. `corners`
 * is indexed by slot. The positions must have w = 1. A kernel. */
typedef void zr_crease_corners_fn(const struct zr_mesh *mesh, uint32_t first, size_t count, zr_vec4 *corners);

ZR_KERNEL_TABLE(zr_crease_corners_fn, zr_crease_corners)

/* Corners by vertex, in the order of slots. Vertex v has slots[v == 0 ? 0 : ends[v - 1]] .. slots[ends[v] - 1]. */
struct zr_vertex_corners {
    const uint32_t *ends, *slots;
    uint8_t *bent; /* by vertex; NULL: not wanted */
};

/* Replaces the output of zr_crease_corners by corner normals, for vertices begin .. end - 1. `cosine`: cosine of the
 * crease angle. Sets of->bent to 1 at vertices of at most ZR_FAN_CORNERS_MOST corners with faces beyond that angle, and
 * leaves their corners as they are; to 0 at others. A kernel. */
typedef void zr_crease_sums_fn(const struct zr_vertex_corners *of, size_t begin, size_t end, float cosine,
                               zr_vec4 *corners);

ZR_KERNEL_TABLE(zr_crease_sums_fn, zr_crease_sums)

#endif
