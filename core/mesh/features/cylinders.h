/* cylinders.h - mesh: whole cylinders, joined from patches (mesh/features/patches.h).
 *
 * Joined: patches of one axis and radius (0.5 %), of the same side, whose ranges along the axis touch, such as arcs
 *         between keyways. If no cylinder fits them all, each stays one of its own.
 */
#ifndef ZR_CYLINDERS_H
#define ZR_CYLINDERS_H

#include "mesh/features/cone_ends.h"
#include "mesh/features/patches.h"

struct zr_cylinder {
    struct zr_cylinder_frame frame;
    bool is_concave;
    double low, high;            /* along the axis, from the frame's centre */
    double coverage;             /* degrees of the turn that facets cover */
    double flat;                 /* least distance of a facet's plane from the axis */
    double error;                /* farthest corner from the circle */
    uint32_t segments;           /* facets of a whole turn */
    uint32_t facets;             /* directions of facets that there are */
    struct zr_cone_end cones[2]; /* at the low and the high end, of more than half a turn */
};

struct zr_cylinders {
    uint32_t count;
    const struct zr_cylinder *at;
};

/* Finds the cylinders, in the arena. False without memory or steps. */
bool zr_cylinders_find(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_facets *facets,
                       const struct zr_seeds *seeds, struct zr_cylinders *out);

/* Returns true if two axes are the same: parallel, and the middle of `b` is on that of `a`, to a tolerance. */
bool zr_cylinders_share_axis(const struct zr_cylinder *a, const struct zr_cylinder *b, double tolerance);

/* Returns the range of `b` along the axis of `a`, from the centre of `a`. */
void zr_cylinder_range_along(const struct zr_cylinder *a, const struct zr_cylinder *b, double range[2]);

#endif
