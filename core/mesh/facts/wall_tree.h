/* wall_tree.h - mesh: the triangles of a solid in trees of boxes, for mesh/facts/least_wall.c and
 * mesh/facts/wall_lines.c.
 *
 * Space:  world space, in double precision.
 * Trees:  two over the same triangles. `along` has them in the order of cells of their normals, then of cells of space;
 *         it finds triangles of a given normal. `around` has them in the order of cells of space; it finds those on a
 *         line. A tree is a heap: the children of node i are 2 i and 2 i + 1; leaf k is node leaf_count + k.
 */
#ifndef ZR_WALL_TREE_H
#define ZR_WALL_TREE_H

#include "base/arena.h"
#include "base/cancel.h"
#include "mesh/world_place.h"
#include "scene/scene.h"

enum { ZR_WALL_LEAF = 8 };

struct zr_wall_box {
    double min[3], max[3];
    float low[3], high[3]; /* of the unit normals */
};

struct zr_wall_tree {
    const uint32_t *order; /* triangles; leaf k has ZR_WALL_LEAF of them from ZR_WALL_LEAF k on */
    const struct zr_wall_box *boxes;
};

/* Faces of a part: faces[begin .. end - 1], or the numbers themselves if `faces` is NULL. */
struct zr_wall_faces {
    const struct zr_mesh *mesh;
    const zr_mat4 *object_to_world;
    const uint32_t *faces;
    uint32_t begin, end;
    bool is_turned; /* its faces are turned inside out in world space */
};

struct zr_wall_solid {
    const struct zr_mesh *mesh;
    const zr_mat4 *object_to_world;
    uint32_t count, leaf_count;   /* 0: no triangle with an area */
    const uint32_t (*corners)[3]; /* positions; seen from outside, they turn left */
    const float (*normals)[3];    /* unit length, outwards */
    struct zr_wall_tree along, around;
    struct zr_world_place origin; /* a corner of the part; boxes and corners are relative to it */
    double size;                  /* diagonal of the box */
    double step;                  /* lengths up to it are 0: a millionth of the size, or of the precision of float */
};

/* Returns the bytes of scratch that the solid takes. */
size_t zr_wall_solid_bytes(const struct zr_wall_faces *faces);

/* Makes the solid in the arena: the fans of all rings; holes are turned. Triangles without area are left out. False
 * without memory or if cancelled. */
bool zr_wall_solid_make(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_wall_faces *faces,
                        struct zr_wall_solid *out);

/* Returns the corners of a triangle, relative to the origin. */
void zr_wall_solid_places(const struct zr_wall_solid *solid, uint32_t triangle, struct zr_world_place out[3]);

#endif
