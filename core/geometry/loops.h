/* loops.h - geometry: the rings of a face become loops that have its inside on their left.
 *
 * Space:  the plane of two of the object's axes, in double; u turns to v as ring 0 does.
 * Why:    ears are cut from one loop at a time. A hole is sewn to the ring around it by a bridge,
 *         an edge there and back; a ring inside of nothing is a loop of its own. Which of the two it is
 *         is told by parity, so that an island in a hole is one as well.
 * Source: Eberly, "Triangulation by Ear Clipping".
 */
#ifndef ZR_LOOPS_H
#define ZR_LOOPS_H

#include <stdint.h>

#include "base/cancel.h"
#include "base/vec.h"

/* A corner of a loop; corners at the ends of a bridge are there more than once. */
struct zr_loop_corner {
    double u, v;
    uint32_t corner, previous, next;
    bool joined;  /* part of a loop: not of a ring that is still to come */
    bool done;    /* cut off already, or in no loop at all */
    bool blocked; /* known to be no ear */
};

struct zr_loops {
    struct zr_loop_corner *nodes;
    uint32_t *rightmost; /* scratch: one node for each ring */
    uint32_t node_count;
    uint64_t visits;                /* nodes looked at: what the work is measured by */
    const struct zr_cancel *cancel; /* or NULL; raised, what is made of the loops is worth nothing */
    uint64_t next_look;             /* at `cancel`, by `visits` */
};

/* Whether it is time to stop: looks once in some hundred thousand visits, a millisecond. */
bool zr_loops_stopped(struct zr_loops *loops, uint64_t visits);

/* Twice the area of a, b, c: positive where they turn to the left. */
static inline double zr_loop_corner_turn(const struct zr_loop_corner *a, const struct zr_loop_corner *b,
                                         const struct zr_loop_corner *c)
{
    return (b->u - a->u) * (c->v - a->v) - (b->v - a->v) * (c->u - a->u);
}

/* Positive where the way from a over b to c goes on, negative where it goes back. */
static inline double zr_loop_corner_along(const struct zr_loop_corner *a, const struct zr_loop_corner *b,
                                          const struct zr_loop_corner *c)
{
    return (b->u - a->u) * (c->u - b->u) + (b->v - a->v) * (c->v - b->v);
}

static inline bool zr_loop_corner_is_at(const struct zr_loop_corner *a, const struct zr_loop_corner *b)
{
    return a->u == b->u && a->v == b->v;
}

/* The axes, 0 to 2, that become u and v: the two that the Newell normal of ring 0 is most square to.
 * False where a corner is at infinity or behind the eye (w <= 0) or not finite, and where no ring has an area. */
bool zr_loops_axes(const zr_vec4 *points, const uint32_t *ring_offsets, uint32_t rings, int axes[2]);

/* Fills `loops`, whose arrays have room for corners + 2 * (rings - 1) nodes and for all rings.
 * Rings of fewer than 3 corners are left out. */
void zr_loops_join(struct zr_loops *loops, const zr_vec4 *points, const uint32_t *ring_offsets, uint32_t rings,
                   const int axes[2]);

#endif
