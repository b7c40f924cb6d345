/* ground.h - effects: the soft shadow of a scene on the plane under it.
 *
 * Space:  ground space: x and y on the plane, z the height over it, all in scene units (struct zr_ground_frame).
 * In:     an orthographic map of the scene seen from below: the height of the lowest surface over the plane. Out: the
 *         share of light T that reaches each place of the plane.
 * How:    T = (1 - 0.55 near) * (1 - 0.45 far), where near and far are clamp(1 - height / H), blurred by three passes
 * of a box of half width q: H and q are 0.06 D and 0.02 D, and 0.35 D and 0.07 D; D is the diagonal of the scene's
 *         bounds.
 */
#ifndef ZR_GROUND_H
#define ZR_GROUND_H

#include "base/arena.h"
#include "base/isa.h"
#include "base/team.h"
#include "scene/rays.h"

enum { ZR_GROUND_SIDE = 192 };

/* T over the plane: `light` has ZR_GROUND_SIDE squared values, row by row; texel x, y has its centre at
 * ((x + 1/2) / ZR_GROUND_SIDE * 2 - 1) * half_size from the middle. Outside of it T is 1. */
struct zr_ground {
    float half_size;
    const float *light;
};

/* `heights` as the map has it, INFINITY where nothing is above; under the plane is as good as on it. NULL light where
 * the arena has failed. Every team gives the same bytes. */
struct zr_ground zr_ground_make(struct zr_arena *arena, struct zr_team *team, const float *heights, float half_size,
                                float diagonal);

/* T at a place of the plane, bilinear between texels' centres; what is outside of the map counts as texels of 1, so
 * that T has no step at its border. */
float zr_ground_at(const struct zr_ground *ground, float x, float y);

/* ---- T of pixels. Space: eye space ---- */

/* Where the plane is. */
struct zr_ground_frame {
    zr_vec3 origin;                 /* the middle of the map */
    zr_vec3 x_axis, y_axis, z_axis; /* unit, or as long as 1 over the scale of eye space, by which the
                                       map's units are; z the plane's normal, up */
};

/* T where the rays through the centres of a row's first `width` pixels meet the plane, from above or from below; 1
 * where they do not, or behind their start. A kernel. */
typedef void zr_ground_row_fn(const struct zr_ground *ground, const struct zr_ground_frame *frame,
                              const struct zr_rays *rays, int32_t y, int32_t width, float *out);

zr_ground_row_fn zr_ground_row_scalar, zr_ground_row_sse2, zr_ground_row_avx2, zr_ground_row_avx512, zr_ground_row_neon;

zr_ground_row_fn *zr_ground_row_of(enum zr_isa isa);

#endif
