/* Projection matrix, with near and far plane, of a view. */
#include "base/trig.h"
#include "scene/camera/camera_parts.h"
#include "scene/camera/margins.h"

/* ---- visible range ---- */

struct tangents {
    double x, y; /* of half the angle of view */
};

static struct tangents tangents_of(const struct zr_view *view)
{
    double width = (double)view->width, height = (double)view->height;
    if (view->xfov_radians > 0.0f) {
        double x = zr_tan((double)view->xfov_radians * 0.5);
        return (struct tangents){x, x * height / width};
    }
    double y = zr_tan((double)view->yfov_radians * 0.5);
    return (struct tangents){width / height * y, y};
}

struct zr_intrinsics zr_view_intrinsics(const struct zr_view *view)
{
    struct zr_intrinsics k = view->intrinsics;
    if (view->projection == ZR_PROJECTION_PERSPECTIVE) {
        const struct tangents t = tangents_of(view);
        k = (struct zr_intrinsics){.fx = 0.5 * (double)view->width / t.x, .fy = 0.5 * (double)view->height / t.y};
    }
    if (!k.has_cx) k.cx = (double)view->width * 0.5;
    if (!k.has_cy) k.cy = (double)view->height * 0.5;
    return k;
}

struct zr_opening zr_opening_of(const struct zr_view *view)
{
    const struct zr_margins free = zr_view_margins(view);
    if (view->projection != ZR_PROJECTION_INTRINSICS) {
        struct tangents t = tangents_of(view);
        return (struct zr_opening){-t.x * (1.0 - 2.0 * free.left), t.x * (1.0 - 2.0 * free.right),
                                   -t.y * (1.0 - 2.0 * free.bottom), t.y * (1.0 - 2.0 * free.top), 0.0};
    }
    struct zr_intrinsics k = zr_view_intrinsics(view);
    double width = (double)view->width, height = (double)view->height;
    return (struct zr_opening){.left = (width * free.left - k.cx) / k.fx,
                               .right = (width * (1.0 - free.right) - k.cx) / k.fx,
                               .bottom = (k.cy - height * (1.0 - free.bottom)) / k.fy,
                               .top = (k.cy - height * free.top) / k.fy,
                               .shear = k.skew / k.fx};
}

/* Finds the half sizes of a window, in its aspect and with padding, that holds the half sizes x and y. */
static void grow_to_window(const struct zr_view *view, double x, double y, double *xmag, double *ymag)
{
    double aspect = (double)view->width / (double)view->height;
    *ymag = fmax(y, x / aspect) / (1.0 - 2.0 * (double)view->fit_padding);
    if (!(*ymag > 0.0)) *ymag = 1.0;
    *xmag = *ymag * aspect;
}

/* Finds the half sizes of a window that holds the extent and its margins, which may differ. */
static void grow_to_margins(const struct zr_view *view, const struct zr_extent *e, double rounding, double *xmag,
                            double *ymag)
{
    const struct zr_margins free = zr_view_margins(view);
    const double aspect = (double)view->width / (double)view->height;
    const double x =
        fmax((rounding - e->min.x) / (1.0 - 2.0 * free.left), (rounding + e->max.x) / (1.0 - 2.0 * free.right));
    const double y =
        fmax((rounding - e->min.y) / (1.0 - 2.0 * free.bottom), (rounding + e->max.y) / (1.0 - 2.0 * free.top));
    *ymag = fmax(y, x / aspect);
    if (!(*ymag > 0.0)) *ymag = 1.0;
    *xmag = *ymag * aspect;
}

/* ---- depth range ---- */

/* Returns the least near distance of a perspective camera: 1e-4 of the far distance, to keep depth precision. A view
 * fitted to one mesh may go nearer, to half that mesh's nearest depth. */
static double least_znear(const struct zr_view *view, const struct zr_extent *fitted, double zfar)
{
    const double least = zfar * 1e-4, nearest = -fitted->max.z;
    return view->fit_to_mesh && nearest > 0.0 ? fmin(least, 0.5 * nearest) : least;
}

/* Sets near and far from the nearest and the farthest point, with a margin for rounding. ZR_BAD_SCENE: near >= far. */
static enum zr_status depth_range(const struct zr_view *view, const struct zr_extent *e, const struct zr_extent *fitted,
                                  double rounding, struct zr_camera *camera, struct zr_error *error)
{
    double nearest = -e->max.z, farthest = -e->min.z;
    double margin = fmax(0.01 * (farthest - nearest), 1e-4 * fmax(fabs(nearest), fabs(farthest)));
    margin = fmax(margin, rounding);
    if (!(margin > 0.0)) margin = 0.01;
    double zfar = view->has_zfar ? (double)view->zfar : farthest + margin;
    double znear = view->has_znear ? (double)view->znear : nearest - margin;
    if (zr_view_is_perspective(view)) {
        if (!(zfar > 0.0)) zfar = view->has_znear ? 2.0 * znear : 1.0; /* all points are behind the eye */
        if (!view->has_znear) znear = fmax(znear, least_znear(view, fitted, zfar));
    }
    if (!(znear < zfar) && !view->has_zfar) zfar = znear + fmax(fabs(znear), 1.0);
    if (!(znear < zfar) && !view->has_znear) znear = zfar - fmax(fabs(zfar) * 0.5, 1e-3);
    camera->znear = (float)znear;
    camera->zfar = (float)zfar;
    if (!(camera->znear < camera->zfar))
        return zr_error_add(error, ZR_BAD_SCENE, "/view", "znear %g and zfar %g leave no depth between them", znear,
                            zfar);
    return ZR_OK;
}

