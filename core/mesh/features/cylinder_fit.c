#include "mesh/features/cylinder_fit.h"

#include "mesh/jacobi.h"

enum { SWEEPS = 12, ITERATIONS = 4 };

void zr_cylinder_frame_turn(struct zr_cylinder_frame *frame, zr_dvec3 axis)
{
    const double x = fabs(axis.x), y = fabs(axis.y), z = fabs(axis.z);
    const zr_dvec3 other = x <= y && x <= z ? (zr_dvec3){1, 0, 0} : y <= z ? (zr_dvec3){0, 1, 0} : (zr_dvec3){0, 0, 1};
    const zr_dvec3 u = zr_dvec3_cross(other, axis);
    const double scale = 1.0 / sqrt(zr_dvec3_dot(u, u));
    frame->axis = axis;
    frame->u = (zr_dvec3){u.x * scale, u.y * scale, u.z * scale};
    frame->v = zr_dvec3_cross(axis, frame->u);
}

void zr_normal_sums_add(struct zr_normal_sums *sums, zr_dvec3 n, double weight)
{
    sums->xx += weight * (n.x * n.x);
    sums->xy += weight * (n.x * n.y);
    sums->xz += weight * (n.x * n.z);
    sums->yy += weight * (n.y * n.y);
    sums->yz += weight * (n.y * n.z);
    sums->zz += weight * (n.z * n.z);
}

void zr_normal_sums_axes(const struct zr_normal_sums *sums, zr_dvec3 axes[3])
{
    double m[3][3] = {{sums->xx, sums->xy, sums->xz}, {sums->xy, sums->yy, sums->yz}, {sums->xz, sums->yz, sums->zz}};
    double vectors[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    int order[3] = {0, 1, 2};
    const double trace = m[0][0] + m[1][1] + m[2][2];
    for (int i = 0; i < SWEEPS && fabs(m[0][1]) + fabs(m[0][2]) + fabs(m[1][2]) > 1e-17 * trace; i++) {
        zr_jacobi_turn(m, vectors, 0, 1);
        zr_jacobi_turn(m, vectors, 0, 2);
        zr_jacobi_turn(m, vectors, 1, 2);
    }
    for (int i = 0; i < 2; i++)
        for (int k = 2; k > i; k--) {
            const int low = order[k - 1], high = order[k];
            if (m[high][high] >= m[low][low]) continue;
            order[k - 1] = high;
            order[k] = low;
        }
    for (int k = 0; k < 3; k++) {
        const zr_dvec3 axis = {vectors[0][order[k]], vectors[1][order[k]], vectors[2][order[k]]};
        const double scale = 1.0 / sqrt(zr_dvec3_dot(axis, axis));
        axes[k] = (zr_dvec3){axis.x * scale, axis.y * scale, axis.z * scale};
    }
}

/* Multiplies by the adjugate of the sums, which is their inverse times a number: an inverse iteration, which also works
 * if the least eigenvalue is 0. */
zr_dvec3 zr_normal_sums_axis(const struct zr_normal_sums *s)
{
    const double xx = s->yy * s->zz - s->yz * s->yz, yy = s->xx * s->zz - s->xz * s->xz,
                 zz = s->xx * s->yy - s->xy * s->xy;
    const double xy = s->xz * s->yz - s->xy * s->zz, xz = s->xy * s->yz - s->xz * s->yy,
                 yz = s->xy * s->xz - s->xx * s->yz;
    zr_dvec3 axis = xx >= yy && xx >= zz ? (zr_dvec3){xx, xy, xz}
                    : yy >= zz           ? (zr_dvec3){xy, yy, yz}
                                         : (zr_dvec3){xz, yz, zz};
    for (int i = 0; i < ITERATIONS; i++) {
        const double square = zr_dvec3_dot(axis, axis), scale = square > 0.0 ? 1.0 / sqrt(square) : 0.0;
        const zr_dvec3 v = {axis.x * scale, axis.y * scale, axis.z * scale};
        axis = v;
        if (i + 1 < ITERATIONS)
            axis = (zr_dvec3){(xx * v.x + xy * v.y) + xz * v.z, (xy * v.x + yy * v.y) + yz * v.z,
                              (xz * v.x + yz * v.y) + zz * v.z};
    }
    return axis;
}

void zr_circle_sums_add(struct zr_circle_sums *sums, double x, double y)
{
    const double q = x * x + y * y;
    sums->count += 1.0;
    sums->x += x;
    sums->y += y;
    sums->xx += x * x;
    sums->xy += x * y;
    sums->yy += y * y;
    sums->xq += x * q;
    sums->yq += y * q;
    sums->q += q;
}

bool zr_circle_sums_fit(const struct zr_circle_sums *s, double *x, double *y, double *radius)
{
    if (s->count < 3.0) return false;
    const double mx = s->x / s->count, my = s->y / s->count, mq = s->q / s->count;
    const double xx = s->xx / s->count - mx * mx, xy = s->xy / s->count - mx * my, yy = s->yy / s->count - my * my;
    const double xq = s->xq / s->count - mx * mq, yq = s->yq / s->count - my * mq;
    const double determinant = xx * yy - xy * xy, size = xx + yy;
    if (!(determinant > 1e-14 * size * size)) return false;
    *x = 0.5 * (xq * yy - yq * xy) / determinant;
    *y = 0.5 * (yq * xx - xq * xy) / determinant;
    const double square = mq - 2.0 * (*x * mx + *y * my) + (*x * *x + *y * *y);
    if (!(square > 0.0)) return false;
    *radius = sqrt(square);
    return true;
}
