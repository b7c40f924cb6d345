/* place.h - geometry: one triangle between vertices in the window -> primitives.
 *
 * Drops what is outside, clips what sticks out, and drops what has no area or is turned away.
 */
#ifndef ZR_PLACE_H
#define ZR_PLACE_H

#include "geometry/builder.h"

/* True where a triangle in the window is narrower than a sixty-fourth of a pixel, or is so on the snapped grid. */
bool zr_place_is_thin(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1,
                      const struct zr_window_vertex *v2);

/* Places a triangle of a face by its slots in the mesh under way, or up to ZR_CLIP_MAX pieces of it. Failure is the
 * arena's. */
void zr_place_triangle(struct zr_builder *builder, const uint32_t slots[3], const struct zr_common *common);

#endif
