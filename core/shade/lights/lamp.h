/* lamp.h - shade: the lights of a scene in the eye space of a camera: one array for every shading.
 *
 * GL 2.1's equations (light.h) take lamps in scene order. Linear light (shade/lights/lighting.h) sums lamps without a
 * position first, so its array has them first.
 *
 * Falloff of lamps with a position, by KHR_lights_punctual:
 * Space:  eye space, from the eye (zr_camera_eye), or, with parallel view rays, from its origin, like points of
 *         surfaces (gbuffer.h).
 * At distance d, in scene units, from a lamp of intensity I, and at angle a from its axis, the light that arrives is
 *         I / d^2 * max(0, 1 - (d / range)^4) * clamp(angle_scale cos(a) + angle_offset)^2.
 * A point lamp is a spot without an axis, and without a range `end` is 0, so one loop handles all.
 */
#ifndef ZR_LAMP_H
#define ZR_LAMP_H

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

struct zr_shadow_map; /* shade/lights/shadow_map.h */

struct zr_lamp {
    bool is_placed;                     /* point lamp or spot; else only a direction */
    bool is_hemisphere;                 /* ambient light: `color` from the sky, `ground` from below */
    bool lights_pbr;                    /* in linear light: lights surfaces with pbr */
    bool lights_classic;                /* in linear light: lights surfaces with flat, gouraud or phong */
    zr_vec3 to_light;                   /* unit vector; hemisphere: up; unset if placed */
    zr_vec3 color;                      /* at normal incidence; if placed: at a distance of 1 */
    zr_vec3 ground;                     /* hemisphere */
    struct zr_lamp_place place;         /* if placed */
    const struct zr_shadow_map *shadow; /* shadow of a directional lamp or spot; NULL: casts none */
};

struct zr_lights {
    zr_vec3 ambient;
    uint32_t count, placed_count; /* placed_count: lamps with is_placed */
    const struct zr_lamp *lamps;
    zr_vec3 start;     /* origin of points: the eye, or the origin of eye space */
    bool is_per_pixel; /* lit after visibility, from base colours, for all shadings */
};

#endif
