/* camera.h - scene: what a view leads to (resolved_view.h): matrices.
 *
 * Space:  world -> eye (the camera looks along -z, y up) -> clip, as in GL.
 * Exact:  a view given as matrices passes through untouched, so that the same
 *         floats can be handed to glLoadMatrixf. Sines and tangents come from
 *         base/trig.h, not libm, so that every machine gets the same bits.
 */
#ifndef ZR_CAMERA_H
#define ZR_CAMERA_H

#include "base/status.h"
#include "scene/scene.h"
#include "zraster.h"

/* Of world-space positions; empty where valid is false. */
struct zr_bounds {
    bool valid;
    zr_vec3 min, max;
};

struct zr_camera {
    zr_mat4 world_to_eye, projection;
    float znear, zfar; /* distances in front of the camera; 0 and 0 with a projectionMatrix */
    float fit_margin; /* what a fitted view leaves free around the geometry, beside its padding, since rounding may move
                       * it: a share of its size; 0 where nothing is fitted */
};

/* Where rays of sight come from, in eye space: a place (w = 1), or, where all are parallel, the unit vector that leads
 * there (w = 0). The origin, but with a projection that moves the eye, or has none. */
zr_vec4 zr_camera_eye(const struct zr_camera *camera);

/* How much longer things are in eye space than in the world: 1, but with a worldToCamera that scales. */
float zr_eye_scale_of(const struct zr_camera *camera);

/* An orthographic camera at `eye` that looks along -back and sees half_size to each side. All in world space; right, up
 * and back have unit length. */
struct zr_camera zr_camera_orthographic(zr_vec3 right, zr_vec3 up, zr_vec3 back, zr_vec3 eye, float half_size,
                                        float near, float far);

/* The diagonal of the bounds; 0 where they are empty. */
float zr_diagonal_of(const struct zr_bounds *bounds);

/* Points at infinity (w = 0), or beyond the range of float, are left out. Walks over all placed points, as
 * zr_camera_resolve does some times more; cancelled, both return early, with what they have. `team` and `cancel` may be
 * NULL. */
struct zr_bounds zr_bounds_of(const struct zr_scene *scene, struct zr_team *team, const struct zr_cancel *cancel);

/* False where the view is given as matrices: then geometry has no say in it. */
static inline bool zr_view_needs_bounds(const struct zr_view *view)
{
    return view->pose != ZR_POSE_MATRIX || view->projection != ZR_PROJECTION_MATRIX;
}

#endif
