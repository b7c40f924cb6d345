/* cylinder_fit.h - mesh: the cylinder through facets, by least squares.
 *
 * How:    the axis is the direction that is most nearly at right angles to all normals: the eigenvector of the least
 *         eigenvalue of the sum of area * n * n^T, by inverse iteration. The circle across it goes through points by
 *         Kasa's fit, which is exact for points on a circle.
 */
#ifndef ZR_CYLINDER_FIT_H
#define ZR_CYLINDER_FIT_H

#include "base/dvec3.h"

struct zr_cylinder_frame {
    zr_dvec3 axis, u, v; /* unit length, a right-handed system */
    zr_dvec3 center;     /* a place on the axis */
    double radius;
};

struct zr_normal_sums {
    double xx, xy, xz, yy, yz, zz;
};

struct zr_circle_sums {
    double count, x, y, xx, xy, yy, xq, yq, q; /* q: x^2 + y^2 */
};

/* Completes axis to a system. */
void zr_cylinder_frame_turn(struct zr_cylinder_frame *frame, zr_dvec3 axis);

void zr_normal_sums_add(struct zr_normal_sums *sums, zr_dvec3 normal, double weight);

/* Returns the eigenvectors of the sums, of unit length, that of the least eigenvalue first, by Jacobi's rotations. */
void zr_normal_sums_axes(const struct zr_normal_sums *sums, zr_dvec3 axes[3]);

/* Returns the unit vector that is most nearly at right angles to the normals; 0 if all are parallel. */
zr_dvec3 zr_normal_sums_axis(const struct zr_normal_sums *sums);

void zr_circle_sums_add(struct zr_circle_sums *sums, double x, double y);

/* Finds the circle. False if the points are on a line. */
bool zr_circle_sums_fit(const struct zr_circle_sums *sums, double *x, double *y, double *radius);

#endif
