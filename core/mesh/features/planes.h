/* planes.h - mesh: the large flat faces of a surface.
 *
 * Rule:   facets (mesh/features/facets.h) with at least a hundredth of the area. Those in one plane, to a hundred
 *         thousandth of the size, count as one.
 */
#ifndef ZR_PLANES_H
#define ZR_PLANES_H

#include "mesh/features/facets.h"

enum { ZR_PLANES_MAX = 100 };

struct zr_plane {
    zr_dvec3 normal; /* unit length, outwards */
    double offset;   /* of the places p on it: normal . p */
    double area;
};

struct zr_planes {
    uint32_t count;
    const struct zr_plane *at; /* by area, the largest first */
};

/* Finds the planes, in the arena. False without memory or steps. */
bool zr_planes_find(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_facets *facets,
                    struct zr_planes *out);

#endif
