#include "base/matrix.h"

#include <string.h>

struct zr_matrix zr_matrix_of(const zr_mat4 *matrix)
{
    struct zr_matrix out;
    for (int i = 0; i < 16; i++)
        out.m[i] = (double)matrix->m[i];
    return out;
}

struct zr_matrix zr_matrix_mul(const struct zr_matrix *a, const struct zr_matrix *b)
{
    struct zr_matrix out;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            const double *c = &b->m[column * 4];
            out.m[column * 4 + row] =
                ((a->m[row] * c[0] + a->m[4 + row] * c[1]) + a->m[8 + row] * c[2]) + a->m[12 + row] * c[3];
        }
    return out;
}

void zr_matrix_apply(const struct zr_matrix *m, const double v[4], double out[4])
{
    for (int row = 0; row < 4; row++)
        out[row] = ((m->m[row] * v[0] + m->m[4 + row] * v[1]) + m->m[8 + row] * v[2]) + m->m[12 + row] * v[3];
}

static void swap_rows(double rows[4][8], int i, int k)
{
    double row[8];
    memcpy(row, rows[i], sizeof row);
    memcpy(rows[i], rows[k], sizeof row);
    memcpy(rows[k], row, sizeof row);
}

/* Inverts by Gauss-Jordan elimination beside the identity; the pivot is the largest entry of each column. */
bool zr_matrix_invert(const struct zr_matrix *m, struct zr_matrix *out)
{
    double rows[4][8];
    memset(out, 0, sizeof *out);
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++) {
            rows[row][column] = m->m[4 * column + row];
            rows[row][4 + column] = row == column ? 1.0 : 0.0;
        }
    for (int column = 0; column < 4; column++) {
        int best = column;
        for (int row = column + 1; row < 4; row++)
            if (fabs(rows[row][column]) > fabs(rows[best][column])) best = row;
        if (!(fabs(rows[best][column]) > 0.0)) return false;
        swap_rows(rows, column, best);
        for (int row = 0; row < 4; row++) {
            const double factor = rows[row][column] / rows[column][column];
            for (int k = 0; k < 8 && row != column; k++)
                rows[row][k] -= factor * rows[column][k];
        }
    }
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++)
            out->m[4 * column + row] = rows[row][4 + column] / rows[row][row];
    return true;
}

/* The quaternion is normalised by dividing products by its squared length, so that right angles stay exact.
 * Source: glTF 2.0, section 3.5.3 "Transformations"; Shoemake, "Quaternions", 1991. */
struct zr_matrix zr_matrix_of_pose(const double t[3], const double q[4], const double s[3])
{
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double n = x * x + y * y + z * z + w * w;
    const double rotation[9] = {
        (w * w + x * x - y * y - z * z) / n, 2 * (x * y + w * z) / n, 2 * (x * z - w * y) / n, 2 * (x * y - w * z) / n,
        (w * w - x * x + y * y - z * z) / n, 2 * (y * z + w * x) / n, 2 * (x * z + w * y) / n, 2 * (y * z - w * x) / n,
        (w * w - x * x - y * y + z * z) / n};
    struct zr_matrix out = {.m = {[12] = t[0], [13] = t[1], [14] = t[2], [15] = 1.0}};
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            out.m[column * 4 + row] = rotation[column * 3 + row] * s[column];
    return out;
}

zr_mat4 zr_mat4_of_pose(zr_vec3 t, zr_vec4 q, zr_vec3 s)
{
    const struct zr_matrix exact =
        zr_matrix_of_pose((const double[]){(double)t.x, (double)t.y, (double)t.z},
                          (const double[]){(double)q.x, (double)q.y, (double)q.z, (double)q.w},
                          (const double[]){(double)s.x, (double)s.y, (double)s.z});
    zr_mat4 out;
    for (int i = 0; i < 16; i++)
        out.m[i] = (float)exact.m[i];
    return out;
}
