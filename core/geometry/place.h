/* place.h - geometry: turns one triangle of window vertices into primitives.
 *
 * Clips a triangle that crosses the view volume; drops one that is outside, without area, or culled. */
#ifndef ZR_PLACE_H
#define ZR_PLACE_H

#include "geometry/builder.h"

/* Returns true if a window triangle is narrower than 1/64 pixel, before or after snapping. */
bool zr_place_is_thin(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1,
                      const struct zr_window_vertex *v2);

/* Appends a triangle, given by its slots in the current mesh, or up to ZR_CLIP_MAX pieces of it. On failure, the arena
 * has failed. */
void zr_place_triangle(struct zr_builder *builder, const uint32_t slots[3], const struct zr_common *common);

#endif
