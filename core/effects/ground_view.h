/* ground_view.h - effects: plane under a scene, and the camera below it that draws the map of its shadow
 * (effects/ground.h). */
#ifndef ZR_GROUND_VIEW_H
#define ZR_GROUND_VIEW_H

#include "effects/ground.h"
#include "scene/camera.h"

struct zr_ground_view {
    struct zr_camera below;       /* orthographic, with a square window of half_size to each side */
    struct zr_ground_frame frame; /* in the eye space of the scene's camera */
    float half_size;              /* of the map, scene units */
};

/* Finds plane and camera. `camera` and `bounds` are the scene's. False: the bounds are empty or a point, or the camera
 * is not above the plane. */
bool zr_ground_view_find(const struct zr_scene *scene, const struct zr_camera *camera, const struct zr_bounds *bounds,
                         struct zr_ground_view *view);

#endif
