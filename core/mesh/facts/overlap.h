/* overlap.h - mesh: how much of a closed part's volume its shells count more than once, or against one another.
 *
 * Space:  world space, in double precision.
 * Rule:   inside is where the winding number w is not 0, as in caps. The sum of pyramids over the faces (part_facts.h)
 *         is the integral of w. The excess is the integral of w - 1 where w > 0, and of w + 1 where w < 0 and no place
 *         of the part has w > 0: such a part is inside out, and its volume stays negative. In any other part, places
 *         with w < 0 count as 1. The sum less the excess is the volume, and exact where there is no excess.
 * Rays:   a quick grid in one direction finds whether there is an excess. Finer grids in three oblique directions at
 *         right angles, along which no faces of usual models line up, measure it; the result is their mean. A ray
 *         crosses either both triangles of an edge or none: rows and columns are decided from the edge alone.
 * Thin:   intervals whose thickness is at most a millionth of the diagonal do not count: shells that touch.
 * Error:  the spread of the directions, and a fiftieth of the changes between neighbouring rays. It held for 4 x 48
 *         random pairs of solids; it is an estimate, not a bound.
 * Work:   rows and crossings of triangles, some 20 ns each. A grid that exceeds that of its box, or the memory left, is
 *         made coarser.
 * Exact:  one thread, in a fixed order, without libm but for sqrt.
 */
#ifndef ZR_OVERLAP_H
#define ZR_OVERLAP_H

#include "mesh/facts/wall_tree.h"

/* Parts of fewer faces have no overlap: a closed surface of fewer is a tetrahedron. */
enum { ZR_OVERLAP_FACES_LEAST = 6 };

struct zr_overlap {
    bool is_found;
    double volume, error; /* excess; `error` is that of its volume */
    double moment[3];     /* of the excess, around the apex */
};

/* The box of a part, the place around which its moments are taken, and the work of each of its grids. */
struct zr_overlap_box {
    double min[3], max[3];
    struct zr_world_place apex;
    uint64_t work;
};

/* Measures the excess of a closed part. Takes scratch from the arena and gives it back. False
 * without memory, or if cancelled. */
bool zr_overlap_find(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_wall_faces *faces,
                     const struct zr_overlap_box *box, struct zr_overlap *out);

#endif
