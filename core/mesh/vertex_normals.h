/* vertex_normals.h - mesh: normals of vertices, computed from the polygons around them.
 *
 * Space:  object space.
 * Exact:  float sums depend on their order, which is that of the faces. The threads therefore divide the vertices, not
 *         the faces: each thread reads all faces and adds to its own vertices. */
#ifndef ZR_VERTEX_NORMALS_H
#define ZR_VERTEX_NORMALS_H

#include "base/arena.h"
#include "base/run.h"
#include "base/team.h"
#include "core.h"
#include "scene/scene.h"

/* Returns one unit normal per position, with w = 0: the sum of the normals of the faces around it (face_normals.h), or
 * 0. Takes up to 256 KiB of scratch from the arena as well. Returns NULL if the arena failed. If cancelled (checked
 * several times per million faces), returns early with undefined normals. */
zr_vec4 *zr_vertex_normals_make(const struct zr_run *run, const struct zr_mesh *mesh);

/* Vertices are dealt to `count` parts, a power of two, in runs of this length: neighbours share cache lines. */
enum { ZR_PART_VERTICES = 64 };

struct zr_vertex_part {
    uint32_t number, count;
};

static inline bool zr_vertex_is_of_part(uint32_t vertex, struct zr_vertex_part part)
{
    return (vertex / ZR_PART_VERTICES & (part.count - 1)) == part.number;
}

/* Adds normals[t] to the sums of those corners of triangle t that belong to `part`. The corners are at indices[3 t] and
 * following; there are fewer than 2^31. A kernel. */
typedef void zr_add_normals_fn(const uint32_t *indices, size_t triangles, const zr_vec4 *normals,
                               struct zr_vertex_part part, zr_vec4 *sums);

ZR_KERNEL_TABLE(zr_add_normals_fn, zr_add_normals)

/* Normalizes each vector. A kernel. */
typedef void zr_normalize_fn(zr_vec4 *vectors, size_t count);

ZR_KERNEL_TABLE(zr_normalize_fn, zr_normalize)

#endif
