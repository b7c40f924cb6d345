/* hidden_surface.h - raster, the whole floor: primitives -> visibility, by the algorithm that the scene names. */
#ifndef ZR_HIDDEN_SURFACE_H
#define ZR_HIDDEN_SURFACE_H

#include "base/team.h"
#include "raster/prepaint.h"
#include "raster/visibility.h"

/* Decides the geometry's window by the algorithm, or prepares to. payloads: one per draw, for ZR_ALGORITHM_HALFSPACE
 * alone; NULL: none. listed: the modes whose fragments will be asked for. `base` may be NULL. Points into the arena, to
 * the geometry, the payloads and the base. ZR_OK, ZR_CANCELLED, ZR_NO_MEMORY, ZR_BAD_SCENE beyond the painter's limit of
 * work, or ZR_INTERNAL if an algorithm finds itself wrong. */
enum zr_status zr_visibility_make(struct zr_arena *arena, struct zr_team *team, const struct zr_geometry *geometry,
                                  enum zr_algorithm algorithm, const struct zr_prepaint *payloads,
                                  const bool listed[ZR_ALPHA_COUNT], const struct zr_base *base,
                                  const struct zr_cancel *cancel, const struct zr_visibility **visibility);

#endif
