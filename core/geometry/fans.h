/* fans.h - geometry: triangulates the convex polygons of a mesh as fans.
 *
 * A polygon becomes the fan (i - 1, i, 0), as GL_POLYGON does in the reference (rule 10); a triangle keeps its order.
 * Made once per mesh and shared by its instances. */
#ifndef ZR_FANS_H
#define ZR_FANS_H

#include "base/arena.h"
#include "base/cancel.h"
#include "base/run.h"
#include "base/team.h"
#include "scene/scene.h"

/* The triangles of face f begin at face_offsets[f] - 2 f. They are undefined if is_other[f]. */
struct zr_fans {
    const uint32_t *corners; /* positions, three per triangle; NULL: not made yet */
    const uint32_t *slots;   /* into mesh->indices, three per triangle */
    const uint32_t *faces;   /* one per triangle */
    const bool *is_other;    /* one per face: degenerate, or no convex polygon */
};

static inline uint32_t zr_fans_first(const struct zr_mesh *mesh, uint32_t face)
{
    return mesh->face_offsets[face] - 2 * face;
}

/* Fills `fans` in the arena, on the team's threads. Returns false if the arena failed. If cancelled, returns early, and
 * *fans must not be read. */
bool zr_fans_make(const struct zr_run *run, const struct zr_mesh *mesh, struct zr_fans *fans);

#endif
