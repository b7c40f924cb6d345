/* doubled_faces.h - scene: meshes that have each face twice, once with each winding.
 *
 * Why:    the normals of the two add up to 0 at each vertex, so that smooth shading has none.
 */
#ifndef ZR_DOUBLED_FACES_H
#define ZR_DOUBLED_FACES_H

#include "base/warning_list.h"
#include "scene/scene.h"

/* Whether for each face with the corners a, b, ..., z there is one with z, ..., b, a, whichever comes first. False where
 * faces have holes. */
bool zr_faces_are_doubled(const struct zr_mesh *mesh);

/* Warns of the first such mesh among those whose shading adds up the normals of faces. */
void zr_doubled_faces_warn(struct zr_arena *arena, const struct zr_scene *scene, struct zr_warning_list *warnings);

#endif
