/* triangulate.h - geometry: cuts a face of any shape into triangles between its own corners.
 *
 * Space:  object space; homogeneous points are divided by w, in double.
 * Why:    coverage is decided elsewhere, by the parity (odd-even) of the face's edges on the subpixel grid. The
 *         triangles only select the plane of depth and colour for a covered sample, so a poor one bends colours and
 *         never coverage.
 *
 * For all rings:
 *   - counted modulo 2, the edges of the triangles are those of the rings (as pairs of corners):
 *     every diagonal cancels, and the parity of the triangles is that of the rings;
 *   - each triangle turns as ring 0 does, or has no area (as projected and computed in double);
 *   - the work is bounded: at most ZR_TRIANGULATE_VISITS times the square of zr_triangulate_nodes_max
 *     corners are visited; there is no recursion.
 * Rings that do not touch or cross, with any nesting, give a true triangulation of the interior by parity: triangles do
 * not overlap, and their areas sum up to its area. So does a hole that touches the ring around it in corners. If
 * several holes touch each other (seldom), or edges cross, triangles may overlap.
 *
 * Exact:  the predicates are sums and products of differences in double. For float32 coordinates the differences are
 *         exact unless exponents are more than 29 apart. Products may round, and may then misclassify an almost
 *         straight corner, which moves a sliver. Ties go to the lower corner, and no libm is called: the same triangles
 *         on every machine.
 * Source: Meisters, "Polygons have ears", 1975; Held, "FIST", 2001, for loops without an ear. Not libtess2 (Debian has
 *         it only as a part of Tulip) or GLU: they create corners where edges cross, which have no attributes of their
 *         own and would move the edges on the subpixel grid. */
#ifndef ZR_TRIANGULATE_H
#define ZR_TRIANGULATE_H

#include <stdint.h>

#include "base/arena.h"
#include "geometry/loops.h"

enum { ZR_TRIANGULATE_VISITS = 5 };

/* Scratch, reused by later calls. Initially all zero; used by one thread. */
struct zr_triangulator {
    struct zr_loops loops; /* loops.visits: corners visited by the last call */
    uint32_t node_capacity, ring_capacity;
};

/* Returns the number of nodes: the corners, and both ends of a bridge from each hole. Saturates at UINT32_MAX. */
uint32_t zr_triangulate_nodes_max(uint32_t corners, uint32_t rings);

/* Returns the maximum number of triangles of a face: corners + 2 * (rings - 1) - 2, or 0. */
uint32_t zr_triangulate_count_max(uint32_t corners, uint32_t rings);

/* Ensures room for faces of `corners` corners in `rings` rings; never shrinks. Takes the scratch from the arena;
 * returns false if that failed. */
bool zr_triangulator_reserve(struct zr_arena *arena, struct zr_triangulator *scratch, uint32_t corners, uint32_t rings);

/* Writes triples of corners to `out`, which has room for zr_triangulate_count_max, and returns their number; 0 if
 * scratch->loops.cancel is raised. Ring r of `rings` (at least 1) has the corners ring_offsets[r] to ring_offsets[r +
 * 1] - 1, in either direction; offsets never decrease, and the first may be greater than 0. Ring 0 defines the plane
 * (its Newell normal) and the side that triangles face; nesting alone decides the interior. Rings of fewer than 3
 * corners are ignored. Each ring becomes the fan (i - 1, i, first), as with GL_POLYGON, if zr_loops_axes fails: for
 * corners at infinity, behind the eye (w <= 0) or not finite, and for rings without area. `scratch` must have been
 * reserved for the face. Corners may repeat a position but not a number. */
uint32_t zr_triangulate(struct zr_triangulator *scratch, const zr_vec4 *points, const uint32_t *ring_offsets,
                        uint32_t rings, uint32_t (*out)[3]);

#endif
