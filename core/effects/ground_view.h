/* ground_view.h - effects: where the plane under a scene is, and the camera below it that draws the map for its shadow
 * (effects/ground.h).
 */
#ifndef ZR_GROUND_VIEW_H
#define ZR_GROUND_VIEW_H

#include "effects/ground.h"
#include "scene/camera.h"

struct zr_ground_view {
    struct zr_camera below;       /* orthographic; its window is square, half_size to each side */
    struct zr_ground_frame frame; /* in the eye space of the camera that sees the scene */
    float half_size;
};

/* False: the bounds are empty or a point, or the camera is not above the plane. */
bool zr_ground_view_find(const struct zr_scene *scene, const struct zr_camera *camera, const struct zr_bounds *bounds,
                         struct zr_ground_view *view);

#endif
