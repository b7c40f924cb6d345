/* trig.h - base: trigonometric functions for values that reach pixels.
 *
 * libm's last bit differs between systems, and the angles of a camera affect every pixel. These use additions, products
 * and quotients in a fixed order only. */
#ifndef ZR_TRIG_H
#define ZR_TRIG_H

/* Returns the tangent for 0 < radians < pi/2, within 4 ulp of the true value. */
double zr_tan(double radians);

/* Computes sine and cosine of any finite angle, within 1.5 ulp of the true values, and exact at multiples of 90. */
void zr_sine_cosine(double degrees, double *sine, double *cosine);

#endif
