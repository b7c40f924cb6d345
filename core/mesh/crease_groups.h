/* crease_groups.h - mesh: corners of a crowded vertex, in groups of similar directions.
 *
 * Space:  object space. */
#ifndef ZR_CREASE_GROUPS_H
#define ZR_CREASE_GROUPS_H

#include <stdint.h>

#include "base/vec.h"

enum {
    ZR_CREASE_GROUPS_PER_SIDE = 16, /* directions are grouped by squares on the sides of a cube */
    ZR_CREASE_GROUPS = 6 * ZR_CREASE_GROUPS_PER_SIDE * ZR_CREASE_GROUPS_PER_SIDE
};

/* One face at a vertex, or a group of similar ones: the direction to compare, and the weighted sum to add. */
struct zr_crease_source {
    zr_vec4 normal, sum;
};

/* Sums the corners into groups by direction and returns the number of groups. */
uint32_t zr_crease_groups(const zr_vec4 *corners, const uint32_t *slots, uint32_t count,
                          struct zr_crease_source groups[ZR_CREASE_GROUPS]);

#endif
