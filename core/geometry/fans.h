/* fans.h - geometry: the convex polygons of a mesh -> triangles of a mesh.
 *
 * A polygon becomes the fan (i - 1, i, 0), as GL_POLYGON does in the reference (rule 10); a triangle keeps
 * its order. Made once for each mesh, however often it is placed.
 */
#ifndef ZR_FANS_H
#define ZR_FANS_H

#include "base/arena.h"
#include "base/cancel.h"
#include "base/team.h"
#include "scene/scene.h"

/* Triangles of face f begin at face_offsets[f] - 2 f: those of faces that are no fans are left undefined. */
struct zr_fans {
    const uint32_t *corners; /* three a triangle: positions; NULL: not made yet */
    const uint32_t *slots;   /* three a triangle, into mesh->indices */
    const uint32_t *faces;   /* one a triangle */
    const bool *is_other;    /* one a face: it is degenerate, or no convex polygon */
};

static inline uint32_t zr_fans_first(const struct zr_mesh *mesh, uint32_t face)
{
    return mesh->face_offsets[face] - 2 * face;
}

/* False where the arena has failed. Cancelled, it returns early, and *fans are not to be read. */
bool zr_fans_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                  const struct zr_mesh *mesh, struct zr_fans *fans);

#endif
