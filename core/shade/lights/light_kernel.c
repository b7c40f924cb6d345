#include "base/mutant.h"
#include "base/vec3_simd.h"
#include "shade/lights/lamp_place_simd.h"
#include "shade/lights/unit_normal_simd.h"

_Static_assert(sizeof(zr_vec4) == 4 * sizeof(float), "loaded and stored as four floats");

static inline zr_vf clamp01(zr_vf v)
{
    const zr_vf zero = zr_vf_set(0.0f), one = zr_vf_set(1.0f);
    const zr_vf clamped = zr_vf_select(zr_vf_lt(v, zero), zero, zr_vf_select(zr_vf_lt(v, one), v, one));
    return ZR_MUTANT(lit_beyond_1, clamped, v);
}

static inline void store(struct zr_vec3_v color, zr_vf alpha, zr_vec4 *out)
{
    zr_vf_store_fours((float *)out, clamp01(color.x), clamp01(color.y), clamp01(color.z), clamp01(alpha));
}

/* Returns the unit normals of ZR_LANES points, in eye space. */
static inline struct zr_vec3_v unit_normals(const struct zr_normal_matrix *to_eye, const zr_vec4 *normals)
{
    struct zr_vec3_v n;
    zr_vf w;
    zr_vf_load_fours((const float *)normals, &n.x, &n.y, &n.z, &w);
    (void)w;
    return zr_unit_normal_v(to_eye, n);
}

/* Lights ZR_LANES points. `placed`, a constant: lamps may have a position; else `points` may be NULL. */
static inline __attribute__((always_inline)) void light_group(const struct zr_lights *lights, bool placed,
                                                              struct zr_vec3_v n, const zr_vec4 *points,
                                                              const zr_vec4 *bases, zr_vec4 *front_out,
                                                              zr_vec4 *back_out)
{
    struct zr_vec3_v base, point = n;
    zr_vf alpha, w;
    zr_vf_load_fours((const float *)bases, &base.x, &base.y, &base.z, &alpha);
    if (placed) zr_vf_load_fours((const float *)points, &point.x, &point.y, &point.z, &w);
    struct zr_vec3_v front = zr_mul_v(zr_spread_v(lights->ambient), base), back = front;
    for (uint32_t i = 0; i < lights->count; i++) {
        const struct zr_lamp *lamp = &lights->lamps[i];
        const struct zr_arriving_v arriving = zr_arriving_v(lamp, point, placed);
        const zr_vf facing = zr_dot_v(n, arriving.to_light), away = facing * zr_vf_set(-1.0f);
        const struct zr_vec3_v diffuse = zr_mul_v(zr_spread_v(lamp->color), base);
        const zr_vm lit = zr_vf_lt(zr_vf_set(0.0f), facing);
        const struct zr_vec3_v lit_front = zr_add_v(front, zr_scale_v(diffuse, facing * arriving.share));
        front = zr_choose_v(ZR_MUTANT(lit_from_behind, lit, ZR_ALL_LANES), lit_front, front);
        back = zr_choose_v(lit, back, zr_add_v(back, zr_scale_v(diffuse, away * arriving.share)));
    }
    if (back_out != front_out) store(back, alpha, back_out);
    store(front, alpha, front_out);
}

/* Groups of ZR_LANES points. The normals of all are computed before any is lit, so that other work hides the latency of
 * square roots and divisions: two fifths of the time of lighting. */
enum { GROUPS = 8 };

static inline void light_groups(const struct zr_lights *lights, const struct zr_normal_matrix *to_eye,
                                const zr_vec4 *normals, const zr_vec4 *bases, size_t groups, zr_vec4 *front,
                                zr_vec4 *back)
{
    struct zr_vec3_v units[GROUPS];
    for (size_t g = 0; g < groups; g++)
        units[g] = unit_normals(to_eye, normals + g * ZR_LANES);
    for (size_t g = 0; g < groups; g++)
        light_group(lights, false, units[g], NULL, bases + g * ZR_LANES, front + g * ZR_LANES, back + g * ZR_LANES);
}

void ZR_KERNEL(zr_light)(const struct zr_lights *lights, const struct zr_normal_matrix *to_eye, const zr_vec4 *normals,
                         const zr_vec4 *bases, size_t count, zr_vec4 *front, zr_vec4 *back)
{
    size_t i = 0;
    for (size_t groups; (groups = (count - i) / ZR_LANES) > 0; i += groups * ZR_LANES) {
        if (groups > GROUPS) groups = GROUPS;
        light_groups(lights, to_eye, normals + i, bases + i, groups, front + i, back + i);
    }
    if (i == count) return;
    /* The incomplete last group. */
    zr_vec4 last_normals[ZR_LANES] = {{0, 0, 0, 0}}, last_bases[ZR_LANES] = {{0, 0, 0, 0}};
    zr_vec4 fronts[ZR_LANES], backs[ZR_LANES];
    const size_t left = (count - i) * sizeof *front;
    memcpy(last_normals, normals + i, left);
    memcpy(last_bases, bases + i, left);
    light_groups(lights, to_eye, last_normals, last_bases, 1, fronts, backs);
    memcpy(back + i, backs, left);
    memcpy(front + i, fronts, left); /* last: both may be one array */
}

/* ---- lights with a position ---- */

void ZR_KERNEL(zr_light_placed)(const struct zr_lights *lights, const struct zr_normal_matrix *to_eye,
                                const zr_vec4 *normals, const zr_vec4 *points, const zr_vec4 *bases, size_t count,
                                zr_vec4 *front, zr_vec4 *back)
{
    for (size_t i = 0; i < count; i += ZR_LANES) {
        zr_vec4 in[3][ZR_LANES] = {{{0, 0, 0, 0}}}, fronts[ZR_LANES], backs[ZR_LANES];
        const size_t left = (count - i < ZR_LANES ? count - i : ZR_LANES) * sizeof *front;
        memcpy(in[0], normals + i, left);
        memcpy(in[1], points + i, left);
        memcpy(in[2], bases + i, left);
        light_group(lights, true, unit_normals(to_eye, in[0]), in[1], in[2], fronts, backs);
        memcpy(back + i, backs, left);
        memcpy(front + i, fronts, left); /* last: both may be one array */
    }
}

void ZR_KERNEL(zr_to_eye)(const struct zr_normal_matrix *to_eye, zr_vec4 *normals, size_t count)
{
    for (size_t i = 0; i < count; i += ZR_LANES) {
        zr_vec4 some[ZR_LANES] = {{0, 0, 0, 0}};
        const size_t left = (count - i < ZR_LANES ? count - i : ZR_LANES) * sizeof *normals;
        memcpy(some, normals + i, left);
        const struct zr_vec3_v unit = unit_normals(to_eye, some);
        zr_vf_store_fours((float *)some, unit.x, unit.y, unit.z, zr_vf_set(0.0f));
        memcpy(normals + i, some, left);
    }
}
