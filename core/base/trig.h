/* trig.h - base: sine, cosine and tangent that are the same on every machine.
 *
 * libm's last bit differs from system to system, and a camera's tangent reaches
 * every pixel. These use additions and products in a fixed order only.
 */
#ifndef ZR_TRIG_H
#define ZR_TRIG_H

/* |radians| <= 1e6; within 2 ulp of the true value near multiples of pi/2, better elsewhere. */
double zr_sin(double radians);
double zr_cos(double radians);
double zr_tan(double radians);

#endif
