/* trig.h - base: the trigonometric functions on the path to a pixel.
 *
 * libm's last bit differs from system to system, and a camera's angles reach
 * every pixel. These use additions, products and quotients in a fixed order only.
 */
#ifndef ZR_TRIG_H
#define ZR_TRIG_H

/* 0 < radians < pi/2; within 4 ulp of the true value. */
double zr_tan(double radians);

/* Any finite angle; within 1.5 ulp of the true values, and exact at multiples of 90. */
void zr_sine_cosine(double degrees, double *sine, double *cosine);

#endif
