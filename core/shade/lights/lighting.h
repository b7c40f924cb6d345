/* lighting.h - shade: lights a G-buffer: colours of samples in linear light, tone mapped, 0..1. A kernel.
 *
 * Space:  eye space. E is irradiance / pi: a white diffuse surface under E = 1 is 1.
 * Models: pbr_simd.h, classic_simd.h. Unlit surfaces, lines and normals as colours stay unlit.
 */
#ifndef ZR_LIGHTING_H
#define ZR_LIGHTING_H

#include "base/isa.h"
#include "scene/scene.h"
#include "shade/lights/backdrop.h"
#include "shade/lights/environment.h"
#include "shade/lights/gbuffer.h"
#include "shade/lights/lamp.h"

/* Values that are constant over the picture. */
struct zr_linear_lighting {
    const struct zr_material *materials;
    struct zr_lights lights; /* colours are E; lamps with a position come last */
    bool has_environment;
    struct zr_environment_light environment;
    float environment_intensity;
    zr_vec3 eye_to_environment[3]; /* rows */
    zr_vec3 middle;                /* M of environment.h, as points of the G-buffer */
    float nearness;                /* 2 k / D, in their units; 0: directions stay as they are */
    bool is_parallel;              /* view rays are parallel */
    zr_vec3 to_eye;                /* unit vector to the eye, if they are */
    enum zr_tone tone;
    float exposure;
    struct zr_gooch gooch;
    const struct zr_backdrop *backdrop; /* of glass; NULL: no glass has a volume or is rough */
};

/* Writes the colours of all samples to out[0..2], laid out like the samples. Up to 15 values beyond each row's end may
 * be read and written. `occlusion`: one per sample, likewise, or NULL. Uncovered samples get 0. */
typedef void zr_linear_light_fn(const struct zr_linear_lighting *lighting, const struct zr_gbuffer *samples,
                                const float *occlusion, float *const out[3]);

ZR_KERNEL_TABLE(zr_linear_light_fn, zr_linear_light)

/* Kernels that those above call if lamps have positions. */
ZR_KERNEL_TABLE(zr_linear_light_fn, zr_linear_light_placed)

#endif
