/* nocs.h - shade: normalized object coordinates (NOCS) of a mesh: object space with the mesh's box in the unit cube.
 *
 *     coordinate = (point - middle of the box) / diagonal of the box + 0.5
 *
 * The box holds all positions of the mesh, those of hidden parts included. A section leaves it as it is. If the
 * diagonal is 0, as that of a single point, all coordinates are 0.5.
 * Exact:  in double.
 */
#ifndef ZR_NOCS_H
#define ZR_NOCS_H

#include "base/arena.h"
#include "base/cancel.h"
#include "scene/scene.h"

struct zr_nocs {
    double middle[3], per_unit; /* coordinate = (point - middle) * per_unit + 0.5 */
};

/* The boxes of all meshes of a scene. */
struct zr_nocs_list {
    const struct zr_mesh *meshes;
    const struct zr_nocs *each; /* per mesh */
};

/* Finds the boxes of all placed meshes. Visits each of their positions. NULL without memory, or if cancelled. */
const struct zr_nocs_list *zr_nocs_make(struct zr_arena *arena, const struct zr_scene *scene,
                                        const struct zr_cancel *cancel);

/* Returns coordinate `k` of a point in object space. `mesh` is one of list->meshes. */
static inline double zr_nocs_of(const struct zr_nocs_list *list, const struct zr_mesh *mesh, double point, int k)
{
    const struct zr_nocs *nocs = &list->each[mesh - list->meshes];
    return (point - nocs->middle[k]) * nocs->per_unit + 0.5;
}

#endif
