/* least_wall.h - mesh: the least wall of a closed part between parallel faces.
 *
 * Space:  world space, in double precision. A step is a millionth of the diagonal of the part's box, as in
 *         closed_parts.h, or the precision of float at its farthest coordinate if that is more.
 * Wall:   two triangles with opposite normals, to ZR_WALL_TILT, that face away from each other, further apart than a
 *         step. Projected along the normal, they overlap in an area wider than a step. Along a line through it, all
 *         is inside the part from one to the other, and the outside is before and behind. Winding numbers decide, so
 *         faces within other shells of the part, or where shells touch, end no wall. The wall is the distance of the
 *         planes at the thinnest place of the overlap.
 * Tilt:   a tenth of a degree is less than the draft of moulded walls, from a quarter of a degree on, which are
 *         wedges. It is more than rounding to float turns facets longer than 1e-4 of their coordinates.
 * Lines:  the overlap is probed along up to 1 + 3 * 6 lines. A pair that is no wall on any of them, because something
 *         lies between, is passed over. If the first line is none, the triangles that the others may cross are listed
 *         once, unless they are many. Parts with ribs then take half to a fifth of the steps.
 * Best:   gains below 1e-6 of the wall plus a tenth of a step are not sought.
 * Work:   counted in steps: visits of boxes and tests of triangles, some 15 ns each. If the caller's steps do not
 *         suffice, such as for thousands of turned faces at the same place, or a line crosses a wall more than
 *         ZR_WALL_CROSSINGS times (wall_lines.h), there is no result.
 * Exact:  one thread, in a fixed order, without libm but for sqrt.
 */
#ifndef ZR_LEAST_WALL_H
#define ZR_LEAST_WALL_H

#include "mesh/facts/wall_tree.h"

/* Length of the sum of two opposite unit normals: 0.1 degrees. */
#define ZR_WALL_TILT 1.7453292e-3f

struct zr_least_wall {
    bool is_found, is_omitted; /* omitted: too much work, or no memory for it; then not found */
    double thickness;
    double at[3]; /* world space: a place in the middle of it */
};

/* Finds the least wall of a closed part, in at most `steps` steps, which are used up. Takes scratch from the arena and
 * gives it back. Returns early if cancelled. */
struct zr_least_wall zr_least_wall_find(struct zr_arena *arena, const struct zr_cancel *cancel,
                                        const struct zr_wall_faces *faces, uint64_t *steps);

#endif
