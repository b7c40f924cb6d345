/* A and B of core/shade/lights/dfg.h, integrated in double. */
#ifndef SPLIT_SUM_INTEGRAL_H
#define SPLIT_SUM_INTEGRAL_H

#include <math.h>

/* Directions H by GGX's own density, on a grid of steps x steps that is finer towards its long tail. Of N.V = 0 the
 * limit is taken from a little above. */
static void integrate_split_sum(double roughness, double nv, int steps, double *a, double *b)
{
    const double alpha = fmax(roughness * roughness, 1e-4), square = alpha * alpha;
    nv = fmax(nv, 1e-5);
    const double vx = sqrt(1.0 - nv * nv), pi = 3.14159265358979323846;
    *a = *b = 0.0;
    for (int i = 0; i < steps; i++)
        for (int k = 0; k < steps; k++) {
            const double t = 1.0 - (i + 0.5) / steps, u = 1.0 - t * t * t, phi = pi * (k + 0.5) / steps;
            const double nh = sqrt((1.0 - u) / (1.0 + (square - 1.0) * u)), hx = sqrt(1.0 - nh * nh) * cos(phi);
            const double vh = vx * hx + nv * nh, nl = 2.0 * vh * nh - nv;
            if (nl <= 0.0 || vh <= 0.0) continue;
            const double smith =
                0.5 / (nl * sqrt(nv * nv * (1.0 - square) + square) + nv * sqrt(nl * nl * (1.0 - square) + square));
            const double weight = 3.0 * t * t * 4.0 * smith * nl * vh / nh, fresnel = pow(1.0 - vh, 5.0);
            *a += weight * (1.0 - fresnel) / ((double)steps * steps);
            *b += weight * fresnel / ((double)steps * steps);
        }
}

#endif
