/* shadow_map.h - shade: shadows of a lamp, from a depth map along its light.
 *
 * How:    mean over the 37 texels with dx^2 + dy^2 <= 12 around the point, with a bias along the face normal and along
 *         the ray: 0.004 D for a directional lamp, four texel widths at the point's distance for a spot. Along the
 *         normal, it grows to three times as much for surfaces that turn away from a directional lamp. Points that are
 *         behind a texel by less than another bias lose a part of the light.
 * Why:    a plane casts no shadow on itself, at any angle of light, if the bias is at least the distance to the
 *         farthest of those texels.
 */
#ifndef ZR_SHADOW_MAP_H
#define ZR_SHADOW_MAP_H

#include "base/vec.h"

enum { ZR_SHADOW_SIDE = 1024, ZR_SHADOW_BORDER = 4 };

/* Bias of directional lamps, in diagonals of the bounds (D), and of spots, in texels. */
#define ZR_SHADOW_BIAS        0.004f
#define ZR_SHADOW_BIAS_TEXELS 4.2f

/* A point p of the G-buffer has map coordinates u = u_axis . p + u_offset in texels, v likewise, and depth d =
 * depth_axis . p + depth_offset along the light, in scene units. Texel x, y is at [(y + ZR_SHADOW_BORDER) * stride + x
 * + ZR_SHADOW_BORDER]; its centre is at (x + 1/2, y + 1/2). The map has a border of that many empty texels:
 * INFINITY. */
struct zr_shadow_map {
    const float *depths;
    int32_t stride;
    zr_vec3 u_axis, v_axis, depth_axis;
    float u_offset, v_offset, depth_offset;
    float bias;      /* scene units; of a spot, whose rows for u and v give these times the depth: per unit of depth */
    float eye_scale; /* a scene unit in eye space, where points are moved along normals */
};

#endif
