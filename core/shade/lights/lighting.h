/* lighting.h - shade: G-buffer -> colours of samples, in linear light, tone mapped, 0..1. A kernel.
 *
 * Space:  eye space. E is irradiance / pi: a white diffuse surface under E = 1 is 1.
 * Models: pbr_simd.h, classic_simd.h. Unlit surfaces, lines and normals as colours are as they are.
 */
#ifndef ZR_LOOK_LIGHTING_H
#define ZR_LOOK_LIGHTING_H

#include "base/isa.h"
#include "scene/scene.h"
#include "shade/gbuffer.h"
#include "shade/lights/environment.h"
#include "shade/lights/lamp.h"

/* What is the same for the whole picture. */
struct zr_linear_lighting {
    const struct zr_material *materials;
    struct zr_lights lights; /* colours are E; placed lamps come last */
    bool has_environment;
    struct zr_environment_light environment;
    float environment_intensity;
    zr_vec3 eye_to_environment[3]; /* rows */
    bool is_parallel;              /* all rays of sight are: */
    zr_vec3 to_eye;                /* a unit vector */
    enum zr_tone tone;
    float exposure;
};

/* Colours of all samples to out[0..2], at the same places; up to 15 more behind each row's end may be looked at, and
 * written. `occlusion`: one a sample, likewise, or NULL. Where nobody is seen: 0. */
typedef void zr_look_light_fn(const struct zr_linear_lighting *lighting, const struct zr_gbuffer *samples,
                              const float *occlusion, float *const out[3]);

ZR_KERNEL_TABLE(zr_look_light_fn, zr_look_light)

/* What those call where there are lamps that have a place. */
ZR_KERNEL_TABLE(zr_look_light_fn, zr_look_light_placed)

#endif
