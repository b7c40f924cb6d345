/* orbit.h - scene: azimuth, elevation and position of a resolved camera.
 *
 * Why:    the channel info reports them for default views and matrices; no pixel depends on them.
 */
#ifndef ZR_ORBIT_H
#define ZR_ORBIT_H

#include "scene/camera.h"

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

#endif
