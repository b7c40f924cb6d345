/* cone_ends.h - mesh: cones at the ends of a cylinder: countersinks of holes, tips of drills, chamfers of pins.
 *
 * Rule:   along nearly the whole end, the next facets are inclined alike, by 10 to 80 degrees, and reach equally far:
 *         along the axis and from it.
 */
#ifndef ZR_CONE_ENDS_H
#define ZR_CONE_ENDS_H

#include "mesh/features/cylinder_fit.h"
#include "mesh/features/facets.h"

/* The far end of a cone; height 0: there is none. */
struct zr_cone_end {
    double radius, height; /* height: along the axis, from the cylinder's end */
};

/* Finds the cones at the low and the high end of a cylinder of facets, whose range is from `low` to `high`. False
 * without steps. */
bool zr_cone_ends_find(struct zr_feature_work *work, const struct zr_facets *facets, const uint32_t *list,
                       uint32_t count, const struct zr_cylinder_frame *frame, double low, double high,
                       struct zr_cone_end ends[2]);

#endif
