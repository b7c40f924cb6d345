/* lamp.h - shade: the lights of a scene in the eye space of a camera: one array for every shading.
 *
 * GL 2.1's equations (light.h) take lamps in scene order. Linear light (shade/lights/lighting.h) sums lamps without a
 * position first, so its array has them first.
 */
#ifndef ZR_LAMP_H
#define ZR_LAMP_H

#include "shade/lights/lamp_place.h"

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
