#include "geometry/mat4_simd.h"
#include "shade/eye_values_simd.h"

/* A vertex per lane: position, and the result of the matrix. */
struct vertices_v {
    struct zr_vec3_v position, p;
    zr_vf position_w, p_w;
};

static inline struct vertices_v load(const zr_vec4 *positions, const struct zr_mat4_v *m,
                                     const int32_t numbers[ZR_LANES])
{
    struct vertices_v out;
    zr_vf x, y, z, w;
#define POSITION(i) (&positions[numbers[i]].x)
    ZR_LOAD4(x, y, z, w, POSITION);
#undef POSITION
    out.position = (struct zr_vec3_v){x, y, z};
    out.position_w = w;
    out.p = (struct zr_vec3_v){zr_mat4_row_v(m, 0, x, y, z, w), zr_mat4_row_v(m, 1, x, y, z, w),
                               zr_mat4_row_v(m, 2, x, y, z, w)};
    out.p_w = zr_mat4_row_v(m, 3, x, y, z, w);
    return out;
}

/* zr_eye_vector_depth of each lane. */
static inline zr_vf depth_of(const struct zr_mat4_v *m, const struct vertices_v *v)
{
    const zr_vf from_last =
        ((m->m[14] * v->position_w + m->m[10] * v->position.z) + m->m[6] * v->position.y) + m->m[2] * v->position.x;
    const zr_vf right = ZR_MUTANT(older_mesa, v->p.z, from_last), wrong = ZR_MUTANT(older_mesa, from_last, v->p.z);
    const zr_vf z = ZR_MUTANT(fog_z_other_way, right, wrong);
    return zr_vf_abs(zr_vf_select(zr_vf_eq(v->p_w, zr_vf_set(0.0f)), z, z / v->p_w));
}

void ZR_KERNEL(zr_eye_vectors_at)(const struct zr_eye_vectors *of, uint32_t first, const int32_t (*vertices)[ZR_LANES],
                                  bool has_depth, struct zr_eye_values *out)
{
    const struct zr_mat4_v m = zr_spread_mat4_v(&of->to_eye);
    const struct zr_vec3_v eye = zr_spread_v((zr_vec3){of->eye.x, of->eye.y, of->eye.z});
    for (int k = 0; k < 3; k++) {
        const zr_vi numbers = zr_vi_load(vertices[k]) - zr_vi_set((int32_t)first);
        int32_t own[ZR_LANES];
        const uint32_t others = zr_own_numbers(numbers, of->count, own);
        const struct vertices_v v = load(of->positions, &m, own);
        struct zr_vec3_v vector = v.p;
        if (of->eye.w != 0.0f) vector = zr_minus_v(v.p, zr_scale_v(eye, v.p_w));
        zr_vf_store(out->at[k][0], vector.x);
        zr_vf_store(out->at[k][1], vector.y);
        zr_vf_store(out->at[k][2], vector.z);
        if (has_depth) zr_vf_store(out->at[k][3], depth_of(&m, &v));
        if (others) zr_put_cut_values(of->cut, others, numbers, of->count, out->at[k]);
    }
}
