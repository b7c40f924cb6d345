/* depth_maps.h - render: the scene as others than the camera see it: from below, for its shadow on the ground, and
 * along the light of lamps.
 *
 * Maps show both sides of all faces, and points that the camera never sees.
 */
#ifndef ZR_DEPTH_MAPS_H
#define ZR_DEPTH_MAPS_H

#include "base/team.h"
#include "effects/ground.h"
#include "scene/camera.h"
#include "shade/lights/shadow_map.h"

/* The shadow on the plane under the scene, and where that is. *ground has no light if there is no plane (see
 * effects/ground_view.h). ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_ground_map_draw(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                  const struct zr_camera *camera, const struct zr_bounds *bounds,
                                  const struct zr_cancel *cancel, struct zr_ground *ground,
                                  struct zr_ground_frame *frame);

/* One map per light of the scene, for those that cast shadows. NULL if none does. Status as above. */
enum zr_status zr_shadow_maps_draw(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                   const struct zr_camera *camera, const struct zr_bounds *bounds,
                                   const struct zr_cancel *cancel, const struct zr_shadow_map **maps);

#endif
