/* hidden_surface.h - raster: makes the visibility of a window by the scene's algorithm. */
#ifndef ZR_HIDDEN_SURFACE_H
#define ZR_HIDDEN_SURFACE_H

#include "base/team.h"
#include "raster/prepaint.h"
#include "raster/visibility.h"

/* Decides the visibility of the geometry's window, or prepares to decide it tile by tile. prepaints: one per draw, only
 * for ZR_ALGORITHM_HALFSPACE; NULL: none. listed: alpha modes whose fragments will be requested. `base` may be NULL.
 * *visibility points into the arena, to the geometry, the prepaints and the base. Returns ZR_OK, ZR_CANCELLED,
 * ZR_NO_MEMORY, ZR_BAD_SCENE beyond the painter's limit of work, or ZR_INTERNAL if an algorithm fails its own
 * checks. */
enum zr_status zr_visibility_make(struct zr_arena *arena, struct zr_team *team, const struct zr_geometry *geometry,
                                  enum zr_algorithm algorithm, const struct zr_prepaint *prepaints,
                                  const bool listed[ZR_ALPHA_COUNT], const struct zr_base *base,
                                  const struct zr_cancel *cancel, const struct zr_visibility **visibility);

#endif
