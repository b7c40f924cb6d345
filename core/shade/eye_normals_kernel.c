#include "mesh/face_normals_simd.h"
#include "shade/eye_values_simd.h"
#include "shade/lights/unit_normal_simd.h"

/* Numbers, one per lane. */
static inline void numbers_at(const uint32_t *array, zr_vi at, int32_t out[ZR_LANES])
{
    zr_vi_store(out, zr_vi_gather(ZR_ALL_LANES, array, at));
}

static inline struct zr_vec3_v values_at(const zr_vec4 *values, const int32_t numbers[ZR_LANES], zr_vf *last)
{
    struct zr_vec3_v out;
#define VALUE(i) (&values[numbers[i]].x)
    ZR_LOAD4(out.x, out.y, out.z, *last, VALUE);
#undef VALUE
    return out;
}

/* Returns the mesh's own normals. */
static inline struct zr_vec3_v own_at(const struct zr_mesh *mesh, zr_vi number)
{
    const zr_vi word = number * zr_vi_set(3), one = zr_vi_set(1);
    return (struct zr_vec3_v){zr_vf_bits(zr_vi_gather(ZR_ALL_LANES, mesh->normals, word)),
                              zr_vf_bits(zr_vi_gather(ZR_ALL_LANES, mesh->normals, word + one)),
                              zr_vf_bits(zr_vi_gather(ZR_ALL_LANES, mesh->normals, word + one + one))};
}

/* zr_normal_is_zero of each lane. */
static inline zr_vm is_zero(struct zr_vec3_v n)
{
    const zr_vf zero = zr_vf_set(0.0f);
    return zr_vm_and(zr_vm_and(zr_vf_eq(n.x, zero), zr_vf_eq(n.y, zero)), zr_vf_eq(n.z, zero));
}

/* Returns the normals of vertices or corners of the mesh, in object space. */
static inline struct zr_vec3_v given_at(const struct zr_eye_normals *of, const int32_t numbers[ZR_LANES])
{
    const struct zr_mesh *mesh = of->mesh;
    const struct zr_crease_normals *creases = of->creases;
    const zr_vec4 *others = creases ? creases->normals : of->computed;
    struct zr_vec3_v own = zr_spread_v((zr_vec3){0.0f, 0.0f, 0.0f});
    int32_t vertices[ZR_LANES], own_numbers[ZR_LANES];
    const int32_t *vertex = numbers;
    zr_vf last;
    if (of->rate == ZR_RATE_CORNER && (of->computed || (mesh->normal_count > 0 && !mesh->normal_indices))) {
        numbers_at(mesh->indices, zr_vi_load(numbers), vertices);
        vertex = vertices;
    }
    if (mesh->normal_count > 0) {
        const int32_t *own_number = vertex;
        if (mesh->normal_indices) {
            numbers_at(mesh->normal_indices, zr_vi_load(numbers), own_numbers);
            own_number = own_numbers;
        }
        own = own_at(mesh, zr_vi_load(own_number));
    }
    const zr_vm missing = is_zero(own);
    if (!others || !zr_vm_any(missing)) return own;
    if (creases) vertex = numbers;
    if (creases && creases->numbers) {
        numbers_at(creases->numbers, zr_vi_load(numbers), vertices);
        vertex = vertices;
    }
    return zr_choose_v(missing, values_at(others, vertex, &last), own);
}

/* Returns the normals of faces of a mesh of triangles in object space. */
static inline struct zr_vec3_v of_faces(const struct zr_mesh *mesh, const int32_t faces[ZR_LANES])
{
    struct zr_vec3_v corners[3];
    for (int k = 0; k < 3; k++) {
        int32_t vertices[ZR_LANES];
        zr_vf w;
        numbers_at(mesh->indices + k, zr_vi_load(faces) * zr_vi_set(3), vertices);
        const struct zr_vec3_v at = values_at(mesh->positions, vertices, &w);
        corners[k] = zr_over_w_v(at, w);
    }
    return zr_triangle_normal_v(corners);
}

static inline void put(struct zr_vec3_v n, float (*out)[ZR_LANES])
{
    zr_vf_store(out[0], n.x);
    zr_vf_store(out[1], n.y);
    zr_vf_store(out[2], n.z);
    zr_vf_store(out[3], zr_vf_set(0.0f));
}

void ZR_KERNEL(zr_eye_normals_at)(const struct zr_eye_normals *of, const int32_t (*numbers)[ZR_LANES],
                                  struct zr_eye_values *out)
{
    if (of->rate == ZR_RATE_FACE) {
        const struct zr_vec3_v n = zr_unit_normal_v(&of->to_eye, of_faces(of->mesh, numbers[0]));
        for (int k = 0; k < 3; k++)
            put(n, out->at[k]);
        return;
    }
    for (int k = 0; k < 3; k++) {
        int32_t own[ZR_LANES];
        const zr_vi number = zr_vi_load(numbers[k]);
        const uint32_t others = zr_own_numbers(number, of->count, own);
        put(zr_unit_normal_v(&of->to_eye, given_at(of, own)), out->at[k]);
        if (others) zr_put_cut_values(of->cut, others, number, of->count, out->at[k]);
    }
}
