#include "base/simd.h"
#include "geometry/light.h"

_Static_assert(sizeof(zr_vec4) == 4 * sizeof(float), "loaded and stored as four floats");

/* Vectors, or colours, one a lane. */
struct vec3_v {
    zr_vf x, y, z;
};

static inline struct vec3_v spread(zr_vec3 v)
{
    return (struct vec3_v){zr_vf_set(v.x), zr_vf_set(v.y), zr_vf_set(v.z)};
}

static inline struct vec3_v add(struct vec3_v a, struct vec3_v b)
{
    return (struct vec3_v){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline struct vec3_v mul(struct vec3_v a, struct vec3_v b)
{
    return (struct vec3_v){a.x * b.x, a.y * b.y, a.z * b.z};
}

static inline struct vec3_v scale(struct vec3_v a, zr_vf s)
{
    return (struct vec3_v){a.x * s, a.y * s, a.z * s};
}

static inline struct vec3_v choose(zr_vm where, struct vec3_v a, struct vec3_v b)
{
    return (struct vec3_v){zr_vf_select(where, a.x, b.x), zr_vf_select(where, a.y, b.y), zr_vf_select(where, a.z, b.z)};
}

/* As zr_vec3_dot. */
static inline zr_vf dot(struct vec3_v a, struct vec3_v b)
{
    return (a.z * b.z + a.y * b.y) + a.x * b.x;
}

static inline struct vec3_v to_unit(struct vec3_v v, zr_vf square)
{
    return scale(v, zr_vf_set(1.0f) / zr_vf_sqrt(square));
}

/* As zr_vec3_normalize. */
static inline struct vec3_v normalize(struct vec3_v v)
{
    const zr_vf square = dot(v, v);
    const zr_vm plain = zr_vm_and(zr_vf_lt(zr_vf_set(1e-30f), square), zr_vf_lt(square, zr_vf_set(1e30f)));
    const struct vec3_v unit = to_unit(v, square);
    if (__builtin_expect(zr_vm_bits(plain) == ZR_ALL_BITS, 1)) return unit;
    const zr_vf largest = zr_vf_max(zr_vf_max(zr_vf_abs(v.x), zr_vf_abs(v.y)), zr_vf_abs(v.z));
    const zr_vm finite = zr_vm_and(zr_vf_lt(zr_vf_set(0.0f), largest), zr_vf_lt(largest, zr_vf_set(__builtin_inff())));
    const struct vec3_v near_1 = {v.x / largest, v.y / largest, v.z / largest};
    return choose(plain, unit, choose(finite, to_unit(near_1, dot(near_1, near_1)), v));
}

static inline zr_vf clamp01(zr_vf v)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f);
    return zr_vf_select(zr_vf_lt(v, zero), zero, zr_vf_select(zr_vf_lt(v, one), v, one));
}

static inline void store(struct vec3_v color, zr_vf alpha, zr_vec4 *out)
{
    zr_vf_store_fours((float *)out, clamp01(color.x), clamp01(color.y), clamp01(color.z), clamp01(alpha));
}

/* ZR_LANES points. */
static inline void light_group(const struct zr_lighting *lighting, const struct zr_normal_matrix *to_eye,
                               const zr_vec4 *normals, const zr_vec4 *bases, zr_vec4 *front_out, zr_vec4 *back_out)
{
    struct vec3_v n, base;
    zr_vf alpha;
    zr_vf_load_fours((const float *)normals, &n.x, &n.y, &n.z, &alpha);
    zr_vf_load_fours((const float *)bases, &base.x, &base.y, &base.z, &alpha);
    n = normalize(n); /* first: a tiny face would underflow below */
    n = (struct vec3_v){dot(spread(to_eye->rows[0]), n), dot(spread(to_eye->rows[1]), n),
                        dot(spread(to_eye->rows[2]), n)};
    n = normalize(n);
    struct vec3_v front = mul(spread(lighting->ambient), base), back = front;
    for (uint32_t i = 0; i < lighting->count; i++) {
        const zr_vf facing = dot(n, spread(lighting->to_light[i]));
        const struct vec3_v diffuse = mul(spread(lighting->colors[i]), base);
        const zr_vm lit = zr_vf_lt(zr_vf_set(0.0f), facing);
        front = choose(lit, add(front, scale(diffuse, facing)), front);
        back = choose(lit, back, add(back, scale(diffuse, facing * zr_vf_set(-1.0f))));
    }
    if (back_out != front_out) store(back, alpha, back_out);
    store(front, alpha, front_out);
}

void ZR_KERNEL(zr_light)(const struct zr_lighting *lighting, const struct zr_normal_matrix *to_eye,
                         const zr_vec4 *normals, const zr_vec4 *bases, size_t count, zr_vec4 *front, zr_vec4 *back)
{
    size_t i = 0;
    for (; i + ZR_LANES <= count; i += ZR_LANES)
        light_group(lighting, to_eye, normals + i, bases + i, front + i, back + i);
    if (i == count) return;
    /* What is left of a group. */
    zr_vec4 last_normals[ZR_LANES] = {{0, 0, 0, 0}}, last_bases[ZR_LANES] = {{0, 0, 0, 0}};
    zr_vec4 fronts[ZR_LANES], backs[ZR_LANES];
    const size_t left = (count - i) * sizeof *front;
    memcpy(last_normals, normals + i, left);
    memcpy(last_bases, bases + i, left);
    light_group(lighting, to_eye, last_normals, last_bases, fronts, backs);
    memcpy(back + i, backs, left);
    memcpy(front + i, fronts, left); /* last: both may be one array */
}
