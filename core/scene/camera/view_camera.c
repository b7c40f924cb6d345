#include "scene/camera/view_camera.h"

#include <math.h>
#include <stdio.h>

#include "base/cancel.h"
#include "base/run.h"
#include "scene/camera/camera_parts.h"
#include "scene/camera/extent_view.h"
#include "scene/picture.h"

static enum zr_status check_range(const struct zr_camera *camera, struct zr_error *error)
{
    if (zr_mat4_is_within(&camera->world_to_eye, ZR_MATRIX_MAX) &&
        zr_mat4_is_within(&camera->projection, ZR_MATRIX_MAX) && isfinite(camera->znear) && isfinite(camera->zfar))
        return ZR_OK;
    return zr_error_add(error, ZR_BAD_SCENE, "/view", "the numbers of the camera overflow");
}

/* Returns zr_camera.fit_margin. Small geometry far from the origin gets a large margin, since rounding errors grow with
 * the distance. */
static float fit_margin_of(const struct zr_view *view, const struct zr_bounds *fitted, const zr_mat4 *world_to_eye)
{
    const bool fits_pose = view->pose == ZR_POSE_PRESET || view->pose == ZR_POSE_DIRECTION ||
                           (view->pose == ZR_POSE_ORBIT && !(view->distance > 0.0f));
    const bool fits_size = view->projection == ZR_PROJECTION_ORTHOGRAPHIC && !(view->xmag > 0.0f);
    if (!fitted->valid || !(fits_size || (fits_pose && zr_view_is_perspective(view)))) return 0.0f;
    const float *m = world_to_eye->m;
    return (float)(zr_rounding_of(fitted, (zr_dvec3){(double)m[12], (double)m[13], (double)m[14]}) /
                   zr_size_of(fitted));
}

static enum zr_status resolve(const struct zr_points *points, const struct zr_bounds *bounds, struct zr_camera *camera,
                              struct zr_error *error)
{
    const struct zr_view *view = points->view;
    struct zr_bounds fitted = {.valid = false};
    if (zr_view_needs_bounds(view)) fitted = zr_fit_bounds(points, bounds);
    struct zr_view suited = *view;
    zr_view_suit_extent(&suited, &fitted, points->scene->picture->z_is_up);
    struct zr_points seen = *points;
    seen.view = view = &suited;
    points = &seen;
    *camera = (struct zr_camera){.world_to_eye = view->world_to_camera};
    if (view->pose != ZR_POSE_MATRIX) {
        struct zr_axes axes;
        enum zr_status status = zr_axes_of(view, &axes, error);
        if (status == ZR_OK && view->pose != ZR_POSE_LOOK_AT) status = zr_fit_eye(points, &fitted, &axes, error);
        if (status != ZR_OK) return status;
        camera->world_to_eye = zr_axes_to_matrix(&axes);
    }
    camera->fit_margin = fit_margin_of(view, &fitted, &camera->world_to_eye);
    return zr_camera_project(points, bounds, &fitted, camera, error);
}

/* Share of the geometry's size from which a margin is visible and reported. */
static const float MARGIN_SEEN = 0.01f;

bool zr_view_warns(const struct zr_camera *camera, char text[ZR_VIEW_WARNING_SIZE])
{
    if (!(camera->fit_margin > MARGIN_SEEN)) return false;
    snprintf(text, ZR_VIEW_WARNING_SIZE,
             "the geometry is small and far from the origin: rounding may move it by %.2g of its size, and the fitted "
             "view leaves room for that",
             (double)camera->fit_margin);
    return true;
}

/* Refuses a warning if the scene is strict. */
static enum zr_status refuse_odd(const struct zr_scene *scene, const struct zr_camera *camera, struct zr_error *error)
{
    char text[ZR_VIEW_WARNING_SIZE];
    if (!scene->is_strict || !zr_view_warns(camera, text)) return ZR_OK;
    return zr_error_add(error, ZR_BAD_SCENE, NULL, "%s", text);
}

enum zr_status zr_camera_resolve(const struct zr_run *run, const struct zr_scene *scene, const struct zr_view *view,
                                 const struct zr_bounds *bounds, struct zr_camera *camera)
{
    const struct zr_points points = {.scene = scene, .view = view, .team = run->team, .cancel = run->cancel};
    enum zr_status status = resolve(&points, bounds, camera, run->error);
    if (status == ZR_OK && zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    if (status == ZR_OK) status = check_range(camera, run->error);
    return status == ZR_OK ? refuse_odd(scene, camera, run->error) : status;
}
