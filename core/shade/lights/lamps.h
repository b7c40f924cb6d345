/* lamps.h - shade: what a scene says of light -> lighting.h's, in the eye space of a camera. */
#ifndef ZR_LAMPS_H
#define ZR_LAMPS_H

#include "base/arena.h"
#include "scene/camera.h"
#include "shade/lights/lighting.h"
#include "shade/lights/shadow_map.h"

/* The scene's up, unit length, in world space. */
zr_vec3 zr_look_up(const struct zr_scene *scene);

/* The way that a directional light travels, or to a hemisphere's sky: unit length, in eye space. */
zr_vec3 zr_look_light_direction(const struct zr_scene *scene, const struct zr_light *light,
                                const zr_mat4 *world_to_eye);

/* `shadows`: one a light of the scene, whose depths are NULL where it casts none; or NULL. Points into the arena, to
 * the scene and to `shadows`; fails only with the arena. */
void zr_linear_lighting_make(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_camera *camera,
                             const struct zr_shadow_map *shadows, struct zr_linear_lighting *lighting);

#endif
