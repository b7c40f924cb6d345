/* place.h - geometry: one triangle between placed vertices -> records in the window.
 *
 * Drops what is outside, clips what sticks out, and drops what has no area or is turned away.
 */
#ifndef ZR_PLACE_H
#define ZR_PLACE_H

#include "geometry/builder.h"

/* The corners as positions of the mesh under way, and as colours and normals of the geometry; normals are 0 where
 * nothing needs them. */
struct zr_corners {
    uint32_t vertex[3], color[3], normal[3];
};

/* What all triangles of a face have in common. */
struct zr_part {
    uint32_t face; /* id */
    const struct zr_material *material;
    bool double_sided;
    bool pushed;    /* back, to make room for an outline */
    uint32_t shape; /* 1 + number of the shape that the face is, or 0 */
    bool back;      /* of a shape: which side is seen; triangles by themselves tell by their winding */
    bool skip_thin; /* leave out what zr_place_is_thin says */
};

/* Those of a face, by their slots in its mesh; zr_builder_own_colors has been called for it. False where the arena has
 * failed. */
bool zr_corners_make(struct zr_builder *builder, uint32_t face, bool smooth, const uint32_t slots[3],
                     const struct zr_part *part, struct zr_corners *out);

/* True where a triangle in the window is narrower than a sixty-fourth of a pixel, or is so on the snapped grid. */
bool zr_place_is_thin(const struct zr_window_vertex *v0, const struct zr_window_vertex *v1,
                      const struct zr_window_vertex *v2);

/* Appends up to ZR_CLIP_MAX records. Failure is the arena's. */
void zr_place_triangle(struct zr_builder *builder, const struct zr_corners *corners, const struct zr_part *part);

#endif
