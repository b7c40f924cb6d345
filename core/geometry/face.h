/* face.h - geometry: classifies the faces of a mesh in object space: collinear, concave. */
#ifndef ZR_FACE_H
#define ZR_FACE_H

#include "scene/degenerate_face.h"

/* Returns true if all corners lie on one line, or nearly: turns are at most a millionth of a right angle. */
bool zr_face_is_line(const struct zr_mesh *mesh, uint32_t face);

/* Returns true if the face is no convex polygon: some corner turns against the winding, or the ring crosses itself or
 * goes round more than once. Computed in double against the Newell normal, without tolerance: a dent of one unit in the
 * last place counts. Straight and repeated corners are ignored if the turn evaluates to 0 (always along axes; elsewhere
 * a rounded corner may dent the face). A corner at infinity or behind the eye (w <= 0) cannot be divided by w. A face
 * with such a corner is judged by the cone of its corners' rays in homogeneous space: if that is convex, the triangles
 * of the fan do not overlap in any view. */
bool zr_face_is_concave(const struct zr_mesh *mesh, uint32_t face);

/* Returns true if the face has dents, crossings or holes and is therefore filled by the odd-even rule
 * (geometry/shape.h), or is a cap, filled by the non-zero rule. */
bool zr_face_is_shape(const struct zr_mesh *mesh, uint32_t face);

/* Returns true if every face has three corners. */
static inline bool zr_mesh_is_of_triangles(const struct zr_mesh *mesh)
{
    return mesh->face_offsets[mesh->face_count] == 3 * (uint64_t)mesh->face_count;
}

#endif
