/* unused_positions.h - scene: positions that no drawn face, line or point uses.
 *
 * Why:    exporters leave such positions behind, and they would enlarge bounds and fitted views.
 */
#ifndef ZR_UNUSED_POSITIONS_H
#define ZR_UNUSED_POSITIONS_H

#include "base/arena.h"
#include "base/team.h"
#include "scene/scene.h"

/* Returns one byte per position: 1 if a point or a face or line that is not degenerate uses it, else 0. Memory from the
 * arena; NULL if that fails. Needs valid indices. `team` may be NULL. */
uint8_t *zr_used_positions(struct zr_arena *arena, struct zr_team *team, const struct zr_mesh *mesh);

/* Moves unused `positions` of the mesh to the first used one. Does nothing if none is used. Takes a byte per position
 * from the arena temporarily; does nothing if that fails. `is_soup`: each position belongs to one face. */
void zr_unused_positions_move(struct zr_arena *arena, struct zr_team *team, const struct zr_mesh *mesh, bool is_soup,
                              zr_vec4 *positions);

#endif
