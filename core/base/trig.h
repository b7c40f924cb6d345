/* trig.h - base: the one trigonometric function on the path to a pixel.
 *
 * libm's last bit differs from system to system, and a camera's tangent reaches
 * every pixel. This uses additions, products and quotients in a fixed order only.
 */
#ifndef ZR_TRIG_H
#define ZR_TRIG_H

/* 0 < radians < pi/2; within 4 ulp of the true value. */
double zr_tan(double radians);

#endif
