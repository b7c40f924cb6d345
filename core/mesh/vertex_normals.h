/* vertex_normals.h - mesh: normals of vertices, computed from the polygons around them.
 *
 * Space:  object space.
 * Exact:  sums of floats depend on their order, which is that of the faces. So it is not faces that threads share, but
 *         vertices: each looks at all faces and adds what is at its own vertices.
 */
#ifndef ZR_VERTEX_NORMALS_H
#define ZR_VERTEX_NORMALS_H

#include "base/arena.h"
#include "base/team.h"
#include "scene/scene.h"
#include "zraster.h"

/* One unit normal a position, w being 0: the sum of the normals of the faces around it, as normals.h has them, or 0.
 * Takes from the arena also what it holds meanwhile, 256 KiB at most. NULL where the arena has failed; cancelled, which
 * it looks for some times in a million faces, it returns early, with numbers that are no normals. */
zr_vec4 *zr_vertex_normals_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                                const struct zr_mesh *mesh);

/* Vertices are dealt out to `count` parts, a power of two, so many at a time: neighbours share lines of the caches. */
enum { ZR_PART_VERTICES = 64 };

struct zr_vertex_part {
    uint32_t number, count;
};

static inline bool zr_vertex_is_of_part(uint32_t vertex, struct zr_vertex_part part)
{
    return (vertex / ZR_PART_VERTICES & (part.count - 1)) == part.number;
}

/* Adds normals[t] to the sums of those corners of triangle t that are of the part; its corners are at indices[3 t] and
 * behind, fewer than 2^31. A kernel. */
typedef void zr_add_normals_fn(const uint32_t *indices, size_t triangles, const zr_vec4 *normals,
                               struct zr_vertex_part part, zr_vec4 *sums);

zr_add_normals_fn zr_add_normals_scalar, zr_add_normals_sse2, zr_add_normals_avx2, zr_add_normals_avx512,
    zr_add_normals_neon;

/* Normalizes each. A kernel. */
typedef void zr_normalize_fn(zr_vec4 *vectors, size_t count);

zr_normalize_fn zr_normalize_scalar, zr_normalize_sse2, zr_normalize_avx2, zr_normalize_avx512, zr_normalize_neon;

#endif
