/* patterns.h - mesh: regular arrangements of equal holes or bosses.
 *
 * Grid:   all places are those of rows and columns at right angles, at equal distances: 2 by 2 for four at the corners of a
 *         rectangle, 5 by 1 for a row.
 * Circle: three, or five and more, at equal angles on a circle.
 * Rule:   to a thousandth of the distances, and 2e-5 of the size, in a plane across the axis. Other groups have none.
 */
#ifndef ZR_PATTERNS_H
#define ZR_PATTERNS_H

#include "base/arena.h"
#include "mesh/features/cylinder_fit.h"
#include "mesh/features/surface.h"

enum zr_pattern_kind { ZR_PATTERN_NONE, ZR_PATTERN_CIRCLE, ZR_PATTERN_GRID };

enum { ZR_PATTERN_PLACES_MAX = 1024 };

struct zr_pattern {
    enum zr_pattern_kind kind;
    zr_dvec3 center;
    double diameter;    /* of a circle */
    uint32_t counts[2]; /* of a grid: the larger first */
    double pitch[2];    /* of a grid; 0 where the count is 1 */
};

/* Finds the pattern of places across an axis. `room` has as many points as there are places. */
struct zr_pattern zr_pattern_of(struct zr_feature_work *work, const zr_dvec3 *places, uint32_t count, zr_dvec3 axis,
                                double size, double (*room)[2]);

#endif
