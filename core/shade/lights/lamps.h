/* lamps.h - shade: converts a scene's lights and environment to the lighting of lighting.h. */
#ifndef ZR_LAMPS_H
#define ZR_LAMPS_H

#include "base/arena.h"
#include "scene/camera/camera.h"
#include "shade/lights/lighting.h"
#include "shade/lights/shadow_map.h"

/* Returns the scene's up direction, unit length, in world space. */
zr_vec3 zr_scene_up(const struct zr_scene *scene);

/* Returns the direction in which a directional light travels, or that to a hemisphere's sky: unit length, in eye
 * space. */
zr_vec3 zr_light_direction(const struct zr_scene *scene, const struct zr_light *light, const zr_mat4 *world_to_eye);

/* Makes the lighting, which points into the arena, to the scene and to `shadows`. `bounds`: the scene's. `shadows`: one
 * per light, with depths NULL if it casts none; or NULL. Fails only with the arena. */
void zr_linear_lighting_make(struct zr_arena *arena, const struct zr_scene *scene, const struct zr_camera *camera,
                             const struct zr_bounds *bounds, const struct zr_shadow_map *shadows,
                             struct zr_linear_lighting *lighting);

#endif
