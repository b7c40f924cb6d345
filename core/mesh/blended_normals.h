/* blended_normals.h - mesh: computed normals of a sectioned mesh, interpolated from those of the whole mesh.
 *
 * Space:  object space.
 * Why:    faces that are cut away still count, so the kept ones are shaded as in the whole mesh. */
#ifndef ZR_BLENDED_NORMALS_H
#define ZR_BLENDED_NORMALS_H

#include "base/arena.h"
#include "base/cancel.h"
#include "mesh/corner_normals.h"
#include "scene/scene.h"

/* Return the normals of positions, and of corners, from those of mesh->source->mesh; 0 in caps and at ends of lines,
 * whose normals are given or unused. Unit length; w = 0 at positions. `whole` may be NULL if the arena failed; they
 * return NULL then. If cancelled, they return early with undefined normals. */
zr_vec4 *zr_blended_position_normals(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_mesh *mesh,
                                     const zr_vec4 *whole);
const struct zr_crease_normals *zr_blended_corner_normals(struct zr_arena *arena, const struct zr_cancel *cancel,
                                                          const struct zr_mesh *mesh,
                                                          const struct zr_crease_normals *whole);

#endif
