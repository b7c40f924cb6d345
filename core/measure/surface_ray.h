/* surface_ray.h - measure: the way of a ray through a tree of triangles (measure/surface_tree.h). */
#ifndef ZR_SURFACE_RAY_H
#define ZR_SURFACE_RAY_H

#include "measure/surface_tree.h"

/* Returns the distance along a ray at which it first leaves a part through the front of a face, or 0 if it does not.
 * `from` lies on a face of the part, and the unit vector leads into it; faces nearer than `least` are passed over. Adds
 * to *steps. */
double zr_surface_ray_exit(const struct zr_surface_tree *tree, uint32_t part, struct zr_world_place from,
                           struct zr_world_place direction, double least, uint64_t *steps);

#endif
