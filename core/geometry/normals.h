/* normals.h - geometry: normals of faces and vertices, computed from the polygons.
 *
 * Space:  object space. Lengths are twice the area, so that a plain sum of face
 *         normals at a vertex is already weighted by area.
 */
#ifndef ZR_NORMALS_H
#define ZR_NORMALS_H

#include "base/arena.h"
#include "scene/scene.h"

/* Twice the area of face `face`, as a vector on its front side; the mean plane where
 * the face is not planar. Source: Newell's method (Sutherland et al., 1974). */
zr_vec3 zr_normal_of_face(const struct zr_mesh *mesh, uint32_t face);

/* One unit normal a position: the sum of the normals of the faces around it, in
 * the order of the faces. NULL where the arena has failed. */
zr_vec3 *zr_normals_of_vertices(struct zr_arena *arena, const struct zr_mesh *mesh);

/* True where the face is no convex polygon: some corner turns against the winding, or the ring crosses itself
 * or goes round more than once. Computed in double against the Newell normal, without
 * tolerance: a dent of one unit in the last place counts. Straight and repeated corners do not, as long as the
 * turn comes out as 0 (along axes it does; elsewhere rounding of the corner itself may dent the face).
 * Corners at infinity (w = 0) are taken as the points (x, y, z). */
bool zr_face_is_concave(const struct zr_mesh *mesh, uint32_t face);

#endif
