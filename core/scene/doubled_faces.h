/* doubled_faces.h - scene: detection of meshes that contain each face twice, once with each winding.
 *
 * Why:    the normals of the two faces add up to 0 at each vertex, which leaves smooth shading without normals.
 */
#ifndef ZR_DOUBLED_FACES_H
#define ZR_DOUBLED_FACES_H

#include "base/warning_list.h"
#include "scene/scene.h"

/* True if each face with the corners a, b, ..., z has a partner z, ..., b, a; both may start at any corner. False if
 * faces have holes. */
bool zr_faces_are_doubled(const struct zr_mesh *mesh);

/* Adds one warning if such meshes use a shading that sums face normals; it names the first and counts the others. */
void zr_doubled_faces_warn(struct zr_arena *arena, const struct zr_scene *scene, struct zr_warning_list *warnings);

#endif
