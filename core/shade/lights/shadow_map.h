/* shadow_map.h - shade: what a lamp reaches, from a depth map along its light.
 *
 * How:    mean of the 37 texels with dx^2 + dy^2 <= 12 around the place, with a bias along the face normal and the ray:
 *         of a directional lamp 0.004 D, and of a spot so much as four texels are wide at that distance.
 * Why:    a plane shadows nothing of itself, at whatever angle light comes, where the bias is no less than the way
 *         to the farthest of those texels.
 */
#ifndef ZR_SHADOW_MAP_H
#define ZR_SHADOW_MAP_H

#include "base/vec.h"

enum { ZR_SHADOW_SIDE = 1024, ZR_SHADOW_BORDER = 4 };

/* Of the diagonal of the bounds, for directional lamps; and for spots in texels. */
#define ZR_SHADOW_BIAS        0.004f
#define ZR_SHADOW_BIAS_TEXELS 4.2f

/* A point p of the G-buffer has map coordinates u = u_axis . p + u_offset in texels, v likewise, and depth
 * d = depth_axis . p + depth_offset along the light, in scene units. Texel x, y is at [(y + ZR_SHADOW_BORDER) * stride
 * + x + ZR_SHADOW_BORDER] and has its centre at (x + 1/2, y + 1/2); there is a border of that many texels around, in
 * which nothing is: INFINITY. */
struct zr_shadow_map {
    const float *depths;
    int32_t stride;
    zr_vec3 u_axis, v_axis, depth_axis;
    float u_offset, v_offset, depth_offset;
    float bias;      /* scene units; of a spot, whose rows for u and v give these times the depth: for each of depth */
    float eye_scale; /* a scene unit in eye space, in which points are moved along normals */
};

#endif
