#include "base/vec.h"

bool zr_mat4_is_mirror(const zr_mat4 *matrix)
{
    const float *f = matrix->m;
    const double a[3] = {(double)f[0], (double)f[1], (double)f[2]}, b[3] = {(double)f[4], (double)f[5], (double)f[6]},
                 c[3] = {(double)f[8], (double)f[9], (double)f[10]};
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]) <
           0.0;
}

bool zr_mat4_invert(const zr_mat4 *matrix, zr_mat4 *out)
{
    double m[16];
    for (int i = 0; i < 16; i++)
        m[i] = (double)matrix->m[i];
    /* 2x2 minors of the upper (s) and lower (c) two rows; Laplace expansion by
     * complementary minors (Eberly, "The Laplace Expansion Theorem", 2008).
     * The formula is symmetric in rows and columns, so column-major fits it. */
    double s0 = m[0] * m[5] - m[4] * m[1], s1 = m[0] * m[6] - m[4] * m[2], s2 = m[0] * m[7] - m[4] * m[3];
    double s3 = m[1] * m[6] - m[5] * m[2], s4 = m[1] * m[7] - m[5] * m[3], s5 = m[2] * m[7] - m[6] * m[3];
    double c0 = m[8] * m[13] - m[12] * m[9], c1 = m[8] * m[14] - m[12] * m[10], c2 = m[8] * m[15] - m[12] * m[11];
    double c3 = m[9] * m[14] - m[13] * m[10], c4 = m[9] * m[15] - m[13] * m[11], c5 = m[10] * m[15] - m[14] * m[11];
    double det = s0 * c5 - s1 * c4 + s2 * c3 + s3 * c2 - s4 * c1 + s5 * c0;
    if (!isfinite(det) || det == 0.0) return false;
    double inverse[16] = {m[5] * c5 - m[6] * c4 + m[7] * c3,     -m[1] * c5 + m[2] * c4 - m[3] * c3,
                          m[13] * s5 - m[14] * s4 + m[15] * s3,  -m[9] * s5 + m[10] * s4 - m[11] * s3,
                          -m[4] * c5 + m[6] * c2 - m[7] * c1,    m[0] * c5 - m[2] * c2 + m[3] * c1,
                          -m[12] * s5 + m[14] * s2 - m[15] * s1, m[8] * s5 - m[10] * s2 + m[11] * s1,
                          m[4] * c4 - m[5] * c2 + m[7] * c0,     -m[0] * c4 + m[1] * c2 - m[3] * c0,
                          m[12] * s4 - m[13] * s2 + m[15] * s0,  -m[8] * s4 + m[9] * s2 - m[11] * s0,
                          -m[4] * c3 + m[5] * c1 - m[6] * c0,    m[0] * c3 - m[1] * c1 + m[2] * c0,
                          -m[12] * s3 + m[13] * s1 - m[14] * s0, m[8] * s3 - m[9] * s1 + m[10] * s0};
    for (int i = 0; i < 16; i++) {
        out->m[i] = (float)(inverse[i] / det);
        if (!isfinite(out->m[i])) return false;
    }
    return true;
}
