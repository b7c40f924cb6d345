/* eye_normals.h - shade: the normals that surfaces are shaded by where they are looked at pixel by pixel.
 *
 * Space:  eye space, unit length, w = 0, on the side that is the front; a zero normal stays one.
 */
#ifndef ZR_EYE_NORMALS_H
#define ZR_EYE_NORMALS_H

#include "base/team.h"
#include "shade/attribute.h"
#include "zraster.h"

/* At which rate faces of this material have normals: ZR_RATE_FACE, ZR_RATE_VERTEX or ZR_RATE_CORNER. Smooth shading has
 * the vertices' own, or computed ones; unlit faces have those that are given, and so have those of models that only a
 * picture's samples are shaded by, unless `has_creases`. */
enum zr_rate zr_eye_normals_rate(const struct zr_mesh *mesh, const struct zr_material *material, bool has_creases);

/* How many a mesh has at that rate. */
uint32_t zr_eye_normals_count(const struct zr_mesh *mesh, enum zr_rate rate);

/* All of them, to out[]. crease_normals: of corners, for ZR_RATE_CORNER, or NULL. *vertex_normals as in zr_colors_make.
 * False where the arena has failed. Cancelled, it returns early. */
bool zr_eye_normals_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                         const struct zr_mesh *mesh, const zr_mat4 *object_to_eye, enum zr_rate rate,
                         const zr_vec4 *crease_normals, const zr_vec4 **vertex_normals, zr_vec4 *out);

#endif
