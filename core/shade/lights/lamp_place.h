/* lamp_place.h - shade: lamps with a position, and their falloff by KHR_lights_punctual.
 *
 * Space:  eye space, from the eye (zr_camera_eye), or, with parallel view rays, from its origin, like points of
 *         surfaces (gbuffer.h).
 * At distance d, in scene units, from a lamp of intensity I, and at angle a from its axis, the light that arrives is
 *         I / d^2 * max(0, 1 - (d / range)^4) * clamp(angle_scale cos(a) + angle_offset)^2.
 * A point lamp is a spot without an axis, and without a range `end` is 0, so one loop handles all.
 */
#ifndef ZR_LAMP_PLACE_H
#define ZR_LAMP_PLACE_H

#include "scene/camera/camera.h"

struct zr_lamp_place {
    zr_vec3 position;
    zr_vec3 axis; /* of a spot: unit vector against its light; of a point lamp: 0 */
    float angle_scale, angle_offset;
    float end;   /* 1 / range^2, in eye space units; 0: no range */
    float gain;  /* square of a scene unit in eye space units: 1 unless the view scales */
    float least; /* lower bound of squared distances; keeps the arriving light below ZR_LAMP_SHARE_MAX */
};

/* Upper bound of the arriving light: beyond all visible values, and far from float's largest, even times the largest
 * exposure. */
#define ZR_LAMP_SHARE_MAX 1e20f
/* Squared distance from which on nothing arrives. */
#define ZR_LAMP_FAR 1e30f

/* Converts a light that has a position. */
struct zr_lamp_place zr_lamp_place_of(const struct zr_light *light, const struct zr_camera *camera);

#endif
