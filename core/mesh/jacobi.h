/* jacobi.h - mesh: a step of Jacobi's method for the eigenvectors of a symmetric matrix.
 *
 * Source: Golub and Van Loan, "Matrix Computations", 8.5.2. */
#ifndef ZR_JACOBI_H
#define ZR_JACOBI_H

#include <math.h>

/* Turns axes p and q so that m[p][q] becomes 0. The columns of `vectors` are the turned axes. */
static inline void zr_jacobi_turn(double m[3][3], double vectors[3][3], int p, int q)
{
    if (m[p][q] == 0.0) return;
    const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    const double t = (theta < 0.0 ? -1.0 : 1.0) / (fabs(theta) + sqrt(theta * theta + 1.0));
    const double c = 1.0 / sqrt(t * t + 1.0), s = t * c;
    for (int k = 0; k < 3; k++) {
        const double a = m[k][p], b = m[k][q];
        m[k][p] = c * a - s * b;
        m[k][q] = s * a + c * b;
    }
    for (int k = 0; k < 3; k++) {
        const double a = m[p][k], b = m[q][k];
        m[p][k] = c * a - s * b;
        m[q][k] = s * a + c * b;
    }
    for (int k = 0; k < 3; k++) {
        const double a = vectors[k][p], b = vectors[k][q];
        vectors[k][p] = c * a - s * b;
        vectors[k][q] = s * a + c * b;
    }
}

#endif
