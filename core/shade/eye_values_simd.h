/* eye_values_simd.h - shade: vectors and normals in eye space at the corners of ZR_LANES triangles, made when they are
 * loaded, for kernels. Arrays of them would hold the values of hidden triangles, too.
 */
#ifndef ZR_EYE_VALUES_SIMD_H
#define ZR_EYE_VALUES_SIMD_H

#include "base/vec3_simd.h"
#include "shade/eye_normals.h"
#include "shade/eye_vectors.h"

/* Components x, y, z and w of a value for each of three corners. */
struct zr_eye_values {
    float at[3][4][ZR_LANES];
};

/* Writes the numbers of values of the mesh, 0 for those of clipped vertices, whose lanes it returns. */
static inline uint32_t zr_own_numbers(zr_vi numbers, uint32_t count, int32_t out[ZR_LANES])
{
    const zr_vm own = zr_vi_lt(numbers, zr_vi_set((int32_t)count));
    zr_vi_store(out, zr_vi_select(own, numbers, zr_vi_set(0)));
    return zr_vm_bits(own) ^ ZR_ALL_BITS;
}

/* Overwrites the values of lanes of clipped vertices. */
static inline void zr_put_cut_values(const zr_vec4 *cut, uint32_t lanes, zr_vi numbers, uint32_t count,
                                     float (*out)[ZR_LANES])
{
    int32_t each[ZR_LANES];
    zr_vi_store(each, numbers);
    for (; lanes; lanes &= lanes - 1) {
        const int i = zr_lowest_bit(lanes);
        const zr_vec4 *value = &cut[(uint32_t)each[i] - count];
        out[0][i] = value->x, out[1][i] = value->y, out[2][i] = value->z, out[3][i] = value->w;
    }
}

/* Make zr_eye_vector of vertices first + ..., and zr_eye_normals_make's values by their numbers, with w = 0. Compiled
 * in kernels of their own (eye_vectors_kernel.c, eye_normals_kernel.c), since their code would be inlined many times.
 * has_depth: w is made, else undefined. */
void ZR_KERNEL(zr_eye_vectors_at)(const struct zr_eye_vectors *of, uint32_t first, const int32_t (*vertices)[ZR_LANES],
                                  bool has_depth, struct zr_eye_values *out);
void ZR_KERNEL(zr_eye_normals_at)(const struct zr_eye_normals *of, const int32_t (*numbers)[ZR_LANES],
                                  struct zr_eye_values *out);

/* Loads the values of corners. */
static inline void zr_eye_values_load(const struct zr_eye_values *values, struct zr_vec3_v c[3], zr_vf last[3])
{
    for (int k = 0; k < 3; k++) {
        c[k] = (struct zr_vec3_v){zr_vf_load(values->at[k][0]), zr_vf_load(values->at[k][1]),
                                  zr_vf_load(values->at[k][2])};
        last[k] = zr_vf_load(values->at[k][3]);
    }
}

#endif
