/* crease_sums.h - mesh: kernels of crease normals (crease_normals.h).
 *
 * Space:  object space. */
#ifndef ZR_CREASE_SUMS_H
#define ZR_CREASE_SUMS_H

#include <stddef.h>
#include <string.h>

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

/* Replaces the output of zr_crease_corners by corner normals, for vertices begin .. end - 1, and marks them
 * (zr_crease_mark_equal). `cosine`: cosine of the crease angle. Sets of->bent to 1 at vertices of at most
 * ZR_FAN_CORNERS_MOST corners with faces beyond that angle, and leaves their corners as they are; to 0 at others.
 * Returns the sum of zr_crease_mark_equal. A kernel. */
typedef size_t zr_crease_sums_fn(const struct zr_vertex_corners *of, size_t begin, size_t end, float cosine,
                                 zr_vec4 *corners);

ZR_KERNEL_TABLE(zr_crease_sums_fn, zr_crease_sums)

/* Different normals of a vertex that are looked for. Others count as new. */
enum { ZR_CREASE_MARKED = 8 };

static inline bool zr_crease_is_equal(const zr_vec4 *a, const zr_vec4 *b)
{
    return memcmp(a, b, 3 * sizeof a->x) == 0;
}

/* Sets the w of corners of one vertex, in ascending order, to the slot of the first of them with the same normal, as
 * bits. Returns the number of those that are such a first one. */
static inline size_t zr_crease_mark_equal(const uint32_t *slots, uint32_t count, zr_vec4 *corners)
{
    uint32_t firsts[ZR_CREASE_MARKED], listed = 0;
    size_t distinct = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t k = 0;
        while (k < listed && !zr_crease_is_equal(&corners[firsts[k]], &corners[slots[i]]))
            k++;
        const uint32_t first = k < listed ? firsts[k] : slots[i];
        memcpy(&corners[slots[i]].w, &first, sizeof first);
        distinct += k == listed;
        if (k == listed && listed < ZR_CREASE_MARKED) firsts[listed++] = first;
    }
    return distinct;
}

#endif
