/* section_planes.h - sections: resolves the planes of a section.
 *
 * Space:  world space, in double.
 */
#ifndef ZR_SECTION_PLANES_H
#define ZR_SECTION_PLANES_H

#include "scene/camera/resolved_view.h"
#include "scene/section.h"

/* A point x is kept if n.x + offset > 0; the normal has unit length. */
struct zr_section_plane {
    double normal[3], offset;
};

struct zr_section_planes {
    uint32_t count;
    struct zr_section_plane at[ZR_SECTION_PLANES_MAX];
};

/* Resolves fractions by the bounds of the resolved view, and the far side by its camera. Fails with ZR_BAD_SCENE, and
 * the JSON Pointer of the plane, if a plane lies beside the whole scene, or is to keep its far side and is seen
 * edge-on. */
enum zr_status zr_section_planes_find(const struct zr_scene *scene, const struct zr_resolved_view *resolved,
                                      struct zr_section_planes *planes, struct zr_error *error);

#endif
