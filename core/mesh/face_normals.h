/* face_normals.h - mesh: normals of faces, computed from the polygons.
 *
 * Space:  object space. Lengths are twice the area, so that a plain sum of face
 *         normals at a vertex is already weighted by area.
 */
#ifndef ZR_FACE_NORMALS_H
#define ZR_FACE_NORMALS_H

#include <stddef.h>

#include "base/isa.h"
#include "scene/scene.h"

/* At a corner: as given, or, where that is 0 or none is, as computed (vertex_normals.h), which may be NULL. `slot`: of
 * mesh->indices, where normals have indices. */
zr_vec3 zr_corner_normal(const struct zr_mesh *mesh, const zr_vec4 *computed, uint32_t vertex, uint32_t slot);

/* Whether some must be computed. */
bool zr_mesh_lacks_normals(const struct zr_mesh *mesh);

/* Twice the area of face `face`, as a vector on its front side; the mean plane where
 * the face is not planar. Source: Newell's method (Sutherland et al., 1974). */
zr_vec3 zr_normal_of_face(const struct zr_mesh *mesh, uint32_t face);

/* The same of faces `first` and so on, to xyz of out[0] and so on, w being 0; of a mesh of triangles. A kernel. */
typedef void zr_triangle_normals_fn(const struct zr_mesh *mesh, uint32_t first, size_t count, zr_vec4 *out);

zr_triangle_normals_fn zr_triangle_normals_scalar, zr_triangle_normals_sse2, zr_triangle_normals_avx2,
    zr_triangle_normals_avx512, zr_triangle_normals_neon;

zr_triangle_normals_fn *zr_triangle_normals_of(enum zr_isa isa);

enum { ZR_NORMALS_AT_ONCE = 64 };

/* Normals of the faces of one mesh: in any order, but many are made at once where faces follow one another. */
struct zr_face_normals {
    const struct zr_mesh *mesh;
    zr_triangle_normals_fn *make_many; /* NULL where some faces are no triangles */
    uint32_t first, count;             /* faces whose normals are made */
    zr_vec4 normals[ZR_NORMALS_AT_ONCE];
};

void zr_face_normals_begin(struct zr_face_normals *normals, enum zr_isa isa, const struct zr_mesh *mesh);

/* From `face` on, for zr_face_normal; of a mesh of triangles. */
void zr_face_normals_make(struct zr_face_normals *normals, uint32_t face);

/* As zr_normal_of_face. */
static inline zr_vec3 zr_face_normal(struct zr_face_normals *normals, uint32_t face)
{
    if (!normals->make_many) return zr_normal_of_face(normals->mesh, face);
    if (face - normals->first >= normals->count) zr_face_normals_make(normals, face);
    const zr_vec4 *normal = &normals->normals[face - normals->first];
    return (zr_vec3){normal->x, normal->y, normal->z};
}

#endif
