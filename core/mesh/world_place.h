/* world_place.h - mesh: points of world space in double precision. */
#ifndef ZR_WORLD_PLACE_H
#define ZR_WORLD_PLACE_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "base/vec.h"

struct zr_world_place {
    double x, y, z;
};

/* Transforms a position to world space. False if it is infinite there, or beyond the range of float. */
static inline bool zr_world_place_of(const zr_mat4 *m, zr_vec4 p, struct zr_world_place *out)
{
    const double x = (double)p.x, y = (double)p.y, z = (double)p.z, w = (double)p.w;
    double at[4];
    for (int row = 0; row < 4; row++)
        at[row] = (((double)m->m[row] * x + (double)m->m[4 + row] * y) + (double)m->m[8 + row] * z) +
                  (double)m->m[12 + row] * w;
    if (at[3] != 1.0)
        for (int k = 0; k < 3; k++)
            at[k] /= at[3];
    *out = (struct zr_world_place){at[0], at[1], at[2]};
    return at[3] != 0.0 && fabs(at[0]) <= (double)FLT_MAX && fabs(at[1]) <= (double)FLT_MAX &&
           fabs(at[2]) <= (double)FLT_MAX;
}

static inline struct zr_world_place zr_world_place_minus(struct zr_world_place a, struct zr_world_place b)
{
    return (struct zr_world_place){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline struct zr_world_place zr_world_place_cross(struct zr_world_place a, struct zr_world_place b)
{
    return (struct zr_world_place){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline double zr_world_place_dot(struct zr_world_place a, struct zr_world_place b)
{
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

/* As fmin and fmax for numbers, without a call. */
static inline double zr_least_of(double a, double b)
{
    return a < b ? a : b;
}

static inline double zr_most_of(double a, double b)
{
    return a > b ? a : b;
}

#endif
