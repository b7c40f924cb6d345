/* place.h - geometry: one triangle between placed vertices -> records in the window.
 *
 * Drops what is outside, clips what sticks out, and drops what has no area or is turned away.
 */
#ifndef ZR_PLACE_H
#define ZR_PLACE_H

#include "geometry/builder.h"

/* The corners as positions of the mesh under way, and as colours of the geometry. */
struct zr_corners {
    uint32_t vertex[3], color[3];
};

/* What all triangles of a face have in common. */
struct zr_part {
    uint32_t face; /* id */
    bool double_sided;
    bool pushed;    /* back, to make room for an outline */
    uint32_t shape; /* 1 + number of the shape that the face is, or 0 */
    bool back;      /* of a shape: which side is seen; triangles by themselves tell by their winding */
    bool skip_thin; /* leave out what zr_place_is_thin says */
};

/* True where a triangle in the window is narrower than a sixty-fourth of a pixel, or is so on the snapped grid. */
bool zr_place_is_thin(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1,
                      const struct zr_window_vertex *v2);

/* Appends up to ZR_CLIP_MAX records. Failure is the arena's. */
void zr_place_triangle(struct zr_builder *builder, const struct zr_corners *corners, const struct zr_part *part);

#endif
