/* solid.h - measure: the faces of a scene as triangles in double precision, and facts about what they enclose.
 *
 * Space:     that of the file: axes as its bytes give them, and the origin that its reader subtracted is added again.
 *            So two files compare by their numbers, whichever of their axes points up.
 * Triangles: concave faces and those with holes are triangulated, others are fans (mesh/edge_mesh.h). Faces of mirrored
 *            instances are turned, so that they look outwards. Faces that are hidden or have a corner beyond the range
 *            of float are left out, and so are lines and points.
 * Closed:    each edge of the welded triangles is used as often in one direction as in the other. Meshes and parts do
 *            not matter: a surface may be cut into several.
 * Volume:    the sum of pyramids over the triangles: exact if no shells overlap (measure/volumes.h finds out).
 * Exact:     the same for all instruction sets and numbers of threads.
 */
#ifndef ZR_SOLID_H
#define ZR_SOLID_H

#include "base/run.h"
#include "base/status.h"
#include "mesh/world_place.h"
#include "scene/scene.h"

struct zr_solid {
    uint32_t place_count;
    struct zr_world_place *places; /* relative to `middle` */
    uint32_t count;
    const uint32_t (*corners)[3];  /* places of each triangle, counter-clockwise seen from outside */
    const uint32_t (*vertices)[3]; /* welded ones, below vertex_count */
    uint32_t vertex_count;
    const uint32_t *parts;        /* per triangle: number in the scene's list of parts (scene/parts/part_list.h) */
    const uint8_t *tags;          /* per triangle: in place of the cosine in lists of rays; NULL: none */
    struct zr_world_place middle; /* in the file */
    double min[3], max[3];        /* of all triangles, relative to `middle` */
    double diagonal;              /* 0: no triangle, or all corners at one place */
    double area, volume;          /* volume: negative if the faces look inwards; of a closed solid */
    bool is_closed;
    uint32_t odd_edges;             /* used more often in one direction: a closed solid has none */
    uint32_t outward, inward, open; /* connected surfaces: with positive and negative volume, and not closed */
    bool has_handles;               /* closed, and each edge has two triangles */
    int64_t handles;                /* number of tunnels: the sum of genus */
};

/* Makes the solid in the arena. Places are relative to `middle`, or to that of the box if it is NULL. Takes scratch
 * from the arena and gives it back. The team may be NULL. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_solid_make(const struct zr_run *run, const struct zr_scene *scene,
                             const struct zr_world_place *middle, struct zr_solid *out);

/* Returns the corners of a triangle, relative to solid->middle. */
static inline void zr_solid_places(const struct zr_solid *solid, uint32_t triangle, struct zr_world_place out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = solid->places[solid->corners[triangle][k]];
}

#endif
