/* matrix.h - base: 4 by 4 matrices in double, column-major like zr_mat4. */
#ifndef ZR_MATRIX_H
#define ZR_MATRIX_H

#include <stdbool.h>

#include "base/vec.h"

struct zr_matrix {
    double m[16];
};

struct zr_matrix zr_matrix_of(const zr_mat4 *matrix);

/* Returns a b, each sum from left to right. */
struct zr_matrix zr_matrix_mul(const struct zr_matrix *a, const struct zr_matrix *b);

/* out = m * v. */
void zr_matrix_apply(const struct zr_matrix *m, const double v[4], double out[4]);

/* Inverts a matrix. Returns false if it has no inverse: *out is then all zeros. */
bool zr_matrix_invert(const struct zr_matrix *m, struct zr_matrix *out);

/* Returns translation · rotation · scale; the rotation is a quaternion x, y, z, w of any length above 0. */
zr_mat4 zr_mat4_of_pose(zr_vec3 t, zr_vec4 q, zr_vec3 s);

/* The same in doubles. */
struct zr_matrix zr_matrix_of_pose(const double t[3], const double q[4], const double s[3]);

#endif
