/* surface.h - mesh: triangles of a part, in plain arrays, and the work that finding its features may take.
 *
 * Space:  any, in double precision. Places are relative to a place near the part.
 * Order:  seen from outside, corners turn left.
 */
#ifndef ZR_SURFACE_H
#define ZR_SURFACE_H

#include "base/cancel.h"
#include "base/dvec3.h"
#include "mesh/world_place.h"

struct zr_surface {
    const zr_dvec3 *places;
    const uint32_t (*corners)[3]; /* places; those of a triangle are distinct */
    uint32_t place_count, triangle_count;
    double size;  /* diagonal of the box */
    double noise; /* rounding errors of places, as a length */
};

/* Work is counted in steps of some 10 ns: visits of triangles, corners and facets. */
struct zr_feature_work {
    const struct zr_cancel *cancel;
    uint64_t steps, steps_most, next_look;
    bool is_stopped; /* cancelled, or too many steps */
};

enum { ZR_FEATURE_STEPS_PER_CANCEL_CHECK = 1 << 14 };

/* Counts steps. False if the work is stopped. */
static inline bool zr_feature_has_steps(struct zr_feature_work *work, uint64_t steps)
{
    work->steps += steps;
    if (work->steps > work->steps_most) work->is_stopped = true;
    if (work->steps >= work->next_look) {
        work->next_look = work->steps + ZR_FEATURE_STEPS_PER_CANCEL_CHECK;
        if (zr_is_cancelled(work->cancel)) work->is_stopped = true;
    }
    return !work->is_stopped;
}

#endif
