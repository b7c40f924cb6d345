/* face_normals.h - mesh: normals of faces, computed from the polygons.
 *
 * Space:  object space. Lengths are twice the area, so that a plain sum of face normals at a vertex is weighted by
 *         area. */
#ifndef ZR_FACE_NORMALS_H
#define ZR_FACE_NORMALS_H

#include <stddef.h>

#include "base/isa.h"
#include "scene/scene.h"

/* Returns the normal of a corner: the mesh's own, or, if it has none or it is 0, the computed one (vertex_normals.h).
 * `computed` may be NULL. `slot` (of mesh->indices) is used if the mesh has normal indices. */
zr_vec3 zr_corner_normal(const struct zr_mesh *mesh, const zr_vec4 *computed, uint32_t vertex, uint32_t slot);

/* Returns true if some vertex or corner has no normal. */
bool zr_mesh_lacks_normals(const struct zr_mesh *mesh);

/* Returns true if a face is lit at its vertices, and some vertex or corner has no normal. */
bool zr_mesh_is_lit_by_computed_normals(const struct zr_scene *scene, const struct zr_mesh *mesh);

/* Returns twice the area of face `face`, as a vector on its front side; for a face that is not planar, that of its mean
 * plane. Source: Newell's method (Sutherland et al., 1974). */
zr_vec3 zr_normal_of_face(const struct zr_mesh *mesh, uint32_t face);

/* Writes the same for faces first .. first + count - 1 of a mesh of triangles to out[0] and following, with w = 0. A
 * kernel. */
typedef void zr_triangle_normals_fn(const struct zr_mesh *mesh, uint32_t first, size_t count, zr_vec4 *out);

ZR_KERNEL_TABLE(zr_triangle_normals_fn, zr_triangle_normals)

enum { ZR_NORMALS_AT_ONCE = 64 };

/* Cache of face normals of one mesh. Faces may come in any order; consecutive ones are computed in blocks. */
struct zr_face_normals {
    const struct zr_mesh *mesh;
    zr_triangle_normals_fn *make_many; /* NULL if some faces are not triangles */
    uint32_t first, count;             /* cached faces */
    zr_vec4 normals[ZR_NORMALS_AT_ONCE];
};

void zr_face_normals_begin(struct zr_face_normals *normals, enum zr_isa isa, const struct zr_mesh *mesh);

/* Caches the normals from `face` on; for meshes of triangles. */
void zr_face_normals_make(struct zr_face_normals *normals, uint32_t face);

/* Returns zr_normal_of_face, cached. */
static inline zr_vec3 zr_face_normal(struct zr_face_normals *normals, uint32_t face)
{
    if (!normals->make_many) return zr_normal_of_face(normals->mesh, face);
    if (face - normals->first >= normals->count) zr_face_normals_make(normals, face);
    const zr_vec4 *normal = &normals->normals[face - normals->first];
    return (zr_vec3){normal->x, normal->y, normal->z};
}

#endif
