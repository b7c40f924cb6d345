#include "scene/orbit.h"

#include <math.h>

#include "base/matrix.h"

static const double DEGREES = 180.0 / 3.14159265358979323846;

/* Rounds to 0.001, without -0: the last bits of libm differ between systems, and float matrices hold no more digits. */
static double rounded(double degrees)
{
    return round(degrees * 1000.0) / 1000.0 + 0.0;
}

/* Sets the angles of `back`, the world-space direction towards the camera. Its horizontal parts are `front` (azimuth 0)
 * and `right` (azimuth 90). */
static void set_angles(struct zr_orbit *orbit, const double back[4], bool z_is_up)
{
    const double right = back[0], front = z_is_up ? -back[1] : back[2], up = z_is_up ? back[2] : back[1];
    const double level = hypot(right, front), length = hypot(level, up);
    if (!(length > 0.0) || !isfinite(length)) return;
    orbit->has_angles = true;
    orbit->elevation_degrees = rounded(atan2(up, level) * DEGREES);
    if (level > 1e-6 * length) orbit->azimuth_degrees = rounded(atan2(right, front) * DEGREES);
    if (orbit->azimuth_degrees <= -180.0) orbit->azimuth_degrees = 180.0;
}

struct zr_orbit zr_orbit_of(const struct zr_camera *camera, bool z_is_up)
{
    struct zr_orbit orbit = {.has_angles = false};
    const struct zr_matrix world_to_eye = zr_matrix_of(&camera->world_to_eye);
    const zr_vec4 eye = zr_camera_eye(camera);
    const double backwards[4] = {0, 0, 1, 0}, place[4] = {(double)eye.x, (double)eye.y, (double)eye.z, 1};
    struct zr_matrix eye_to_world;
    double back[4], at[4];
    if (!zr_matrix_invert(&world_to_eye, &eye_to_world)) return orbit;
    zr_matrix_apply(&eye_to_world, backwards, back);
    set_angles(&orbit, back, z_is_up);
    zr_matrix_apply(&eye_to_world, place, at);
    orbit.eye = (zr_vec3){(float)(at[0] / at[3]), (float)(at[1] / at[3]), (float)(at[2] / at[3])};
    orbit.has_eye = eye.w != 0.0f && isfinite(orbit.eye.x) && isfinite(orbit.eye.y) && isfinite(orbit.eye.z);
    return orbit;
}
