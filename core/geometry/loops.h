/* loops.h - geometry: joins the rings of a face into loops with the interior on the left.
 *
 * Space:  the plane of two object axes, in double; u turns to v as ring 0 does.
 * Why:    ear clipping works on one loop at a time. A bridge, an edge there and back, connects a hole with the ring
 *         around it. A ring that lies in no other is a loop of its own. Parity tells holes from islands, so an island
 *         in a hole is a loop as well.
 * Source: Eberly, "Triangulation by Ear Clipping". */
#ifndef ZR_LOOPS_H
#define ZR_LOOPS_H

#include <stdint.h>

#include "base/cancel.h"
#include "base/vec.h"

/* A corner of a loop; bridges repeat the corners at their ends. */
struct zr_loop_corner {
    double u, v;
    uint32_t corner, previous, next;
    bool joined;  /* part of a loop; false for rings not yet processed */
    bool done;    /* already cut off, or in no loop */
    bool blocked; /* tested and no ear */
};

struct zr_loops {
    struct zr_loop_corner *nodes;
    uint32_t *rightmost; /* scratch: one node per ring */
    uint32_t node_count;
    uint64_t visits;                /* nodes visited: the measure of work */
    const struct zr_cancel *cancel; /* or NULL; if raised, the loops are unusable */
    uint64_t next_look;             /* value of `visits` at the next check of `cancel` */
};

/* Returns true if the work is cancelled. Checks once per some hundred thousand visits, about a millisecond. */
bool zr_loops_stopped(struct zr_loops *loops, uint64_t visits);

/* Returns twice the signed area of a, b, c: positive for a left turn. */
static inline double zr_loop_corner_turn(const struct zr_loop_corner *a, const struct zr_loop_corner *b,
                                         const struct zr_loop_corner *c)
{
    return (b->u - a->u) * (c->v - a->v) - (b->v - a->v) * (c->u - a->u);
}

/* Returns a positive number if the path a, b, c continues forward at b, and a negative one if it turns back. */
static inline double zr_loop_corner_along(const struct zr_loop_corner *a, const struct zr_loop_corner *b,
                                          const struct zr_loop_corner *c)
{
    return (b->u - a->u) * (c->u - b->u) + (b->v - a->v) * (c->v - b->v);
}

static inline bool zr_loop_corner_is_at(const struct zr_loop_corner *a, const struct zr_loop_corner *b)
{
    return a->u == b->u && a->v == b->v;
}

/* Chooses the object axes (0 to 2) that become u and v: the coordinate plane most parallel to ring 0. Returns false if
 * a corner is at infinity, behind the eye (w <= 0) or not finite, or if no ring has an area. */
bool zr_loops_axes(const zr_vec4 *points, const uint32_t *ring_offsets, uint32_t rings, int axes[2]);

/* Fills `loops`, whose arrays have room for corners + 2 * (rings - 1) nodes and for all rings. Rings of fewer than 3
 * corners are ignored. */
void zr_loops_join(struct zr_loops *loops, const zr_vec4 *points, const uint32_t *ring_offsets, uint32_t rings,
                   const int axes[2]);

#endif
