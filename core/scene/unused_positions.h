/* unused_positions.h - scene: moves positions that no face, line or point uses onto a used one.
 *
 * Why:    exporters leave such positions behind, and they would enlarge bounds and fitted views.
 */
#ifndef ZR_UNUSED_POSITIONS_H
#define ZR_UNUSED_POSITIONS_H

#include "base/arena.h"
#include "base/team.h"
#include "scene/scene.h"

/* Returns one byte per position: 1 if a face, line or point uses it, else 0. NULL if the arena failed, or possibly for
 * a mesh without positions. `team` may be NULL. */
const uint8_t *zr_used_positions(struct zr_arena *arena, struct zr_team *team, const struct zr_mesh *mesh);

/* Moves unused `positions` of the mesh to the first used one. Does nothing if none is used. Takes a byte per position
 * from the arena temporarily; does nothing if that fails. `team` may be NULL. */
void zr_unused_positions_move(struct zr_arena *arena, struct zr_team *team, const struct zr_mesh *mesh,
                              zr_vec4 *positions);

#endif
