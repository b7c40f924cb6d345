/* crease_normals.h - mesh: normals of corners, averaged over faces that meet at less than an angle.
 *
 * Space:  object space.
 * How:    the normal of a corner is the sum, over the faces at its vertex whose normals are within
 *         the crease angle of this corner's face's, of (area x corner angle) times the face's unit normal. Vertices are
 *         welded where they lie within 1e-6 of the diagonal of the mesh's bounds (weld.h).
 *         A face without area has no direction: at its corners all faces count. Where the sum is 0, the corner has the
 *         normal of its face.
 *         A vertex with more than ZR_CREASE_EXACT corners has its faces summed up in groups of like directions, and
 *         corners are compared with these: its cost is no square of their number.
 * Exact:  sums in the order of faces, whatever the number of threads; + - * / and sqrt only.
 */
#ifndef ZR_CREASE_NORMALS_H
#define ZR_CREASE_NORMALS_H

#include "base/arena.h"
#include "base/team.h"
#include "scene/scene.h"
#include "zraster.h"

/* One unit normal a corner (slot of mesh->indices), w being 0; 0 where no face of the vertex has an area. `degrees`:
 * 0..180; equal counts as within. Takes from the arena also what it holds meanwhile, some 24 bytes a position and 4 a
 * corner, and gives it back. NULL where the arena has failed; cancelled, it returns early, with numbers that are no
 * normals. */
zr_vec4 *zr_crease_normals_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                                const struct zr_mesh *mesh, float degrees);

/* For all corners of faces `first` and so on, to corners[] by slot: the unit normal of the face, w being what it
 * weighs there. Every w of the positions is 1. A kernel. */
typedef void zr_crease_corners_fn(const struct zr_mesh *mesh, uint32_t first, size_t count, zr_vec4 *corners);

zr_crease_corners_fn zr_crease_corners_scalar, zr_crease_corners_sse2, zr_crease_corners_avx2, zr_crease_corners_avx512,
    zr_crease_corners_neon;

/* Corners by vertex, in the order of slots: those of vertex v are slots[v == 0 ? 0 : ends[v - 1]] .. slots[ends[v] -
 * 1]. */
struct zr_vertex_corners {
    const uint32_t *ends, *slots;
};

/* Of vertices begin .. end - 1, what zr_crease_corners has written becomes the normals of the corners. `cosine`: of
 * the least within. A kernel. */
typedef void zr_crease_sums_fn(const struct zr_vertex_corners *of, size_t begin, size_t end, float cosine,
                               zr_vec4 *corners);

zr_crease_sums_fn zr_crease_sums_scalar, zr_crease_sums_sse2, zr_crease_sums_avx2, zr_crease_sums_avx512,
    zr_crease_sums_neon;

/* One face at a vertex, or many alike: the direction that is compared, and what is added. */
struct zr_crease_source {
    zr_vec4 normal, sum;
};

enum {
    ZR_CREASE_EXACT = 256,
    ZR_CREASE_GROUPS_A_SIDE = 16, /* directions by squares on the sides of a cube */
    ZR_CREASE_GROUPS = 6 * ZR_CREASE_GROUPS_A_SIDE * ZR_CREASE_GROUPS_A_SIDE
};

/* The groups that the corners are in; returns their number. */
uint32_t zr_crease_groups(const zr_vec4 *corners, const uint32_t *slots, uint32_t count,
                          struct zr_crease_source groups[ZR_CREASE_GROUPS]);

#endif
