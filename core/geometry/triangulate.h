/* triangulate.h - geometry: cuts a face of any shape into triangles between its own corners.
 *
 * Space:  object space; homogeneous points are divided by w, in double.
 * Why:    what a face covers is decided elsewhere, by the parity (odd-even) of its edges on the
 *         subpixel grid. The triangles only say which plane of depth and colour a covered sample
 *         takes, so a poor one bends colours and never coverage.
 * Always, whatever the rings are:
 *         - counted modulo 2, the edges of the triangles are those of the rings (as pairs of corners):
 *           every diagonal cancels, and the parity of the triangles is that of the rings;
 *         - each triangle turns as ring 0 does, or has no area (as projected and computed in double);
 *         - the work is bounded: no more than ZR_TRIANGULATE_VISITS times the square of
 *           zr_triangulate_nodes_max is spent on looking at corners; there is no recursion.
 *         Rings that do not touch or cross, nested as they may be, give a true triangulation of what
 *         is inside by parity: no triangles overlap, their areas sum up to its area. So does a hole that
 *         touches the ring around it in corners; where several touch each other (seldom), and where
 *         edges cross, triangles may overlap.
 * Exact:  the predicates are sums and products of differences in double. For float32 coordinates the
 *         differences are exact unless exponents are more than 29 apart; products may round, and then a
 *         corner that is all but straight can be taken for the other kind: a sliver is cut otherwise.
 *         Ties go to the lower corner, no libm is called: the same triangles on every machine.
 * Source: Meisters, "Polygons have ears", 1975; Held, "FIST", 2001, for what to do when no ear is left.
 * Not libtess2 (Debian has it only as a part of Tulip) or GLU: they make new corners where edges cross, which
 *         have no attributes of their own and would move the edges on the subpixel grid.
 */
#ifndef ZR_TRIANGULATE_H
#define ZR_TRIANGULATE_H

#include <stdint.h>

#include "base/arena.h"
#include "geometry/loops.h"

enum { ZR_TRIANGULATE_VISITS = 5 };

/* Scratch, used again from call to call. All zero to begin with; one thread's. */
struct zr_triangulator {
    struct zr_loops loops; /* loops.visits: corners looked at by the last call */
    uint32_t node_capacity, ring_capacity;
};

/* Corners, and both ends of a bridge from each hole. Saturates at UINT32_MAX. */
uint32_t zr_triangulate_nodes_max(uint32_t corners, uint32_t rings);

/* Triangles that a face is cut into at most: corners + 2 * (rings - 1) - 2, or none. */
uint32_t zr_triangulate_count_max(uint32_t corners, uint32_t rings);

/* Room for faces of so many corners in so many rings; grows, never shrinks. False where the
 * arena, from which the scratch is taken, has failed. */
bool zr_triangulator_reserve(struct zr_arena *arena, struct zr_triangulator *scratch, uint32_t corners, uint32_t rings);

/* Ring r of `rings` (at least 1) has the corners ring_offsets[r] to ring_offsets[r + 1] - 1, in either direction;
 * offsets never fall, and the first need not be 0. Ring 0 gives the plane (its Newell normal) and the side that
 * triangles face; what is inside is told by nesting alone. Rings of fewer than 3 corners are left out. Where a corner
 * is at infinity or behind the eye (w <= 0) or not finite, and where no ring has an area, each ring becomes the fan (i
 * - 1, i, first), as with GL_POLYGON. Writes triples of corners to `out`, which has room for zr_triangulate_count_max,
 * and returns their number; none where scratch->loops.cancel is raised. `scratch` has been reserved for the face.
 * Corners may repeat a place, never a number. */
uint32_t zr_triangulate(struct zr_triangulator *scratch, const zr_vec4 *points, const uint32_t *ring_offsets,
                        uint32_t rings, uint32_t (*out)[3]);

#endif
