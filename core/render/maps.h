/* maps.h - render: the scene as others than the camera see it: from below, for its shadow on the ground, and along the
 * light of lamps.
 *
 * All faces are seen from both sides there. Points that the camera never sees are in the maps.
 */
#ifndef ZR_MAPS_H
#define ZR_MAPS_H

#include "base/team.h"
#include "effects/ground.h"
#include "effects/occlusion.h"
#include "scene/camera.h"
#include "scene/scene.h"
#include "shade/lights/shadow_map.h"

/* The diagonal of the bounds; 0 where there are none. */
float zr_diagonal_of(const struct zr_bounds *bounds);

/* How large things are in pixels, in a window of that height. */
struct zr_pixel_scale zr_pixel_scale_of(const struct zr_camera *camera, uint32_t height);

/* The shadow on the plane under the scene, and where that is. *ground has no light where the camera is not above the
 * plane, or there are no bounds. ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_ground_map_make(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                  const struct zr_camera *camera, const struct zr_bounds *bounds,
                                  const struct zr_cancel *cancel, struct zr_ground *ground,
                                  struct zr_ground_frame *frame);

/* The rays through the pixels of a window, from the eye or, where all are parallel, from where they are in front of
 * it. False where the projection has none. */
bool zr_rays_of(const struct zr_camera *camera, uint32_t width, uint32_t height, struct zr_rays *rays);

/* What a spot sees of the scene, within its cone and a little more: a camera at its place, whose window is square.
 * False where it sees nothing. */
bool zr_spot_camera(const struct zr_scene *scene, const struct zr_light *light, const struct zr_camera *camera,
                    const struct zr_bounds *bounds, struct zr_camera *out);

/* One a light of the scene, for those that cast shadows. NULL where none does. */
enum zr_status zr_shadow_maps_make(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                   const struct zr_camera *camera, const struct zr_bounds *bounds,
                                   const struct zr_cancel *cancel, const struct zr_shadow_map **maps);

#endif
