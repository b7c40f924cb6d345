/* tunnels.h - mesh: tunnels through a closed surface, such as holes of any shape.
 *
 * Rule:   a connected surface with g tunnels has vertices - edges + triangles = 2 - 2 g. Each edge has two triangles. A
 *         place where several fans of triangles touch is a vertex for each of them.
 */
#ifndef ZR_TUNNELS_H
#define ZR_TUNNELS_H

#include "mesh/features/facets.h"

struct zr_tunnels {
    bool is_known; /* false: the surface is not closed, or there is no memory or step left */
    uint32_t count;
};

/* Counts the tunnels of all connected surfaces. */
struct zr_tunnels zr_tunnels_count(struct zr_arena *arena, struct zr_feature_work *work,
                                   const struct zr_facets *facets);

#endif
