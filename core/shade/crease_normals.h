/* crease_normals.h - shade: normals of corners, averaged over faces that meet at less than an angle.
 *
 * Space:  object space.
 * How:    the normal of a corner is the sum, over the faces at its vertex whose normals are within
 *         the crease angle of this corner's face's, of (area x corner angle) times the face's unit normal. Vertices are
 *         welded where they lie within 1e-6 of the diagonal of the mesh's bounds.
 * Exact:  sums in the order of faces, whatever the number of threads; + - * / and sqrt only.
 */
#ifndef ZR_CREASE_NORMALS_H
#define ZR_CREASE_NORMALS_H

#include "base/arena.h"
#include "base/team.h"
#include "scene/scene.h"
#include "zraster.h"

/* One unit normal a corner (slot of mesh->indices), w being 0; 0 where faces have no area. `degrees`: 0..180. NULL where
 * the arena has failed; cancelled, it returns early, with numbers that are no normals. */
zr_vec4 *zr_crease_normals_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                                const struct zr_mesh *mesh, float degrees);

#endif
