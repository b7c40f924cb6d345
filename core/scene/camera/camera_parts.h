/* camera_parts.h - scene: internal declarations of the files that resolve a view.
 *
 *     pose.c         view            -> axes
 *     extent.c       geometry        -> bounds, extents in eye space
 *     fit.c          axes, geometry  -> position of the eye    (points.h)
 *     projection.c   view, geometry  -> projection, near and far plane
 *
 * They compute in double and return floats: a view is resolved once per request.
 */
#ifndef ZR_CAMERA_PARTS_H
#define ZR_CAMERA_PARTS_H

#include "base/dvec3.h"
#include "scene/camera/camera.h"
#include "scene/camera/points.h"

/* Position and unit axes of a camera, in world space. */
struct zr_axes {
    zr_dvec3 right, up, back, eye;
};

/* pose.c. Finds the axes of any pose except ZR_POSE_MATRIX; sets the eye of ZR_POSE_LOOK_AT only, else 0. ZR_BAD_SCENE
 * if the view has no direction or no up. */
enum zr_status zr_axes_of(const struct zr_view *view, struct zr_axes *axes, struct zr_error *error);
/* Returns the matrix from world to eye space. */
zr_mat4 zr_axes_to_matrix(const struct zr_axes *axes);

struct zr_extent {
    zr_dvec3 min, max;
};

/* extent.c. Returns the bounds of the points in eye space, in the same floats as drawing; all zero without points.
 * fitted_only: points of the fitted mesh only, if the view names one. */
struct zr_extent zr_extent_in_eye_space(const struct zr_points *points, const zr_mat4 *world_to_eye, bool fitted_only);

/* Returns a bound on the rounding error of an eye-space coordinate when projection and view become one matrix. `moved`:
 * translation of the view. */
double zr_rounding_of(const struct zr_bounds *bounds, zr_dvec3 moved);

/* Returns the length of the diagonal; 1 if it is 0 or the bounds are empty. */
double zr_size_of(const struct zr_bounds *bounds);

/* Returns the world-space bounds of the fitted mesh, or `whole`, those of the scene, if the view names no mesh. */
struct zr_bounds zr_fit_bounds(const struct zr_points *points, const struct zr_bounds *whole);

/* fit.c. Sets axes->eye of a fitted pose. `bounds`: result of zr_fit_bounds. ZR_BAD_SCENE if no distance shows a
 * target. */
enum zr_status zr_fit_eye(const struct zr_points *points, const struct zr_bounds *bounds, struct zr_axes *axes,
                          struct zr_error *error);

/* Visible range of a perspective camera, in eye space: left <= (x - shear y) / depth <= right and bottom <= y / depth
 * <= top. Smaller than the window by the fit padding. */
struct zr_opening {
    double left, right, bottom, top, shear;
};

/* Kernels that measure points for extent.c and fit.c. They return false and change nothing if there are fewer points
 * than lanes, or if a point is not finite or has w other than 1. */

/* Raises most[0], [1], [2] to the largest x, y, z, and [3], [4], [5] to the largest -x, -y, -z. */
typedef bool zr_fit_extent_fn(const zr_vec4 *points, uint32_t count, double most[ZR_MEASURES]);

ZR_KERNEL_TABLE(zr_fit_extent_fn, zr_fit_extent)

enum zr_slope { ZR_SLOPE_RIGHT, ZR_SLOPE_LEFT, ZR_SLOPE_TOP, ZR_SLOPE_BOTTOM, ZR_SLOPE_NEAR };

/* Measures points against the sides of an opening, in coordinates along the axes from the eye, with shear y subtracted
 * from x. Raises most[ZR_SLOPE_RIGHT] to x + right z, [ZR_SLOPE_LEFT] to -(x + left z), [ZR_SLOPE_TOP] to y + top z,
 * [ZR_SLOPE_BOTTOM] to -(y + bottom z), [ZR_SLOPE_NEAR] to z. */
typedef bool zr_fit_slopes_fn(const struct zr_axes *axes, const struct zr_opening *opening, const zr_vec4 *points,
                              uint32_t count, double most[ZR_MEASURES]);

ZR_KERNEL_TABLE(zr_fit_slopes_fn, zr_fit_slopes)

/* projection.c */
static inline bool zr_view_is_perspective(const struct zr_view *view)
{
    return view->projection == ZR_PROJECTION_PERSPECTIVE || view->projection == ZR_PROJECTION_INTRINSICS;
}
/* Returns the pinhole of a perspective view, with its principal point. */
struct zr_intrinsics zr_view_intrinsics(const struct zr_view *view);
/* Returns the opening of a perspective view. */
struct zr_opening zr_opening_of(const struct zr_view *view);
/* Sets the projection, near and far plane of a camera whose world_to_eye is set. `bounds`: the scene's; `fitted`:
 * result of zr_fit_bounds. ZR_BAD_SCENE if near is not in front of far. */
enum zr_status zr_camera_project(const struct zr_points *points, const struct zr_bounds *bounds,
                                 const struct zr_bounds *fitted, struct zr_camera *camera, struct zr_error *error);

#endif
