/* bounding_cylinder.h - mesh: the least cylinder around a surface, along given directions.
 *
 * How:    the least circle around the places across each direction, from its two or three places on the border: the
 *         farthest place outside joins them until there is none. The cylinder with the least volume is taken.
 */
#ifndef ZR_BOUNDING_CYLINDER_H
#define ZR_BOUNDING_CYLINDER_H

#include "base/arena.h"
#include "mesh/features/surface.h"

struct zr_bounding_cylinder {
    bool is_found;
    zr_dvec3 axis; /* unit length */
    zr_dvec3 at;   /* centre of its lower end, from which the axis leads up */
    double diameter, height;
};

/* Finds the least of the cylinders along `count` directions of unit length; of equal ones, the first. */
struct zr_bounding_cylinder zr_bounding_cylinder_find(struct zr_feature_work *work, const struct zr_surface *surface,
                                                      const zr_dvec3 *directions, uint32_t count);

#endif
