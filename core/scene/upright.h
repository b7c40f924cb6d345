/* upright.h - scene: views of scenes whose z axis points up. */
#ifndef ZR_UPRIGHT_H
#define ZR_UPRIGHT_H

#include "scene/scene.h"

/* The way that the camera looks, of a pose that gives it as a vector: `direction`, or from `eye` to `target`. 0 for
 * other poses. */
static inline zr_vec3 zr_view_looks_along(const struct zr_view *view)
{
    const zr_vec3 from = view->eye, to = view->target;
    if (view->pose == ZR_POSE_DIRECTION) return view->direction;
    return view->pose == ZR_POSE_LOOK_AT ? (zr_vec3){to.x - from.x, to.y - from.y, to.z - from.z} : (zr_vec3){0, 0, 0};
}

/* The view of a scene in which y is up becomes that of one in which z is: presets and angles are seen as in CAD, the
 * front being on -y, and z is up in the picture where the view did not say what is. */
void zr_view_put_z_up(struct zr_view *view, bool says_up);

#endif
