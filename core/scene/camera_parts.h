/* camera_parts.h - scene: what the files of the camera share; nobody else includes it.
 *
 *     pose.c         view            -> axes
 *     extent.c       geometry        -> bounds, extents in eye space
 *     fit.c          axes, geometry  -> where the eye stands   (points.h)
 *     projection.c   view, geometry  -> projection, near and far plane
 *
 * Doubles inside, floats out: a view is resolved once a request.
 */
#ifndef ZR_CAMERA_PARTS_H
#define ZR_CAMERA_PARTS_H

#include <float.h>
#include <math.h>

#include "scene/camera.h"
#include "scene/points.h"

typedef struct {
    double x, y, z;
} zr_dvec3;

static inline zr_dvec3 zr_dvec3_of(zr_vec3 v)
{
    return (zr_dvec3){(double)v.x, (double)v.y, (double)v.z};
}
static inline zr_dvec3 zr_dvec3_sub(zr_dvec3 a, zr_dvec3 b)
{
    return (zr_dvec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline zr_dvec3 zr_dvec3_add_scaled(zr_dvec3 a, zr_dvec3 b, double s)
{
    return (zr_dvec3){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
}
static inline double zr_dvec3_dot(zr_dvec3 a, zr_dvec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline zr_dvec3 zr_dvec3_cross(zr_dvec3 a, zr_dvec3 b)
{
    return (zr_dvec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* False for points at infinity (w = 0), or beyond the range of float. By 1 nothing need be divided, and mostly that is
 * w: a third of the time of a walk. */
static inline bool zr_place_of(zr_vec4 p, zr_dvec3 *out)
{
    const double w = (double)p.w, most = (double)FLT_MAX;
    *out = (zr_dvec3){(double)p.x, (double)p.y, (double)p.z};
    if (p.w != 1.0f) *out = (zr_dvec3){out->x / w, out->y / w, out->z / w};
    return p.w != 0.0f && fabs(out->x) <= most && fabs(out->y) <= most && fabs(out->z) <= most;
}

/* A camera's place and its axes, of unit length, in world space. */
struct zr_axes {
    zr_dvec3 right, up, back, eye;
};

/* pose.c. Of any pose but ZR_POSE_MATRIX; the eye only of ZR_POSE_LOOK_AT. */
enum zr_status zr_axes_of(const struct zr_view *view, struct zr_axes *axes, struct zr_error *error);
zr_mat4 zr_axes_to_matrix(const struct zr_axes *axes);

struct zr_extent {
    zr_dvec3 min, max;
};

/* extent.c. Bounds of the points in eye space, by the very matrix and in the very floats that
 * they are drawn with; all zero where there is no point. fitted_only: of the mesh that the
 * view is fitted to, where it names one. */
struct zr_extent zr_extent_in_eye_space(const struct zr_points *points, const zr_mat4 *world_to_eye, bool fitted_only);

/* What rounding may add to a place in eye space when projection and view become one matrix. */
double zr_rounding_of(const struct zr_bounds *bounds, zr_dvec3 moved);

/* The diagonal of the bounds; 1 where they have none. */
double zr_size_of(const struct zr_bounds *bounds);

/* The bounds of what the view is fitted to; `whole` are those of the scene. */
struct zr_bounds zr_fit_bounds(const struct zr_points *points, const struct zr_bounds *whole);

/* fit.c. Puts the eye of a pose that leaves that to the geometry. `bounds` are those of what is
 * fitted to. */
enum zr_status zr_fit_eye(const struct zr_points *points, const struct zr_bounds *bounds, struct zr_axes *axes,
                          struct zr_error *error);

/* What a perspective camera sees: (x - shear y) / depth from left to right, y / depth from bottom
 * to top, in eye space. The padding of a fit is taken off. */
struct zr_opening {
    double left, right, bottom, top, shear;
};

/* What extent.c and fit.c measure of points, as kernels: false, and nothing raised, where points are fewer than a
 * vector's lanes, or one is not finite or has a w that is not 1. */

/* Raises most[0], [1], [2] to x, y, z, and [3], [4], [5] to -x, -y, -z. */
typedef bool zr_fit_extent_fn(const zr_vec4 *points, uint32_t count, double most[ZR_MEASURES]);

ZR_KERNEL_TABLE(zr_fit_extent_fn, zr_fit_extent)

enum zr_slope { ZR_SLOPE_RIGHT, ZR_SLOPE_LEFT, ZR_SLOPE_TOP, ZR_SLOPE_BOTTOM, ZR_SLOPE_NEAR };

/* How far points reach across an opening's sides, x, y, z being along the axes from the eye, and x sheared: raises
 * most[ZR_SLOPE_RIGHT] to x + right z, [ZR_SLOPE_LEFT] to -(x + left z), [ZR_SLOPE_TOP] to y + top z,
 * [ZR_SLOPE_BOTTOM] to -(y + bottom z), [ZR_SLOPE_NEAR] to z. */
typedef bool zr_fit_slopes_fn(const struct zr_axes *axes, const struct zr_opening *opening, const zr_vec4 *points,
                              uint32_t count, double most[ZR_MEASURES]);

ZR_KERNEL_TABLE(zr_fit_slopes_fn, zr_fit_slopes)

/* projection.c */
static inline bool zr_view_is_perspective(const struct zr_view *view)
{
    return view->projection == ZR_PROJECTION_PERSPECTIVE || view->projection == ZR_PROJECTION_INTRINSICS;
}
struct zr_opening zr_opening_of(const struct zr_view *view);
enum zr_status zr_camera_project(const struct zr_points *points, const struct zr_bounds *bounds,
                                 const struct zr_bounds *fitted, struct zr_camera *camera, struct zr_error *error);

#endif
