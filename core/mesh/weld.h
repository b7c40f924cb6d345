/* weld.h - mesh: finds the positions of a mesh that form one vertex.
 *
 * Space:  object space.
 * Why:    STL repeats the corners of each triangle, and OBJ and glTF repeat those along seams.
 * Rule:   a grid divides space into cells of sixteen tolerances. A position joins the first earlier one in its cell
 *         that is no farther away than the tolerance. The first position of a vertex, if it is that near to a border of
 *         its cell, joins the earliest such position across the border.
 * Exact:  the same numbers for all instruction sets and numbers of threads. */
#ifndef ZR_WELD_H
#define ZR_WELD_H

#include "base/team.h"
#include "core.h"
#include "mesh/weld_input.h"

#define ZR_WELD_TOLERANCE 1e-6f /* relative to the diagonal */

enum { ZR_WELD_PARTS_MAX = 16 };

/* Size of the scratch, in words of 8 bytes: the slots of the tables, and half a word per position. */
static inline size_t zr_weld_slots(uint32_t positions)
{
    return 2 * (size_t)positions + ZR_WELD_PARTS_MAX;
}

static inline size_t zr_weld_room(uint32_t positions)
{
    return zr_weld_slots(positions) + ((size_t)positions + 1) / 2;
}

/* Sets vertices[p] to the vertex of position p: 0 .. count - 1, in the order of their first positions. Returns the
 * count; input->count means that all positions are distinct and vertices[p] is p. `room` has zr_weld_room words of
 * scratch. If cancelled, may return 0 early. */
uint32_t zr_weld_make(struct zr_team *team, const struct zr_cancel *cancel, const struct zr_weld_input *input,
                      uint64_t *room, uint32_t *vertices);

struct zr_weld_grid {
    zr_vec3 low;
    float cells_per_unit;
};

enum { ZR_WELD_CELL_TOLERANCES = 16, ZR_WELD_CELLS_MOST = 1 << 18 };

/* A position nearer to the centre of its cell than this, in cells, is farther from each border than the tolerance and
 * rounding errors. */
#define ZR_WELD_INNER (0.5f - 1.0f / ZR_WELD_CELL_TOLERANCES - 0.015f)

/* Writes the cell of each position, as zr_weld_hash, plus 1 if it is near a border. A kernel. */
typedef void zr_weld_cells_fn(const zr_vec4 *positions, size_t count, const struct zr_weld_grid *grid, uint32_t *cells);

ZR_KERNEL_TABLE(zr_weld_cells_fn, zr_weld_cells)

/* Returns an even hash. Source: the Murmur-like finalizer that Wellons found by search ("lowbias32", 2018). */
static inline uint32_t zr_weld_hash(int32_t x, int32_t y, int32_t z)
{
    uint32_t h = (uint32_t)x * 0x9e3779b1u + (uint32_t)y * 0x85ebca77u + (uint32_t)z * 0xc2b2ae3du;
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return (h ^ h >> 16) & ~1u;
}

#endif
