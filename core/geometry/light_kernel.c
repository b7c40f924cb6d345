#include "geometry/light.h"
#include "geometry/vec3_simd.h"

_Static_assert(sizeof(zr_vec4) == 4 * sizeof(float), "loaded and stored as four floats");

static inline struct zr_vec3_v spread(zr_vec3 v)
{
    return (struct zr_vec3_v){zr_vf_set(v.x), zr_vf_set(v.y), zr_vf_set(v.z)};
}

static inline struct zr_vec3_v add(struct zr_vec3_v a, struct zr_vec3_v b)
{
    return (struct zr_vec3_v){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline struct zr_vec3_v mul(struct zr_vec3_v a, struct zr_vec3_v b)
{
    return (struct zr_vec3_v){a.x * b.x, a.y * b.y, a.z * b.z};
}

static inline zr_vf clamp01(zr_vf v)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f);
    return zr_vf_select(zr_vf_lt(v, zero), zero, zr_vf_select(zr_vf_lt(v, one), v, one));
}

static inline void store(struct zr_vec3_v color, zr_vf alpha, zr_vec4 *out)
{
    zr_vf_store_fours((float *)out, clamp01(color.x), clamp01(color.y), clamp01(color.z), clamp01(alpha));
}

/* ZR_LANES points. */
static inline void light_group(const struct zr_lighting *lighting, const struct zr_normal_matrix *to_eye,
                               const zr_vec4 *normals, const zr_vec4 *bases, zr_vec4 *front_out, zr_vec4 *back_out)
{
    struct zr_vec3_v n, base;
    zr_vf alpha;
    zr_vf_load_fours((const float *)normals, &n.x, &n.y, &n.z, &alpha);
    zr_vf_load_fours((const float *)bases, &base.x, &base.y, &base.z, &alpha);
    n = zr_normalize_v(n); /* first: a tiny face would underflow below */
    n = (struct zr_vec3_v){zr_dot_v(spread(to_eye->rows[0]), n), zr_dot_v(spread(to_eye->rows[1]), n),
                           zr_dot_v(spread(to_eye->rows[2]), n)};
    n = zr_normalize_v(n);
    struct zr_vec3_v front = mul(spread(lighting->ambient), base), back = front;
    for (uint32_t i = 0; i < lighting->count; i++) {
        const zr_vf facing = zr_dot_v(n, spread(lighting->to_light[i]));
        const struct zr_vec3_v diffuse = mul(spread(lighting->colors[i]), base);
        const zr_vm lit = zr_vf_lt(zr_vf_set(0.0f), facing);
        front = zr_choose_v(lit, add(front, zr_scale_v(diffuse, facing)), front);
        back = zr_choose_v(lit, back, add(back, zr_scale_v(diffuse, facing * zr_vf_set(-1.0f))));
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
