/* eye_depth.h - shade: how far a record lies in front of the camera, at each sample.
 *
 * Space:  window space, y up, the sample of pixel X, Y in its middle; depth is eye space's
 *         -z / w, in scene units.
 * Exact:  of a triangle, to the last bit of a float but one: where the sample's ray meets the
 *         plane of the mesh's own triangle, in double, whatever clipping and the window have
 *         made of it. Nothing here has to equal a reference.
 * Source: Olano & Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates", 1997.
 */
#ifndef ZR_EYE_DEPTH_H
#define ZR_EYE_DEPTH_H

#include "geometry/geometry.h"

/* As zr_plane, in double. */
struct zr_eye_plane {
    double a0, dadx, dady;
};

struct zr_eye_depth {
    struct zr_eye_plane depth, one; /* depth and 1, both times the same value that varies over the window */
    double min, max;
};

void zr_eye_depth_make(const struct zr_geometry *geometry, const struct zr_triangle *record, uint32_t width,
                       uint32_t height, struct zr_eye_depth *out);

/* Kept within the depths of the corners: samples are covered on the subpixel grid, so that a ray may miss
 * the triangle by a hair, and the plane of one seen from its edge is then far away. NaN gives the least. */
static inline float zr_eye_depth_at(const struct zr_eye_depth *depth, int32_t x, int32_t y)
{
    const struct zr_eye_plane d = depth->depth, one = depth->one;
    double above = (d.a0 + d.dady * (double)y) + d.dadx * (double)x;
    double below = (one.a0 + one.dady * (double)y) + one.dadx * (double)x, value = above / below;
    value = value > depth->min ? value : depth->min;
    return (float)(value < depth->max ? value : depth->max);
}

#endif
