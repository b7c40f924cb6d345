/* model.h - shade: how a surface is shaded from what varies over it, ZR_LANES pixels at once; for kernels.
 *
 * Space:  eye space; the normal is that of the side that is seen, of any length.
 * A model is a file in models/, a value of enum zr_shading and a line in zr_model_color (models_simd.h).
 */
#ifndef ZR_MODEL_H
#define ZR_MODEL_H

#include "shade/light.h"
#include "shade/vec3_simd.h"

/* What is the same for the whole picture. */
struct zr_model_context {
    const struct zr_lighting *lighting;
    bool is_parallel; /* all rays of sight are: */
    zr_vec3 to_eye;   /* a unit vector */
};

/* What varies: the surface's own colour, its normal, and the way from the eye to the point that is seen, of any length.
 */
struct zr_model_inputs {
    struct zr_vec3_v color, normal, point;
};

static inline struct zr_vec3_v zr_spread_v(zr_vec3 v)
{
    return (struct zr_vec3_v){zr_vf_set(v.x), zr_vf_set(v.y), zr_vf_set(v.z)};
}

#endif
