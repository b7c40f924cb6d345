#include "scene/camera.h"

#include "scene/camera_parts.h"

/* Without column `left_out`. */
static double minor_of(double (*rows)[4], int left_out)
{
    double m[3][3];
    for (int row = 0; row < 3; row++)
        for (int column = 0, k = 0; column < 4; column++)
            if (column != left_out) m[row][k++] = rows[row][column];
    return (m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* The one point, or direction, whose x, y and w are 0 in clip space. */
zr_vec4 zr_camera_eye(const struct zr_camera *camera)
{
    static const int of_clip[3] = {0, 1, 3};
    const float *p = camera->projection.m;
    const zr_vec4 origin = {0, 0, 0, 1};
    double rows[3][4], v[4], scale;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            rows[row][column] = (double)p[4 * column + of_clip[row]];
    for (int k = 0; k < 4; k++)
        v[k] = (k % 2 ? -1.0 : 1.0) * minor_of(rows, k);
    const double length = sqrt((v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]);
    const double farther = ((double)p[2] * v[0] + (double)p[6] * v[1]) + (double)p[10] * v[2];
    if (v[3] != 0.0)
        scale = v[3];
    else if (length > 0.0)
        scale = farther > 0.0 ? -length : length;
    else
        return origin;
    const zr_vec4 eye = {(float)(v[0] / scale), (float)(v[1] / scale), (float)(v[2] / scale),
                         v[3] != 0.0 ? 1.0f : 0.0f};
    return isfinite(eye.x) && isfinite(eye.y) && isfinite(eye.z) ? eye : origin;
}

static enum zr_status check_range(const struct zr_camera *camera, struct zr_error *error)
{
    if (zr_mat4_is_within(&camera->world_to_eye, ZR_MATRIX_MAX) &&
        zr_mat4_is_within(&camera->projection, ZR_MATRIX_MAX) && isfinite(camera->znear) && isfinite(camera->zfar))
        return ZR_OK;
    return zr_error_add(error, ZR_BAD_SCENE, "/view", "the view leads beyond the range of numbers");
}

/* Small things far from the origin shrink in a fitted view, since what rounding may do to them grows with their
 * distance.
 */
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
    const struct zr_view *view = &points->scene->view;
    struct zr_bounds fitted = {.valid = false};
    if (zr_view_needs_bounds(view)) fitted = zr_fit_bounds(points, bounds);
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

enum zr_status zr_camera_resolve(const struct zr_scene *scene, const struct zr_bounds *bounds, struct zr_team *team,
                                 const struct zr_cancel *cancel, struct zr_camera *camera, struct zr_error *error)
{
    const struct zr_points points = {.scene = scene, .team = team, .cancel = cancel};
    enum zr_status status = resolve(&points, bounds, camera, error);
    if (status == ZR_OK && zr_is_cancelled(cancel)) return ZR_CANCELLED;
    return status == ZR_OK ? check_range(camera, error) : status;
}

enum zr_status zr_sight_find(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                             const struct zr_cancel *cancel, const struct zr_sight **out, struct zr_error *error)
{
    struct zr_sight *sight = zr_arena_zero(arena, 1, sizeof *sight);
    *out = sight;
    if (!sight) return ZR_NO_MEMORY;
    if (zr_view_needs_bounds(&scene->view) || zr_scene_wants(scene, ZR_CHANNEL_INFO))
        sight->bounds = zr_bounds_of(scene, team, cancel);
    return zr_camera_resolve(scene, &sight->bounds, team, cancel, &sight->camera, error);
}
