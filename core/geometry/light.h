/* light.h - geometry: the lit colour of a point, by GL 2.1's equations.
 *
 * Space:  eye space. Only ambient and diffuse terms; directional lights.
 * Exact:  the order of operations is that of Mesa's fixed-function lighting.
 *         Colours are clamped to 0..1 here, before clipping and interpolation.
 */
#ifndef ZR_LIGHT_H
#define ZR_LIGHT_H

#include "base/arena.h"
#include "scene/scene.h"

struct zr_lighting {
    zr_vec3 ambient;
    uint32_t count;
    const zr_vec3 *to_light; /* unit vectors towards the lights */
    const zr_vec3 *colors;
};

/* How directions of one instance get to eye space. */
struct zr_normal_matrix {
    zr_vec3 rows[3];
};

struct zr_lit {
    zr_vec4 front, back; /* seen from the side the normal points to, and from the other */
};

/* Turns the scene's lights into eye space. `lighting` points into the arena. */
void zr_lighting_make(struct zr_arena *arena, const struct zr_scene *scene, const zr_mat4 *world_to_eye,
                      struct zr_lighting *lighting);

/* The inverse transpose of the upper 3x3, up to a positive factor. */
struct zr_normal_matrix zr_normal_matrix_make(const zr_mat4 *object_to_eye);

/* `normal` in object space, any length; `base` is the surface's own colour. */
struct zr_lit zr_light_point(const struct zr_lighting *lighting, const struct zr_normal_matrix *to_eye, zr_vec3 normal,
                             zr_vec4 base);

#endif
