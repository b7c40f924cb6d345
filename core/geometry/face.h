/* face.h - geometry: what a face of a mesh is, before it is looked at from anywhere. */
#ifndef ZR_FACE_H
#define ZR_FACE_H

#include "scene/scene.h"

/* Fewer than three distinct corners. What merely has no area is left to the subpixel grid, where the reference
 * decides it too. */
bool zr_face_is_degenerate(const struct zr_mesh *mesh, uint32_t face);

/* Not a convex polygon: dents, crossings, holes. The odd-even rule says what is inside (geometry/shape.h). */
bool zr_face_is_shape(const struct zr_mesh *mesh, uint32_t face);

/* Every face has three corners. */
static inline bool zr_mesh_is_of_triangles(const struct zr_mesh *mesh)
{
    return mesh->face_offsets[mesh->face_count] == 3 * (uint64_t)mesh->face_count;
}

#endif
