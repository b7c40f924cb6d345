/* orbit.h - scene: where a camera stands, as a view's angles say it.
 *
 * Why:    what the default view of a look is, and what a matrix leads to, is for people to read; no pixel depends on
 * it.
 */
#ifndef ZR_ORBIT_H
#define ZR_ORBIT_H

#include "scene/camera.h"

struct zr_orbit {
    bool has_angles; /* false where worldToCamera has no inverse in floats */
    /* Of the way from what is seen to the camera: as azimuthDegrees and elevationDegrees of a view with that up, to
     * 0.001; -180 < azimuth <= 180, and 0 straight above and below. */
    double azimuth_degrees, elevation_degrees;
    bool has_eye; /* false where rays are parallel */
    zr_vec3 eye;  /* in the world */
};

struct zr_orbit zr_orbit_of(const struct zr_camera *camera, bool z_is_up);

#endif
