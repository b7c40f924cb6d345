/* eye_normals.h - shade: normals for shading per pixel.
 *
 * Space:  eye space, unit length, w = 0, on the front side. Zero normals stay zero.
 */
#ifndef ZR_EYE_NORMALS_H
#define ZR_EYE_NORMALS_H

#include "base/run.h"
#include "base/team.h"
#include "core.h"
#include "mesh/crease_normals.h"
#include "shade/attribute.h"

/* Returns the rate of normals: ZR_RATE_FACE, ZR_RATE_VERTEX or ZR_RATE_CORNER. Smooth shadings take the mesh's own
 * normals, or computed ones. Unlit faces, and models of linear light only, take the mesh's own, unless
 * `has_creases`. */
enum zr_rate zr_eye_normals_rate(const struct zr_mesh *mesh, const struct zr_material *material, bool has_creases);

/* Returns the number of normals at that rate. */
uint32_t zr_eye_normals_count(const struct zr_mesh *mesh, enum zr_rate rate);

/* Writes all normals to out[]. crease_normals: for ZR_RATE_CORNER, or NULL. *vertex_normals: as in
 * zr_colors_make. Returns false if the arena has failed. Returns early if cancelled. */
bool zr_eye_normals_make(const struct zr_run *run, const struct zr_mesh *mesh, const zr_mat4 *object_to_eye,
                         enum zr_rate rate, const struct zr_crease_normals *crease_normals,
                         const zr_vec4 **vertex_normals, zr_vec4 *out);

#endif
