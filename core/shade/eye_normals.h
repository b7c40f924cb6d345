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
#include "shade/lights/light.h"

/* Returns the rate of normals: ZR_RATE_FACE, ZR_RATE_VERTEX or ZR_RATE_CORNER. Smooth shadings take the mesh's own
 * normals, or computed ones. Unlit faces, and models of linear light only, take the mesh's own, unless
 * `has_creases`. */
enum zr_rate zr_eye_normals_rate(const struct zr_mesh *mesh, const struct zr_material *material, bool has_creases);

/* Input of the normals of one mesh in one instance. */
struct zr_eye_normals {
    const struct zr_mesh *mesh;
    enum zr_rate rate;
    const zr_vec4 *computed;                 /* vertex normals, for those that the mesh lacks; NULL: not needed */
    const struct zr_crease_normals *creases; /* of corners, instead, for ZR_RATE_CORNER; or NULL */
    uint32_t count;                          /* normals of the mesh at that rate */
    const zr_vec4 *cut; /* normals in eye space of vertices that clipping made, numbered from `count` on; or NULL */
    struct zr_normal_matrix to_eye;
};

/* Finds the input, without `cut`. crease_normals: for ZR_RATE_CORNER, or NULL. *vertex_normals: as in
 * zr_colors_make. Returns false if the arena has failed. */
bool zr_eye_normals_find(const struct zr_run *run, const struct zr_mesh *mesh, const zr_mat4 *object_to_eye,
                         enum zr_rate rate, const struct zr_crease_normals *crease_normals,
                         const zr_vec4 **vertex_normals, struct zr_eye_normals *out);

/* Returns true if the kernel (eye_values_simd.h) can make single normals. */
bool zr_eye_normals_are_single(const struct zr_eye_normals *normals);

/* Writes `count` normals to out[]. Returns early if cancelled. */
void zr_eye_normals_make(const struct zr_run *run, const struct zr_eye_normals *normals, zr_vec4 *out);

/* Writes the normals of up to three numbers below normals->count to out[]. */
void zr_eye_normals_of(const struct zr_run *run, const struct zr_eye_normals *normals, const uint32_t *numbers,
                       uint32_t count, zr_vec4 *out);

#endif
