/* surface_points.h - measure: points that are spread evenly over the triangles of a solid.
 *
 * Where:  each has an equal share of the area, in the order of the triangles. Its place in its triangle is that of the
 *         R2 sequence. There are no random numbers: the same solid gives the same points.
 * Source: Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
 */
#ifndef ZR_SURFACE_POINTS_H
#define ZR_SURFACE_POINTS_H

#include "base/cancel.h"
#include "measure/solid.h"

struct zr_surface_point {
    struct zr_world_place at;
    uint32_t triangle;
};

/* Places `wanted` points. Returns their number, which is less only if the solid has no area, or if cancelled. */
uint32_t zr_surface_points_place(const struct zr_solid *solid, const struct zr_cancel *cancel, uint32_t wanted,
                                 struct zr_surface_point *out);

#endif
