/* ring_area.h - mesh: areas of the rings of faces, as vectors, in object space and double precision. */
#ifndef ZR_RING_AREA_H
#define ZR_RING_AREA_H

#include "core.h"
#include "scene/scene.h"

/* The first corner of a ring, and twice the ring's area as a vector, in object space. */
struct zr_ring_area {
    double first[3], area[3];
};
struct zr_ring_area zr_ring_area_of(const struct zr_mesh *mesh, uint32_t begin, uint32_t end);

/* Returns true if two rings run in the same direction. */
static inline bool zr_ring_areas_agree(const struct zr_ring_area *a, const struct zr_ring_area *b)
{
    return (a->area[0] * b->area[0] + a->area[1] * b->area[1]) + a->area[2] * b->area[2] > 0.0;
}

#endif
