/* closed_parts.h - mesh: which parts of a mesh are closed surfaces.
 *
 * Rule:   a part is closed if each of its edges is used as often in one direction as in the other. That is once in a
 *         plain solid, and twice where solids touch along an edge. So each point has a winding number, and the part has
 *         a volume. Corners are welded first (weld.h). Edges without length, and rings with fewer than three vertices,
 *         do not count. Edges between two parts are open in both. A part without a counted edge is not closed.
 * Holes:  the rings of a face after its first one are holes. Each counts in the direction opposite to the first ring.
 *         Rings of caps count as they are.
 * Exact:  the same for all instruction sets and numbers of threads.
 */
#ifndef ZR_CLOSED_PARTS_H
#define ZR_CLOSED_PARTS_H

#include "base/arena.h"
#include "base/run.h"
#include "base/team.h"
#include "core.h"
#include "scene/scene.h"

struct zr_shells;

/* Sets closed[p] to 1 or 0 for each part; a mesh without face_parts has one. Counts the shells of each part
 * (mesh/facts/shells.h), unless `shells` is NULL. Takes about 28 bytes per position of scratch from the arena, or 8 per
 * corner and 8 per position, and 5 per face for shells, and gives them back. False without memory. If cancelled,
 * returns early with undefined values. */
bool zr_closed_parts_find(const struct zr_run *run, const struct zr_mesh *mesh, uint8_t *closed,
                          struct zr_shells *shells);

/* Returns true if a hole runs in the same direction as the first ring. Ring 0 is the first one. */
bool zr_ring_turns_as_first(const struct zr_mesh *mesh, const struct zr_rings *rings, uint32_t ring);

#endif
