/* lamp_place.h - shade: lamps that have a place, and how their light falls off, by KHR_lights_punctual.
 *
 * Space:  eye space, counted from the eye (zr_camera_eye), or, where rays of sight are parallel, from its origin: as
 *         points of surfaces are (gbuffer.h).
 * At a distance d, in scene units, from a lamp of the intensity I, and the angle a from its axis, there arrives
 *         I / d^2 * max(0, 1 - (d / range)^4) * clamp(angle_scale cos(a) + angle_offset)^2.
 * A point lamp is a spot without an axis, and what has no range has an `end` of 0, so that one loop does for all.
 */
#ifndef ZR_LAMP_PLACE_H
#define ZR_LAMP_PLACE_H

#include "scene/camera.h"

struct zr_lamp_place {
    zr_vec3 position; /* of the lamp */
    zr_vec3 axis;     /* of a spot: a unit vector against its light; of a point lamp: 0 */
    float angle_scale, angle_offset;
    float end;   /* 1 / range^2, in the units of eye space */
    float gain;  /* a distance of 1 in scene units, squared, in those of eye space: 1, but where the view scales */
    float least; /* squares of distances are this at least, so that what arrives stays below ZR_LAMP_SHARE_MAX */
};

/* Of what arrives: far beyond all that is seen, and far from the end of float, also times the largest exposure. */
#define ZR_LAMP_SHARE_MAX 1e20f
/* Squares of distances at which nothing arrives. */
#define ZR_LAMP_FAR 1e30f

/* `light` has a place. */
struct zr_lamp_place zr_lamp_place_of(const struct zr_light *light, const struct zr_camera *camera);

#endif
