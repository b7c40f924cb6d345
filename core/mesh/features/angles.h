/* angles.h - mesh: angles of directions in a plane, and sets of angles. Without libm: the same on every machine. */
#ifndef ZR_ANGLES_H
#define ZR_ANGLES_H

#include <stdbool.h>
#include <stdint.h>

/* Angles that are covered, in steps of a tenth of a degree. */
enum { ZR_ANGLE_STEPS = 3600, ZR_ANGLE_WORDS = (ZR_ANGLE_STEPS + 63) / 64 };

struct zr_angle_set {
    uint64_t words[ZR_ANGLE_WORDS];
};

/* Returns the angle of (x, y), in degrees from 0 up to 360, within 1e-9; 0 for (0, 0). */
double zr_angle_of(double x, double y);

/* Adds the arc that leads counterclockwise from one angle to another. */
void zr_angle_set_add(struct zr_angle_set *set, double from, double to);

/* Returns the degrees covered. */
double zr_angle_set_degrees(const struct zr_angle_set *set);

/* Returns the number of separate arcs in the set; 1 if it is a whole turn. */
uint32_t zr_angle_set_arcs(const struct zr_angle_set *set);

#endif
