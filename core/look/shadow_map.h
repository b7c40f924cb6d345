/* shadow_map.h - look: what a directional lamp reaches, from a depth map along its light.
 *
 * How:    mean of the 37 texels with dx^2 + dy^2 <= 12 around the place, with a bias of 0.004 D along
 *         the face normal and the ray.
 */
#ifndef ZR_SHADOW_MAP_H
#define ZR_SHADOW_MAP_H

#include "base/vec.h"

enum { ZR_SHADOW_SIDE = 1024, ZR_SHADOW_BORDER = 4 };

/* A point p of the G-buffer has map coordinates u = u_axis . p + u_offset in texels, v likewise, and depth
 * d = depth_axis . p + depth_offset along the light, in scene units. Texel x, y is at [(y + ZR_SHADOW_BORDER) * stride
 * + x + ZR_SHADOW_BORDER] and has its centre at (x + 1/2, y + 1/2); there is a border of that many texels around, in
 * which nothing is: INFINITY. */
struct zr_shadow_map {
    const float *depths;
    int32_t stride;
    zr_vec3 u_axis, v_axis, depth_axis;
    float u_offset, v_offset, depth_offset;
    float bias; /* scene units */
};

#endif
