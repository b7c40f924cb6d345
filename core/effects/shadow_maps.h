/* shadow_maps.h - effects: the camera along the light of a lamp, and the shadow map from the depths that it draws. */
#ifndef ZR_SHADOW_MAPS_H
#define ZR_SHADOW_MAPS_H

#include "base/arena.h"
#include "scene/camera.h"
#include "shade/lights/shadow_map.h"

/* A camera with a square window: around the bounds, along a directional lamp; at a spot, within its cone and a little
 * more. `camera` sees the scene. False: the lamp reaches none of the bounds. */
bool zr_light_camera(const struct zr_scene *scene, const struct zr_light *light, const struct zr_camera *camera,
                     const struct zr_bounds *bounds, struct zr_camera *out);

/* The map for the eye space of `camera`, from ZR_SHADOW_SIDE squared depths that `along`, of zr_light_camera, draws;
 * row 0 on top. Its depths are NULL where the arena has failed. */
struct zr_shadow_map zr_shadow_map_make(struct zr_arena *arena, const struct zr_light *light,
                                        const struct zr_camera *camera, const struct zr_bounds *bounds,
                                        const struct zr_camera *along, const float *depths);

#endif
