/* axis_lines.h - mesh: where lines along the axis of a cylinder are inside a part.
 *
 * Rule:   inside is where the winding number of the surface is not 0, as in caps. Lines are parallel to the axis: one
 *         near it, and six near the wall. An edge is decided from its ends in a fixed order, so a line crosses one of
 *         the triangles beside it, or neither.
 * Ends:   open if material is neither beyond the end near the axis nor near the wall; closed if it is beyond near the
 *         axis, or at most 1.5 radii farther, as under the tip of a drill. Narrow ends have material near the wall only.
 */
#ifndef ZR_AXIS_LINES_H
#define ZR_AXIS_LINES_H

#include "mesh/features/cylinders.h"

enum zr_cylinder_end { ZR_END_UNKNOWN, ZR_END_OPEN, ZR_END_NARROW, ZR_END_CLOSED };

struct zr_cylinder_ends {
    bool is_filled;              /* material in the middle of the axis */
    enum zr_cylinder_end end[2]; /* at the low and the high end; unknown: the surface is open there */
};

/* The least sphere-like bounds of a triangle: some place in it, and the distance of its farthest corner. */
struct zr_triangle_bounds {
    float x, y, z, radius;
};

/* Returns the bounds of all triangles, in the arena; NULL without memory or steps. */
const struct zr_triangle_bounds *zr_triangle_bounds_make(struct zr_arena *arena, struct zr_feature_work *work,
                                                         const struct zr_surface *surface);

/* Looks along the axis of a cylinder. `room`: a number for each triangle. False without steps. */
bool zr_axis_lines_look(struct zr_feature_work *work, const struct zr_surface *surface,
                        const struct zr_triangle_bounds *bounds, const struct zr_cylinder *cylinder, uint32_t *room,
                        struct zr_cylinder_ends *out);

#endif
