/* holes.h - mesh: holes, bosses and fillets among the cylinders of a surface.
 *
 * Hole:   concave, over more than 185 degrees, with no material in the middle. Fewer than 8 segments count only if they
 *         go all around. Coaxial holes that meet are steps of one: the narrowest is the hole, the others its steps.
 *         A hole that is closed at both ends is a cavity, and is left out.
 *         Cones that widen at its ends, such as countersinks, are steps, too.
 * Boss:   the same for convex cylinders, such as shafts and rims. Half turns, such as ends of slots, are neither.
 * Fillet: 45 degrees or more and at least 4 facets, up to 185 degrees; convex ones are rounded edges. All corners lie
 *         on the circle, to 0.05 % of its radius: free forms seldom do.
 * Reach:  by mesh/features/axis_lines.h. A hole whose ends both open is through.
 * Equal:  holes of one diameter, depth, reach, direction and steps are of one group.
 */
#ifndef ZR_HOLES_H
#define ZR_HOLES_H

#include "mesh/features/cylinders.h"
#include "mesh/features/patterns.h"

enum { ZR_HOLE_STEPS_MAX = 6 };

enum zr_hole_reach { ZR_REACH_UNKNOWN, ZR_REACH_THROUGH, ZR_REACH_BLIND };

struct zr_hole_step {
    double diameter, depth; /* of a cone: of its wide end */
    double angle;           /* of a cone, such as a countersink: between opposite sides, in degrees; 0: a cylinder */
    uint32_t segments;
};

/* A hole or a boss. */
struct zr_hole {
    double diameter;          /* of the circle through the corners */
    double across_flats;      /* twice the least distance of a facet from the axis */
    double depth;             /* length of the cylinder, without steps */
    double coverage;          /* degrees */
    zr_dvec3 at;              /* centre of the entry of the hole with its steps, or of the foot of a boss */
    zr_dvec3 axis;            /* from there into the hole, or away from the foot */
    uint32_t segments;        /* facets of a whole turn */
    enum zr_hole_reach reach; /* of holes */
    uint32_t step_count;
    struct zr_hole_step steps[ZR_HOLE_STEPS_MAX]; /* from the entry on */
    uint32_t group;                               /* number of the first equal one */
    struct zr_pattern pattern;                    /* of its group; only the first one has it */
};

struct zr_fillets {
    double radius;
    bool is_convex;
    uint32_t count;
};

struct zr_holes {
    uint32_t hole_count, boss_count, fillet_count;
    const struct zr_hole *holes, *bosses;
    const struct zr_fillets *fillets; /* by radius and side, ascending */
};

/* Finds them, in the arena. False without memory or steps. */
bool zr_holes_find(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_facets *facets,
                   const struct zr_seeds *seeds, struct zr_holes *out);

#endif
