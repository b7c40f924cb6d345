/* slerp.h - scene: interpolates between two rotations. */
#ifndef ZR_SLERP_H
#define ZR_SLERP_H

/* Writes the unit quaternion x, y, z, w at `share`, 0 to 1, of the shorter arc from a to b. These may have any length.
 * A zero quaternion stays zero. All machines give the same bits. */
void zr_slerp(const float a[4], const float b[4], double share, float out[4]);

/* The same in doubles. */
void zr_slerp_exact(const double a[4], const double b[4], double share, double out[4]);

#endif
