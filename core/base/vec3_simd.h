/* vec3_simd.h - base: vectors or colours, one per lane; for kernels. */
#ifndef ZR_VEC3_SIMD_H
#define ZR_VEC3_SIMD_H

#include "base/simd/simd.h"
#include "base/vec.h"

struct zr_vec3_v {
    zr_vf x, y, z;
};

static inline struct zr_vec3_v zr_spread_v(zr_vec3 v)
{
    return (struct zr_vec3_v){zr_vf_set(v.x), zr_vf_set(v.y), zr_vf_set(v.z)};
}

static inline struct zr_vec3_v zr_add_v(struct zr_vec3_v a, struct zr_vec3_v b)
{
    return (struct zr_vec3_v){a.x + b.x, a.y + b.y, a.z + b.z};
}

/* Products of components. */
static inline struct zr_vec3_v zr_mul_v(struct zr_vec3_v a, struct zr_vec3_v b)
{
    return (struct zr_vec3_v){a.x * b.x, a.y * b.y, a.z * b.z};
}

static inline struct zr_vec3_v zr_minus_v(struct zr_vec3_v a, struct zr_vec3_v b)
{
    return (struct zr_vec3_v){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline struct zr_vec3_v zr_scale_v(struct zr_vec3_v a, zr_vf s)
{
    return (struct zr_vec3_v){a.x * s, a.y * s, a.z * s};
}

static inline struct zr_vec3_v zr_choose_v(zr_vm where, struct zr_vec3_v a, struct zr_vec3_v b)
{
    return (struct zr_vec3_v){zr_vf_select(where, a.x, b.x), zr_vf_select(where, a.y, b.y),
                              zr_vf_select(where, a.z, b.z)};
}

/* zr_vec3_cross of each lane. */
static inline struct zr_vec3_v zr_cross_v(struct zr_vec3_v a, struct zr_vec3_v b)
{
    return (struct zr_vec3_v){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* zr_vec3_dot of each lane. */
static inline zr_vf zr_dot_v(struct zr_vec3_v a, struct zr_vec3_v b)
{
    return (a.z * b.z + a.y * b.y) + a.x * b.x;
}

static inline struct zr_vec3_v zr_to_unit_v(struct zr_vec3_v v, zr_vf square)
{
    return zr_scale_v(v, zr_vf_set(1.0f) / zr_vf_sqrt(square));
}

/* zr_vec3_normalize of each lane. */
static inline struct zr_vec3_v zr_normalize_v(struct zr_vec3_v v)
{
    const zr_vf square = zr_dot_v(v, v);
    const zr_vm plain = zr_vm_and(zr_vf_lt(zr_vf_set(1e-30f), square), zr_vf_lt(square, zr_vf_set(1e30f)));
    const struct zr_vec3_v unit = zr_to_unit_v(v, square);
    if (__builtin_expect(zr_vm_bits(plain) == ZR_ALL_BITS, 1)) return unit;
    const zr_vf largest = zr_vf_max(zr_vf_max(zr_vf_abs(v.x), zr_vf_abs(v.y)), zr_vf_abs(v.z));
    const zr_vm finite = zr_vm_and(zr_vf_lt(zr_vf_set(0.0f), largest), zr_vf_lt(largest, zr_vf_set(__builtin_inff())));
    const struct zr_vec3_v near_1 = {v.x / largest, v.y / largest, v.z / largest};
    return zr_choose_v(plain, unit, zr_choose_v(finite, zr_to_unit_v(near_1, zr_dot_v(near_1, near_1)), v));
}

#endif
