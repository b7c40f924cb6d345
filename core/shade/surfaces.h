/* surfaces.h - shade: the surfaces of a geometry's records. Those of large triangles come back row by row, block by
 * block, and tile by tile: the last ones are remembered.
 */
#ifndef ZR_SURFACES_H
#define ZR_SURFACES_H

#include <string.h>

#include "shade/paint.h"

enum { ZR_SURFACES = 64 };

struct zr_surfaces {
    const struct zr_geometry *geometry;
    zr_surface_fn *make;
    const struct zr_batch *batch; /* of the record that was asked for last; at first the first one */
    uint32_t owners[ZR_SURFACES]; /* whose the surfaces are; 0: nobody's */
    struct zr_surface surfaces[ZR_SURFACES];
};

static inline void zr_surfaces_begin(struct zr_surfaces *s, const struct zr_geometry *geometry, zr_surface_fn *make)
{
    s->geometry = geometry;
    s->make = make;
    s->batch = &geometry->batches[0];
    memset(s->owners, 0, sizeof s->owners);
}

static inline const struct zr_batch *zr_surfaces_batch(struct zr_surfaces *s, uint32_t owner)
{
    return s->batch = zr_batch_next(s->geometry, s->batch, owner - 1);
}

/* NULL where it is not remembered. */
static inline const struct zr_surface *zr_surfaces_known(const struct zr_surfaces *s, uint32_t owner)
{
    return s->owners[owner % ZR_SURFACES] == owner ? &s->surfaces[owner % ZR_SURFACES] : NULL;
}

static inline const struct zr_surface *zr_surfaces_of(struct zr_surfaces *s, uint32_t owner)
{
    const uint32_t place = owner % ZR_SURFACES;
    if (s->owners[place] != owner) {
        s->surfaces[place] = s->make(s->geometry, zr_surfaces_batch(s, owner), owner - 1);
        s->owners[place] = owner;
    }
    return &s->surfaces[place];
}

#endif
