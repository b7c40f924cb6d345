/* face.h - geometry: what a face of a mesh is, before it is looked at from anywhere. */
#ifndef ZR_FACE_H
#define ZR_FACE_H

#include "scene/scene.h"

/* Fewer than three distinct corners. What merely has no area is left to the subpixel grid, where the reference
 * decides it too. */
bool zr_face_is_degenerate(const struct zr_mesh *mesh, uint32_t face);

/* All corners lie on one line, or nearly: turns are a millionth of a right angle at most. */
bool zr_face_is_line(const struct zr_mesh *mesh, uint32_t face);

/* True where the face is no convex polygon: some corner turns against the winding, or the ring crosses itself
 * or goes round more than once. Computed in double against the Newell normal, without
 * tolerance: a dent of one unit in the last place counts. Straight and repeated corners do not, as long as the
 * turn comes out as 0 (along axes it does; elsewhere rounding of the corner itself may dent the face).
 * Corners at infinity or behind the eye (w <= 0) have no place beside the others, once divided by w. Of a face with one
 * the cone is judged that its corners' rays make in homogeneous space: where it is convex, the triangles of the fan do
 * not overlap, whatever of them is seen. */
bool zr_face_is_concave(const struct zr_mesh *mesh, uint32_t face);

/* Not a convex polygon: dents, crossings, holes. The odd-even rule says what is inside (geometry/shape.h). */
bool zr_face_is_shape(const struct zr_mesh *mesh, uint32_t face);

/* Every face has three corners. */
static inline bool zr_mesh_is_of_triangles(const struct zr_mesh *mesh)
{
    return mesh->face_offsets[mesh->face_count] == 3 * (uint64_t)mesh->face_count;
}

#endif
