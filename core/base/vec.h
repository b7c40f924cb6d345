/* vec.h - base: small vectors and matrices, passed by value.
 *
 * Sums are evaluated in the order written. Each function states its order, since the reference's order (llvmpipe)
 * affects the last bit of every pixel. */
#ifndef ZR_VEC_H
#define ZR_VEC_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/mutant.h"

/* Identical bytes on every machine require float32 arithmetic as written. */
_Static_assert(FLT_EVAL_METHOD == 0, "floats are evaluated as floats: on x86 that takes SSE");
#ifdef __FAST_MATH__
#error "zraster's pixels are exact: it cannot be built with -ffast-math or -Ofast"
#endif

typedef struct {
    float x, y, z;
} zr_vec3;
typedef struct {
    float x, y, z, w;
} zr_vec4;

/* Column-major like OpenGL and glTF: m[column * 4 + row]. */
typedef struct {
    float m[16];
} zr_mat4;

static inline zr_vec3 zr_vec3_add(zr_vec3 a, zr_vec3 b)
{
    return (zr_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline zr_vec3 zr_vec3_sub(zr_vec3 a, zr_vec3 b)
{
    return (zr_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline zr_vec3 zr_vec3_scale(zr_vec3 a, float s)
{
    return (zr_vec3){a.x * s, a.y * s, a.z * s};
}

/* Sums in the order of Mesa's GL lighting: from z down to x. */
static inline float zr_vec3_dot(zr_vec3 a, zr_vec3 b)
{
    return (a.z * b.z + a.y * b.y) + a.x * b.x;
}

static inline zr_vec3 zr_vec3_cross(zr_vec3 a, zr_vec3 b)
{
    return (zr_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* Returns v * (1 / sqrt(v.v)), like Mesa; the zero vector stays zero. If the square leaves the range of float, v is
 * first scaled to a length near 1. */
static inline zr_vec3 zr_vec3_normalize(zr_vec3 v)
{
    float dot = zr_vec3_dot(v, v);
    if (!(dot > 1e-30f && dot < 1e30f)) {
        float x = fabsf(v.x), y = fabsf(v.y), z = fabsf(v.z), largest = x > y ? x : y;
        largest = largest > z ? largest : z;
        if (!(largest > 0.0f) || !isfinite(largest)) return v;
        v = (zr_vec3){v.x / largest, v.y / largest, v.z / largest};
        dot = zr_vec3_dot(v, v);
    }
    return zr_vec3_scale(v, 1.0f / sqrtf(dot));
}

/* Four floats for one vector instruction; compilers do not vectorize the members of a zr_vec4 by themselves. */
typedef float zr_four __attribute__((vector_size(16)));

static inline zr_four zr_four_load(const void *at)
{
    zr_four v;
    memcpy(&v, at, sizeof v);
    return v;
}

static inline void zr_four_store(void *at, zr_four v)
{
    memcpy(at, &v, sizeof v);
}

static inline zr_vec4 zr_vec4_mul(zr_vec4 a, zr_vec4 b)
{
    return (zr_vec4){a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w};
}

/* Returns the position of a homogeneous point; at infinity (w = 0), its direction. */
static inline zr_vec3 zr_vec4_over_w(zr_vec4 p)
{
    if (p.w == 1.0f || p.w == 0.0f) return (zr_vec3){p.x, p.y, p.z};
    return (zr_vec3){p.x / p.w, p.y / p.w, p.z / p.w};
}

static inline bool zr_vec4_equal(zr_vec4 a, zr_vec4 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
}

static inline zr_mat4 zr_mat4_identity(void)
{
    return (zr_mat4){{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
}

/* Returns a·b, each sum from left to right (tests/reference/RULES.md, rule 1). */
static inline zr_mat4 zr_mat4_mul(const zr_mat4 *a, const zr_mat4 *b)
{
    zr_mat4 out;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            const float *c = &b->m[column * 4];
            out.m[column * 4 + row] = ((a->m[row] * c[0] + ZR_MUTANT(product_less_a_term, a->m[4 + row], 0.0f) * c[1]) +
                                       a->m[8 + row] * c[2]) +
                                      a->m[12 + row] * c[3];
        }
    return out;
}

/* Returns one row of m·v: ((x·m0 + y·m1) + z·m2) + w·m3 (tests/reference/RULES.md, rule 1). */
static inline float zr_mat4_row(const zr_mat4 *m, int row, zr_vec4 v)
{
    const float x = v.x * m->m[row], y = v.y * m->m[4 + row], z = v.z * m->m[8 + row], w = v.w * m->m[12 + row];
    return ZR_MUTANT(sums_from_the_right, ((x + y) + z) + w, x + (y + (z + w)));
}

static inline zr_vec4 zr_mat4_apply(const zr_mat4 *m, zr_vec4 v)
{
    return (zr_vec4){zr_mat4_row(m, 0, v), zr_mat4_row(m, 1, v), zr_mat4_row(m, 2, v), zr_mat4_row(m, 3, v)};
}

/* Transforms a direction, without the matrix's translation. */
static inline zr_vec3 zr_mat4_direction(const zr_mat4 *m, zr_vec3 d)
{
    const zr_vec4 out = zr_mat4_apply(m, (zr_vec4){d.x, d.y, d.z, 0.0f});
    return (zr_vec3){out.x, out.y, out.z};
}

/* Returns true if every entry is a number of at most `limit` in magnitude. */
static inline bool zr_mat4_is_within(const zr_mat4 *m, float limit)
{
    for (int i = 0; i < 16; i++)
        if (!(fabsf(m->m[i]) <= limit)) return false;
    return true;
}

/* Returns true if the upper 3x3 is a reflection: its determinant, in double, is negative. */
bool zr_mat4_is_mirror(const zr_mat4 *m);

/* Inverts by cofactors in double. Returns false if the determinant is zero or not finite. Reproducible: only additions
 * and products in a fixed order. */
bool zr_mat4_invert(const zr_mat4 *m, zr_mat4 *out);

/* Rounds to a float. gcc 12 drops both conversions of (double)(float)v where it makes a vector of several. It keeps those
 * through memory. */
static inline double zr_rounded(double v)
{
    volatile float rounded = (float)v;
    return (double)rounded;
}

#endif
