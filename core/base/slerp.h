/* slerp.h - base: rotations between two rotations. */
#ifndef ZR_SLERP_H
#define ZR_SLERP_H

/* Writes the unit quaternion x, y, z, w at `share` of the shorter arc from a to b, of any length. A zero quaternion is
 * kept. Every machine gets the same bits. */
void zr_slerp(const float a[4], const float b[4], double share, float out[4]);

#endif
