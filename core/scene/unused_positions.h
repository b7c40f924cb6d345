/* unused_positions.h - scene: positions of a mesh that no face, line or point has.
 *
 * Why:    exporters leave such positions behind. A fit, bounds, and what is measured by them would otherwise hold them.
 */
#ifndef ZR_UNUSED_POSITIONS_H
#define ZR_UNUSED_POSITIONS_H

#include "base/arena.h"
#include "base/team.h"
#include "scene/scene.h"

/* Moves the unused of the mesh's `positions` to the first used one. Nothing changes where all are used, or none is. Takes
 * a byte a position from the arena meanwhile; does nothing where that has failed. `team` may be NULL. */
void zr_unused_positions_move(struct zr_arena *arena, struct zr_team *team, const struct zr_mesh *mesh,
                              zr_vec4 *positions);

#endif
