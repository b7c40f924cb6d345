/* view_camera.h - scene: the camera of a view, fitted to the geometry. */
#ifndef ZR_VIEW_CAMERA_H
#define ZR_VIEW_CAMERA_H

#include "base/run.h"
#include "base/status.h"
#include "scene/camera/camera.h"
#include "scene/scene.h"

/* Computes the camera of a view. `bounds` are used only if zr_view_needs_bounds. ZR_BAD_SCENE if the view has no
 * solution (the eye is at the target, up is along the view, no distance shows the target), if a matrix entry is beyond
 * ZR_MATRIX_MAX, or if the scene is strict and zr_view_warns. ZR_CANCELLED by `cancel`. */
enum zr_status zr_camera_resolve(const struct zr_run *run, const struct zr_scene *scene, const struct zr_view *view,
                                 const struct zr_bounds *bounds, struct zr_camera *camera);

/* Writes a warning about the view into `text`. False: no warning. */
enum { ZR_VIEW_WARNING_SIZE = 160 };
bool zr_view_warns(const struct zr_camera *camera, char text[ZR_VIEW_WARNING_SIZE]);

#endif
