/* eye_normals.h - geometry: the normals that surfaces are shaded by where they are looked at pixel by pixel.
 *
 * Space:  eye space, unit length, w = 0, on the side that is the front; a zero normal stays one.
 */
#ifndef ZR_EYE_NORMALS_H
#define ZR_EYE_NORMALS_H

#include "base/team.h"
#include "geometry/batch.h"
#include "zraster.h"

/* How many normals of a face of this material there are: ZR_BATCH_PER_FACE, ZR_BATCH_PER_VERTEX or ZR_BATCH_PER_CORNER.
 * Smooth shading has the vertices' own, or computed ones; unlit faces have those that are given. */
enum zr_batch_rate zr_eye_normals_rate(const struct zr_mesh *mesh, const struct zr_material *material);

/* Of all faces, positions or corners of the mesh, as the rate says. *vertex_normals as in zr_colors_make. NULL where
 * the arena has failed. Cancelled, it returns early. */
const zr_vec4 *zr_eye_normals_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                                   const struct zr_mesh *mesh, const zr_mat4 *object_to_eye, enum zr_batch_rate rate,
                                   const zr_vec4 **vertex_normals);

#endif
