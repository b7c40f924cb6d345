/* mat4_simd.h - geometry: a matrix with each entry in all lanes, for kernels. */
#ifndef ZR_MAT4_SIMD_H
#define ZR_MAT4_SIMD_H

#include "base/simd/simd.h"
#include "base/vec.h"

struct zr_mat4_v {
    zr_vf m[16];
};

static inline struct zr_mat4_v zr_spread_mat4_v(const zr_mat4 *m)
{
    struct zr_mat4_v out;
    for (int i = 0; i < 16; i++)
        out.m[i] = zr_vf_set(m->m[i]);
    return out;
}

/* zr_mat4_row of each lane. */
static inline zr_vf zr_mat4_row_v(const struct zr_mat4_v *m, int row, zr_vf x, zr_vf y, zr_vf z, zr_vf w)
{
    x = x * m->m[row], y = y * m->m[4 + row], z = z * m->m[8 + row], w = w * m->m[12 + row];
    return ZR_MUTANT(sums_from_the_right, ((x + y) + z) + w, x + (y + (z + w)));
}

#endif
