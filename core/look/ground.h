/* ground.h - look: the soft shadow of a scene on the plane under it.
 *
 * Space:  ground space: x and y on the plane, z the height over it, a frame of unit length (struct zr_ground_frame).
 * In:     an orthographic map of the scene seen from below: the height of the lowest surface over the plane. Out: the
 *         share of light T that reaches each place of the plane.
 */
#ifndef ZR_GROUND_H
#define ZR_GROUND_H

#include "base/arena.h"
#include "base/team.h"
#include "base/vec.h"

enum { ZR_GROUND_SIDE = 192 };

/* T over the plane: `light` has ZR_GROUND_SIDE squared values, row by row; texel x, y has its centre at
 * ((x + 1/2) / ZR_GROUND_SIDE * 2 - 1) * half_size from the middle. Outside of it T is 1. */
struct zr_ground {
    float half_size;
    const float *light;
};

/* `heights` as the map has it, INFINITY where nothing is above. NULL light where the arena has failed. */
struct zr_ground zr_ground_make(struct zr_arena *arena, struct zr_team *team, const float *heights, float half_size,
                                float diagonal);

/* T at a place of the plane, bilinear between texels' centres; 1 outside. */
float zr_ground_at(const struct zr_ground *ground, float x, float y);

#endif
