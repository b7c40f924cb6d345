/* light.h - shade: the lit colour of a point, by GL 2.1's equations.
 *
 * Space:  eye space. Ambient and diffuse terms only; directional lights and those with a position (lamp.h).
 * Exact:  the order of operations is that of Mesa's fixed-function lighting. Colours are clamped to 0..1 here, before
 *         clipping and interpolation.
 */
#ifndef ZR_LIGHT_H
#define ZR_LIGHT_H

#include "base/arena.h"
#include "base/isa.h"
#include "scene/scene.h"
#include "shade/lights/lamp.h"

/* Matrix that takes an instance's normals to eye space. */
struct zr_normal_matrix {
    zr_vec3 rows[3];
};

/* Converts the scene's lights, in its order. Directions are rotated with Mesa's order of sums. The result points
 * into the arena. Fails only if the arena does. */
struct zr_lights zr_lights_make(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_camera *camera);

/* Returns the inverse transpose of the upper 3x3, up to a positive factor. */
struct zr_normal_matrix zr_normal_matrix_make(const zr_mat4 *object_to_eye);

/* Lights many points at a time; with vectorized normals, a lit mesh takes a third less time. Per point: `normals` has
 * xyz in object space, of any length, and an unused w; `bases` is the surface's own colour. `front` is the colour seen
 * from the normal's side, `back` that from the other. If both are one array, it receives front. A kernel. */
typedef void zr_light_fn(const struct zr_lights *lights, const struct zr_normal_matrix *to_eye, const zr_vec4 *normals,
                         const zr_vec4 *bases, size_t count, zr_vec4 *front, zr_vec4 *back);

ZR_KERNEL_TABLE(zr_light_fn, zr_light)

/* The same if lights->placed_count > 0. `points`: xyz in eye space, from lights->start. A kernel. */
typedef void zr_light_placed_fn(const struct zr_lights *lights, const struct zr_normal_matrix *to_eye,
                                const zr_vec4 *normals, const zr_vec4 *points, const zr_vec4 *bases, size_t count,
                                zr_vec4 *front, zr_vec4 *back);

ZR_KERNEL_TABLE(zr_light_placed_fn, zr_light_placed)

/* Converts normals of any length in object space to unit normals in eye space, in place. A kernel. */
typedef void zr_to_eye_fn(const struct zr_normal_matrix *to_eye, zr_vec4 *normals, size_t count);

ZR_KERNEL_TABLE(zr_to_eye_fn, zr_to_eye)

#endif
