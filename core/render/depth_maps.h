/* depth_maps.h - render: depth maps for shadows: the scene seen from below, for the ground, and along the lights.
 *
 * Maps contain both sides of all faces, and geometry outside of the camera's view.
 */
#ifndef ZR_DEPTH_MAPS_H
#define ZR_DEPTH_MAPS_H

#include "base/run.h"
#include "base/team.h"
#include "effects/ground.h"
#include "scene/camera/camera.h"
#include "shade/lights/shadow_map.h"

/* Draws the shadow that the scene casts on the ground plane, and finds the plane's frame. Without a plane,
 * ground->light is NULL (effects/ground.h). Returns ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_ground_map_draw(const struct zr_run *run, const struct zr_scene *scene,
                                  const struct zr_camera *camera, const struct zr_bounds *bounds,
                                  struct zr_ground *ground, struct zr_ground_frame *frame);

/* Draws one map for each light that casts shadows. maps[i] belongs to light i; *maps is NULL if no light casts any.
 * Returns as above. */
enum zr_status zr_shadow_maps_draw(const struct zr_run *run, const struct zr_scene *scene,
                                   const struct zr_camera *camera, const struct zr_bounds *bounds,
                                   const struct zr_shadow_map **maps);

#endif
