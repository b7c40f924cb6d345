/* part_offsets.h - scene: how far each part moves in an exploded view.
 *
 * Rule:   a part moves by `factor` times the offset of its middle from the middle of all parts, or by one component of
 *         that. A middle is that of a box in world space. Hidden parts count, so that hiding one moves no other.
 */
#ifndef ZR_PART_OFFSETS_H
#define ZR_PART_OFFSETS_H

#include "base/arena.h"
#include "scene/part_list.h"

struct zr_part_offset {
    double by[3]; /* world space; 0 for a part without finite points */
};

/* Computes the offset of each part of the list, which holds all parts. `offsets` is in the arena; NULL without memory,
 * or if arena->cancel is raised. *moves: false if no part moves. */
const struct zr_part_offset *zr_part_offsets_find(struct zr_arena *arena, const struct zr_scene *scene,
                                                  const struct zr_part_list *list, bool *moves);

#endif
