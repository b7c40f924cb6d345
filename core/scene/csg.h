/* csg.h - scene: solids combined: a tree of unions, differences and intersections over parts of the scene.
 *
 * Operand: the parts that one set names, united. A point is inside a part if its winding number there is not 0.
 * Steps:   the tree in postfix order: ZR_CSG_PARTS puts an operand on a stack, all others replace the two values on top
 *          by one.
 * Drawing: faces of operands are visible where the tree's value changes along a ray (render/layers/solid_walk.h).
 */
#ifndef ZR_CSG_H
#define ZR_CSG_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/part_set.h"

/* Parts that operands have in all; steps, which leaves of one part each and binary operations take; depth of the tree,
 * and of the stack. */
enum { ZR_CSG_PARTS_MAX = 64, ZR_CSG_STEPS_MAX = 2 * ZR_CSG_PARTS_MAX, ZR_CSG_DEPTH_MAX = 32 };

enum zr_csg_op { ZR_CSG_PARTS, ZR_CSG_UNION, ZR_CSG_DIFFERENCE, ZR_CSG_INTERSECTION };

/* A step as read. */
struct zr_csg_key {
    enum zr_csg_op op;
    struct zr_part_set parts; /* ZR_CSG_PARTS */
    bool is_tool;             /* ZR_CSG_PARTS: only removes, or only limits: views do not fit it */
};

struct zr_csg_keys {
    uint32_t count; /* 0: no solids are combined */
    const struct zr_csg_key *steps;
    const char *pointer; /* JSON Pointer of the value */
};

struct zr_csg_step {
    enum zr_csg_op op;
    uint64_t parts; /* ZR_CSG_PARTS: bits of the operands' parts */
};

/* The tree over the scene's parts, which are numbered 0 .. part_count - 1 here. */
struct zr_csg {
    uint32_t step_count, part_count;
    const struct zr_csg_step *steps;
    const uint32_t *first_parts; /* per instance: its first part in the list of parts */
    const uint8_t *parts;        /* per part of that list: 1 + its number, or 0 */
    uint64_t tools;              /* bits of parts that views do not fit */
    double tolerance;            /* world units: faces closer than this along a ray lie at one place */
};

/* Returns the value of the tree at a place; bit i of `inside` is set if the place is inside part i. */
static inline bool zr_csg_value(const struct zr_csg *csg, uint64_t inside)
{
    uint64_t stack = 0;
    for (uint32_t i = 0; i < csg->step_count; i++) {
        const struct zr_csg_step *step = &csg->steps[i];
        const uint64_t b = stack & 1, a = stack >> 1 & 1, rest = stack >> 1 & ~UINT64_C(1);
        switch (step->op) {
        case ZR_CSG_PARTS:
            stack = stack << 1 | ((inside & step->parts) != 0);
            break;
        case ZR_CSG_UNION:
            stack = rest | a | b;
            break;
        case ZR_CSG_DIFFERENCE:
            stack = rest | (a & ~b);
            break;
        case ZR_CSG_INTERSECTION:
            stack = rest | (a & b);
            break;
        }
    }
    return stack & 1;
}

#endif