/* ---- matrices ---- */

/* glTF 2.0, section 3.10.3 "Projection Matrices". */
static zr_mat4 perspective(const struct zr_view *view, double n, double f)
{
    struct tangents t = tangents_of(view);
    return (zr_mat4){{(float)(1.0 / t.x), 0, 0, 0, 0, (float)(1.0 / t.y), 0, 0, 0, 0, (float)((f + n) / (n - f)), -1, 0,
                      0, (float)(2.0 * f * n / (n - f)), 0}};
}

/* Maps the pixels of zr_intrinsics, 0..width and 0..height, to -1..1 with y up. */
static zr_mat4 pinhole(const struct zr_view *view, double n, double f)
{
    struct zr_intrinsics k = zr_view_intrinsics(view);
    double x = 2.0 / (double)view->width, y = 2.0 / (double)view->height;
    return (zr_mat4){{(float)(k.fx * x), 0, 0, 0, (float)(0.0 - k.skew * x), (float)(k.fy * y), 0, 0,
                      (float)(1.0 - k.cx * x), (float)(k.cy * y - 1.0), (float)((f + n) / (n - f)), -1, 0, 0,
                      (float)(2.0 * f * n / (n - f)), 0}};
}

static zr_mat4 orthographic(double xmag, double ymag, double n, double f)
{
    return (zr_mat4){{(float)(1.0 / xmag), 0, 0, 0, 0, (float)(1.0 / ymag), 0, 0, 0, 0, (float)(2.0 / (n - f)), 0, 0, 0,
                      (float)((f + n) / (n - f)), 1}};
}

/* Near and far planes may not cut tools of combined solids, which no view fits. */
static struct zr_extent extent_with_tools(const struct zr_points *points, const zr_mat4 *world_to_eye)
{
    struct zr_points all = *points;
    all.with_hidden = true;
    return zr_extent_in_eye_space(&all, world_to_eye, false);
}

enum zr_status zr_camera_project(const struct zr_points *points, const struct zr_bounds *bounds,
                                 const struct zr_bounds *fitted, struct zr_camera *camera, struct zr_error *error)
{
    const struct zr_view *view = points->view;
    if (view->projection == ZR_PROJECTION_MATRIX) { /* independent of the geometry */
        camera->projection = view->projection_matrix;
        return ZR_OK;
    }
    struct zr_extent whole = zr_extent_in_eye_space(points, &camera->world_to_eye, false), e = whole;
    if (points->scene->csg) whole = extent_with_tools(points, &camera->world_to_eye);
    if (view->fit_to_mesh) e = zr_extent_in_eye_space(points, &camera->world_to_eye, true);
    const float *m = camera->world_to_eye.m;
    zr_dvec3 moved = {(double)m[12], (double)m[13], (double)m[14]};
    enum zr_status status = depth_range(view, &whole, &e, zr_rounding_of(bounds, moved), camera, error);
    if (status != ZR_OK) return status;
    double n = (double)camera->znear, f = (double)camera->zfar;
    if (zr_view_is_perspective(view)) {
        bool angles = view->projection == ZR_PROJECTION_PERSPECTIVE;
        camera->projection = angles ? perspective(view, n, f) : pinhole(view, n, f);
        return ZR_OK;
    }
    double xmag = (double)view->xmag, ymag = (double)view->ymag, rounding = zr_rounding_of(fitted, moved);
    const bool is_fitted = !(xmag > 0.0) || !(ymag > 0.0);
    if (is_fitted && zr_view_has_room(view)) {
        struct zr_points seen = *points;
        if (zr_view_fits_corners(view) && fitted->valid) seen.corners = fitted;
        e = zr_extent_in_eye_space(&seen, &camera->world_to_eye, true);
        grow_to_margins(view, &e, rounding, &xmag, &ymag);
    } else if (is_fitted)
        grow_to_window(view, fmax(fabs(e.min.x), fabs(e.max.x)) + rounding,
                       fmax(fabs(e.min.y), fabs(e.max.y)) + rounding, &xmag, &ymag);
    camera->projection = orthographic(xmag, ymag, n, f);
    return ZR_OK;
}
