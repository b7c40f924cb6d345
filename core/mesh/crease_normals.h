/* crease_normals.h - mesh: corner normals, averaged over faces that meet at less than the crease angle.
 *
 * Space:  object space.
 * How:    the normal of a corner is a sum over the faces at its vertex that lie within the crease angle of its own
 *         face. Each face adds its unit normal times (area x corner angle). Vertices are welded if they lie within 1e-6
 *         of the diagonal of the mesh's bounds (weld.h). A face without area has no direction: its corners average all
 *         faces of the vertex. If the sum is 0, the corner gets the normal of its face. At a vertex with more than
 *         ZR_CREASE_EXACT corners, faces are summed in groups of similar directions. Corners are compared with the
 *         groups, which avoids quadratic cost.
 *         If the mesh has smoothing groups, they replace the crease angle: a corner averages all faces of its group at
 *         the vertex, and corners of group 0 get the normals of their faces.
 * Exact:  sums in the order of faces, for any number of threads; + - * / and sqrt only. */
#ifndef ZR_CREASE_NORMALS_H
#define ZR_CREASE_NORMALS_H

#include "base/arena.h"
#include "base/run.h"
#include "base/team.h"
#include "core.h"
#include "scene/scene.h"

/* Returns one unit normal per corner (slot of mesh->indices), with w = 0; 0 if no face of the vertex has an area.
 * `degrees`: 0..180; a face at exactly this angle counts. Takes about 24 bytes per position and 4 per corner of scratch
 * from the arena and gives them back; with smoothing groups, 8 per corner. Returns NULL if the arena failed. If
 * cancelled, returns early with undefined normals. */
zr_vec4 *zr_crease_normals_make(const struct zr_run *run, const struct zr_mesh *mesh, float degrees);

/* Writes the unit face normal and, in w, its weight to all corners of the faces first .. first + count - 1. `corners`
 * is indexed by slot. The positions must have w = 1. A kernel. */
typedef void zr_crease_corners_fn(const struct zr_mesh *mesh, uint32_t first, size_t count, zr_vec4 *corners);

ZR_KERNEL_TABLE(zr_crease_corners_fn, zr_crease_corners)

/* Corners by vertex, in the order of slots. Vertex v has slots[v == 0 ? 0 : ends[v - 1]] .. slots[ends[v] - 1]. */
struct zr_vertex_corners {
    const uint32_t *ends, *slots;
};

/* Replaces the output of zr_crease_corners by corner normals, for vertices begin .. end - 1. `cosine`: cosine of the
 * crease angle. A kernel. */
typedef void zr_crease_sums_fn(const struct zr_vertex_corners *of, size_t begin, size_t end, float cosine,
                               zr_vec4 *corners);

ZR_KERNEL_TABLE(zr_crease_sums_fn, zr_crease_sums)

/* One face at a vertex, or a group of similar ones: the direction to compare, and the weighted sum to add. */
struct zr_crease_source {
    zr_vec4 normal, sum;
};

enum {
    ZR_CREASE_EXACT = 256,
    ZR_CREASE_GROUPS_PER_SIDE = 16, /* directions are grouped by squares on the sides of a cube */
    ZR_CREASE_GROUPS = 6 * ZR_CREASE_GROUPS_PER_SIDE * ZR_CREASE_GROUPS_PER_SIDE
};

/* Sums the corners into groups by direction and returns the number of groups. */
uint32_t zr_crease_groups(const zr_vec4 *corners, const uint32_t *slots, uint32_t count,
                          struct zr_crease_source groups[ZR_CREASE_GROUPS]);

#endif
