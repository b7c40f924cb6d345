#include "scene/camera.h"

#include "scene/camera_parts.h"

static enum zr_status check_range(const struct zr_camera *camera, struct zr_error *error)
{
    if (zr_mat4_is_within(&camera->world_to_eye, ZR_MATRIX_MAX) &&
        zr_mat4_is_within(&camera->projection, ZR_MATRIX_MAX) && isfinite(camera->znear) && isfinite(camera->zfar))
        return ZR_OK;
    return zr_error_add(error, ZR_BAD_SCENE, "/view", "the view leads beyond the range of numbers");
}

static enum zr_status resolve(const struct zr_scene *scene, const struct zr_bounds *bounds,
                              const struct zr_cancel *cancel, struct zr_camera *camera, struct zr_error *error)
{
    const struct zr_view *view = &scene->view;
    struct zr_bounds fitted = {.valid = false};
    if (zr_view_needs_bounds(view)) fitted = zr_fit_bounds(scene, bounds, cancel);
    *camera = (struct zr_camera){.world_to_eye = view->world_to_camera};
    if (view->pose != ZR_POSE_MATRIX) {
        struct zr_axes axes;
        enum zr_status status = zr_axes_of(view, &axes, error);
        if (status == ZR_OK && view->pose != ZR_POSE_LOOK_AT) status = zr_fit_eye(scene, &fitted, cancel, &axes, error);
        if (status != ZR_OK) return status;
        camera->world_to_eye = zr_axes_to_matrix(&axes);
    }
    return zr_camera_project(scene, bounds, &fitted, cancel, camera, error);
}

enum zr_status zr_camera_resolve(const struct zr_scene *scene, const struct zr_bounds *bounds,
                                 const struct zr_cancel *cancel, struct zr_camera *camera, struct zr_error *error)
{
    enum zr_status status = resolve(scene, bounds, cancel, camera, error);
    if (status == ZR_OK && zr_is_cancelled(cancel)) return ZR_CANCELLED;
    return status == ZR_OK ? check_range(camera, error) : status;
}
