/* unit_normal_simd.h - shade: normals in eye space, for kernels. */
#ifndef ZR_UNIT_NORMAL_SIMD_H
#define ZR_UNIT_NORMAL_SIMD_H

#include "base/vec3_simd.h"
#include "shade/lights/light.h"

/* Returns unit normals in eye space. n: in object space, of any length. */
static inline struct zr_vec3_v zr_unit_normal_v(const struct zr_normal_matrix *to_eye, struct zr_vec3_v n)
{
    n = zr_normalize_v(n); /* first, since a tiny face would underflow below */
    n = (struct zr_vec3_v){zr_dot_v(zr_spread_v(to_eye->rows[0]), n), zr_dot_v(zr_spread_v(to_eye->rows[1]), n),
                           zr_dot_v(zr_spread_v(to_eye->rows[2]), n)};
    return zr_normalize_v(n);
}

#endif
