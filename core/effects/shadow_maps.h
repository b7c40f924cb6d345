/* shadow_maps.h - effects: cameras that draw depths along a light, and shadow maps made from these depths. */
#ifndef ZR_SHADOW_MAPS_H
#define ZR_SHADOW_MAPS_H

#include "base/arena.h"
#include "scene/camera/camera.h"
#include "shade/lights/shadow_map.h"

/* Makes a camera along a light, with a square window: orthographic around the bounds for a directional light,
 * perspective from the position of a spot, slightly wider than its cone. `camera` is the scene's. False: the bounds are
 * behind the spot, or the view has no inverse. */
bool zr_light_camera(const struct zr_scene *scene, const struct zr_light *light, const struct zr_camera *camera,
                     const struct zr_bounds *bounds, struct zr_camera *out);

/* Makes the shadow map for points in the eye space of `camera`. `depths`: ZR_SHADOW_SIDE squared values drawn by
 * `along`, the camera of zr_light_camera, row 0 on top. map.depths is NULL if the arena failed. */
struct zr_shadow_map zr_shadow_map_make(struct zr_arena *arena, const struct zr_light *light,
                                        const struct zr_camera *camera, const struct zr_bounds *bounds,
                                        const struct zr_camera *along, const float *depths);

#endif
