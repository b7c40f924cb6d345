/* least_wall.h - mesh: the least wall of a closed part between parallel faces.
 *
 * Space:  world space, in double precision. `step`: a millionth of the diagonal of the part's box, as in
 * closed_parts.h, or the precision of float at its farthest coordinate if that is more. Lengths up to it are 0. Wall:
 * two triangles with opposite normals (to ZR_WALL_TILT) that face away from each other, further apart than a step.
 * Projected along the normal, they overlap in an area wider than a step. Along a line through it, all is inside the
 * part from one to the other, and the outside is before and behind: by winding numbers, so faces within other shells of
 * the part, and faces of shells that touch, are no ends of a wall. The wall is the distance of the planes, at the
 * thinnest place of the overlap. Tilt:   a tenth of a degree is less than the draft of moulded walls, from a quarter of
 * a degree on, which are wedges, and more than the rounding of float positions turns a facet whose height is over a
 * thousandth of the largest coordinate's 4096th part. Lines:  the overlap is probed along up to 1 + 3 ZR_WALL_CORNERS
 * lines. A pair of triangles whose wall is open to none of them, because something else lies between, is passed over.
 * Work:   counted in steps: visits of boxes and tests of triangles. If the caller's steps do not suffice, such as for
 *         thousands of faces at the same place, or a line crosses the part more than ZR_WALL_CROSSINGS times within a
 *         wall, there is no result.
 * Exact:  one thread, in a fixed order.
 */
#ifndef ZR_LEAST_WALL_H
#define ZR_LEAST_WALL_H

#include "mesh/wall_tree.h"

enum { ZR_WALL_CORNERS = 6, ZR_WALL_CROSSINGS = 512 };

/* Length of the sum of two opposite unit normals: 0.1 degrees. */
#define ZR_WALL_TILT 1.7453292e-3f

struct zr_least_wall {
    bool is_found, is_omitted; /* omitted: too much work, or no memory for it; then not found */
    double thickness;
};

/* Finds the least wall of a closed part, in at most `steps` steps, which are used up. Takes scratch from the arena and
 * gives it back. Returns early if cancelled. */
struct zr_least_wall zr_least_wall_find(struct zr_arena *arena, const struct zr_cancel *cancel,
                                        const struct zr_wall_faces *faces, uint64_t *steps);

#endif
