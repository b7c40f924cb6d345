/* environment.h - shade: ambient light as formulas: a gradient, soft boxes and round lobes.
 *
 * Space:  the environment's own: y up, z towards the camera.
 * How:    radiance L gathered around direction d at GGX roughness alpha, with b^2 = (2 alpha / (1 + 2.2 alpha))^2:
 *
 *             S(x, w)  = 1/2 + 1/2 x / sqrt(x^2 + w^2)          a step, blurred as GGX blurs it
 *             gradient = mix(ground, sky, S(d.y, sqrt(hw^2 + b^2)))
 *             box      = c (S(u + a, w) - S(u - a, w)) (S(v + h, w) - S(v - h, w)) S(d.m, w),  w^2 = w0^2 + b^2
 *             lobe     = c (w0^2 / w^2) / (1 + 2 (1 - d.m) / w^2)^2
 *             L        = mix(gradient + boxes + lobes, E(d), clamp((alpha - 0.2) / 0.6))
 *
 *         u and v are d along the box's two sides. E is irradiance / pi, a polynomial of harmonics of order 2.
 * Image:  L is the light of two levels of the image's map (scene/environment_map.h), mixed by roughness.
 * Near:   an environment may stand at a finite distance, so that planes get a gradient: at a point P, directions R of L
 *         and N of E become normalize(R + k q) and normalize(N + k q / 2) with q = (P - M) / (D / 2), where M is the
 *         middle of the scene's bounds, D their diagonal, and k the nearness.
 */
#ifndef ZR_ENVIRONMENT_H
#define ZR_ENVIRONMENT_H

#include "base/vec.h"
#include "scene/effects.h"
#include "scene/environment_map.h"

enum { ZR_ENVIRONMENT_BOXES = 6, ZR_ENVIRONMENT_LOBES = 2, ZR_HARMONICS = 9 };

struct zr_environment_box {
    zr_vec3 middle;        /* m; zr_environment_make makes it a unit vector */
    zr_vec3 across, along; /* directions of the sides */
    float a, h, w0;
    zr_vec3 color;
};

/* Costs about a sixth of a box, so boxes that look round are lobes. */
struct zr_environment_lobe {
    zr_vec3 middle; /* m; zr_environment_make makes it a unit vector */
    float w0;
    zr_vec3 color;
};

struct zr_environment_light {
    zr_vec3 sky, ground;
    float half_width; /* hw, of the horizon */
    uint32_t box_count;
    struct zr_environment_box boxes[ZR_ENVIRONMENT_BOXES];
    uint32_t lobe_count;
    struct zr_environment_lobe lobes[ZR_ENVIRONMENT_LOBES];
    float nearness;                  /* k; 0: infinitely far away */
    zr_vec3 harmonics[ZR_HARMONICS]; /* factors of 1, x, y, z, xy, yz, zx, 3z^2 - 1, x^2 - y^2 */
    const float *map;                /* texels of an environment image, which replace all but the harmonics; or NULL */
};

/* Makes an environment's light. Returns false for ZR_ENVIRONMENT_NONE. */
bool zr_environment_make(enum zr_environment_name name, struct zr_environment_light *out);

/* Makes the light of an image. */
struct zr_environment_light zr_environment_of_map(const struct zr_environment_map *map);

#endif
