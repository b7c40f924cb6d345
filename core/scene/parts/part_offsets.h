/* part_offsets.h - scene: computes the offsets of parts in an exploded view.
 *
 * Rule:   a part moves by `explode` times the vector from the middle of all parts to its own middle, or by one
 *         component of this vector. A middle is the centre of a bounding box in world space. Hidden parts count, so
 *         hiding a part moves no other part.
 */
#ifndef ZR_PART_OFFSETS_H
#define ZR_PART_OFFSETS_H

#include "base/arena.h"
#include "scene/parts/part_list.h"

struct zr_part_offset {
    double by[3]; /* world space; 0 for a part without finite points */
};

/* Computes the offset of each part of the list, which has all parts. The result is in the arena. NULL without memory,
 * or if arena->cancel is raised. Sets *moves to false if no part moves. */
const struct zr_part_offset *zr_part_offsets_find(struct zr_arena *arena, const struct zr_scene *scene,
                                                  const struct zr_part_list *list, bool *moves);

#endif
