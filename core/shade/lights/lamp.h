/* lamp.h - shade: the lights of a scene in the eye space of a camera: one array for every shading.
 *
 * GL 2.1's equations (light.h) take lamps in the order of the scene. Linear light (shade/lights/lighting.h) sums those
 * without a place first, so that they come first in its array.
 */
#ifndef ZR_LAMP_H
#define ZR_LAMP_H

#include "shade/lights/lamp_place.h"

struct zr_shadow_map; /* shade/lights/shadow_map.h */

struct zr_lamp {
    bool is_placed;                     /* a point lamp or a spot; else it has a direction alone */
    bool is_hemisphere;                 /* light from all around: `color` from the sky, `ground` from below */
    bool lights_pbr;                    /* in linear light, by the shading of the surface; */
    bool lights_classic;                /* classic: flat, gouraud, phong */
    zr_vec3 to_light;                   /* unit; of a hemisphere: its up; of a placed lamp: not set */
    zr_vec3 color;                      /* at normal incidence; of a placed lamp: at a distance of 1 */
    zr_vec3 ground;                     /* of a hemisphere */
    struct zr_lamp_place place;         /* of a placed lamp */
    const struct zr_shadow_map *shadow; /* of a directional lamp or a spot; NULL: it casts none */
};

struct zr_lights {
    zr_vec3 ambient;
    uint32_t count, placed_count; /* of these */
    const struct zr_lamp *lamps;
    zr_vec3 start;     /* points are counted from the eye, or from the origin of eye space: this is it */
    bool is_per_pixel; /* all shadings are lit when it is known what is seen, from the surfaces' own colours */
};

#endif
