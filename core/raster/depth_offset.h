/* depth_offset.h - raster: computes the glPolygonOffset of a filled triangle.
 *
 * Space:  window space; depth 0..1 in a float buffer.
 * Why:    outlines drawn on a face would z-fight with it; the face is moved back by a multiple of its slope.
 * Use:    z = clamp(zr_plane_at(depth, X, Y) + offset): added to each pixel's depth after interpolation and before
 *         clamping. Not added to the plane's a0, which rounds differently. Lines and outlines are not moved. Each piece
 *         of a clipped triangle has its own offset.
 * Exact:  llvmpipe's offset for a float depth buffer (the reference's rule 15). */
#ifndef ZR_DEPTH_OFFSET_H
#define ZR_DEPTH_OFFSET_H

#include <string.h>

#include "geometry/viewport.h"

/* Returns the smallest step of a float near z: 2^(exponent of z - 23), or 0 below 2^-103. */
static inline float zr_depth_offset_step(float z)
{
    int32_t bits, exponent = 0x7f800000, shift = 23 << 23;
    memcpy(&bits, &z, sizeof bits);
    bits = (bits & exponent) - shift;
    if (bits < 0) bits = 0;
    float step;
    memcpy(&step, &bits, sizeof step);
    return step;
}

/* Returns max(|dz/dx|, |dz/dy|) * factor + units * the step at the farthest vertex, for vertices in the order of struct
 * zr_triangle. The slopes are those of zr_plane_make except for rounding: here the area divides last. */
static inline float zr_depth_offset(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1,
                                    const struct zr_window_vertex *v2, float factor, float units)
{
    float dx01 = v0->x - v1->x, dy01 = v0->y - v1->y, dz01 = v0->z - v1->z;
    float dx20 = v2->x - v0->x, dy20 = v2->y - v0->y, dz20 = v2->z - v0->z;
    float ooa = 1.0f / (dx01 * dy20 - dy01 * dx20);
    float dzdx = fabsf((dz20 * dy01 - dy20 * dz01) * ooa);
    float dzdy = fabsf((dx20 * dz01 - dz20 * dx01) * ooa);
    float z = fabsf(v0->z), z1 = fabsf(v1->z), z2 = fabsf(v2->z);
    z = z > z1 ? z : z1;
    z = z > z2 ? z : z2;
    float slope = dzdx > dzdy ? dzdx : dzdy;
    return zr_depth_offset_step(z) * units + slope * factor;
}

#endif
