/* camera.h - scene: the matrices of a resolved view (resolved_view.h).
 *
 * Space:  world -> eye (the camera looks along -z, y up) -> clip, as in GL.
 * Exact:  matrices that a view gives pass through unchanged, so that the same floats can be handed to glLoadMatrixf.
 *         Sines and tangents come from base/trig.h, not libm, so that every machine gets the same bits.
 */
#ifndef ZR_CAMERA_H
#define ZR_CAMERA_H

#include "base/status.h"
#include "base/warning_list.h"
#include "core.h"
#include "scene/scene.h"

/* Axis-aligned bounds in world space; empty if not valid. */
struct zr_bounds {
    bool valid;
    zr_vec3 min, max;
};

struct zr_camera {
    zr_mat4 world_to_eye, projection;
    float znear, zfar; /* distances in front of the camera; 0 and 0 with a projectionMatrix */
    float fit_margin; /* fitted view: room for rounding around the geometry, beside the padding, as a share of its size;
                         else 0 */
};

/* Returns the centre of projection in eye space: a point (w = 1), or for parallel rays the unit vector against their
 * direction (w = 0). It is the origin, unless a projection matrix moves it to another finite place. */
zr_vec4 zr_camera_eye(const struct zr_camera *camera);

/* Returns true if a projection mirrors the picture: a triangle that is counter-clockwise for the eye is clockwise in
 * the window. The mirrored axis may be x or y, as in matrices made for Vulkan. Parallel rays along z mirror nothing:
 * with the identity, scenes are drawn in clip space.
 * Source: by Cramer's rule, det [Pa, Pb, Pc] = v3 det [a, b, c, eye] for the rows x, y and w of P, where v3 is
 *         positive for the matrices of glFrustum; for parallel rays, the determinant of P takes its place. */
bool zr_projection_is_mirror(const zr_mat4 *projection);

/* Returns true if points farther from an eye have smaller depths (a reversed z). False for parallel rays, whose
 * direction follows from z. */
bool zr_projection_is_reversed(const zr_mat4 *projection);

/* Returns true if triangles that are counter-clockwise in object space, seen from the eye, are clockwise in the
 * window. */
bool zr_camera_reverses_windings(const struct zr_camera *camera, const zr_mat4 *object_to_world);

/* Returns the scale factor of lengths from world to eye space: 1 unless a worldToCamera scales by more than 0.001. */
float zr_eye_scale_of(const struct zr_camera *camera);

/* Returns an orthographic camera at `eye` that looks along -back; its window extends by half_size to each side. All in
 * world space; right, up and back have unit length. */
struct zr_camera zr_camera_orthographic(zr_vec3 right, zr_vec3 up, zr_vec3 back, zr_vec3 eye, float half_size,
                                        float near, float far);

/* Returns the length of the diagonal; 0 for empty bounds. */
float zr_diagonal_of(const struct zr_bounds *bounds);

/* Returns the bounds of all instances, without points at infinity (w = 0) or beyond the range of float. Visits every
 * point of every instance, unless the scene has its box. If cancelled, returns the bounds so far. `team` and `cancel`
 * may be NULL. */
struct zr_bounds zr_bounds_of(const struct zr_scene *scene, struct zr_team *team, const struct zr_cancel *cancel);

/* False if pose and projection are both matrices: the view then does not depend on the geometry. */
static inline bool zr_view_needs_bounds(const struct zr_view *view)
{
    return view->pose != ZR_POSE_MATRIX || view->projection != ZR_PROJECTION_MATRIX;
}

/* Azimuth, elevation and position of a resolved camera. The channel info reports them for default views and matrices;
 * no pixel depends on them. */
struct zr_orbit {
    bool has_angles; /* false if worldToCamera has no inverse */
    /* Direction from the target to the camera, as azimuthDegrees and elevationDegrees of a view, rounded to 0.001;
     * -180 < azimuth <= 180, and 0 straight above and below. */
    double azimuth_degrees, elevation_degrees;
    bool has_eye; /* false if rays are parallel */
    zr_vec3 eye;  /* world space */
};

/* Computes them from the matrices. z_is_up: angles relative to the z axis, else to y. */
struct zr_orbit zr_orbit_of(const struct zr_camera *camera, bool z_is_up);

/* ---- pose.c: checks of a pose that is given as a matrix ----
 *
 * Source: a rigid motion keeps lengths and handedness: the upper 3x3 has rows of the length 1, at right angles, and a
 *         positive determinant.
 */

/* Returns the factor by which the upper 3x3 scales lengths; 0 if it depends on the direction. Factors within 0.001 of 1
 * come from rounding and give 1. */
double zr_pose_matrix_scale(const zr_mat4 *world_to_eye);

/* Divides a pose by its uniform scale, so that distances of the view and its outputs are in scene units. A
 * camera below a scaled node has such a pose. A pose with another scale stays as it is. */
void zr_pose_remove_scale(zr_mat4 *world_to_camera);

/* Adds a warning if pose and projectionMatrix together mirror the picture, one for a reversed z, and one for a scaling
 * pose if outputs hold eye-space lengths, which are then not in scene units. */
void zr_view_matrices_warn(struct zr_arena *arena, const struct zr_view *view, struct zr_warning_list *warnings);

#endif
