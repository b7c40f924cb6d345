/* surface_tree.h - measure: the triangles of a solid in a tree of boxes: the nearest place on its surface, and whether
 * a place is inside.
 *
 * Space:   that of the solid's places, in double precision.
 * Tree:    a heap over leaves of triangles: the children of node i are 2 i and 2 i + 1. Each node divides its triangles
 *          at the median along the longest side of the box around their middles. Boxes are floats, rounded outwards.
 * Inside:  the winding number of a place: the crossings of one oblique ray. A ray crosses either both triangles of an
 *          edge or none, as in mesh/facts/ray_grid.h. So no normals of edges and corners are needed, and overlapping
 *          shells are right, too. Only closed solids have an inside.
 * Steps:   visits of boxes and tests of triangles are counted, so that callers can limit them.
 * Exact:   products, sums, quotients and square roots in a fixed order.
 */
#ifndef ZR_SURFACE_TREE_H
#define ZR_SURFACE_TREE_H

#include "measure/solid.h"

enum { ZR_SURFACE_LEAF = 4 };

struct zr_surface_box {
    float min[3], max[3];
};

struct zr_surface_face {
    struct zr_world_place at[3];
    struct zr_world_place normal; /* of its plane, unit length; 0 without an area */
    double offset;                /* along the normal */
    uint32_t triangle;
};

struct zr_surface_tree {
    const struct zr_solid *solid;
    const struct zr_cancel *cancel;      /* of the run; once it is raised, searches end early with any result */
    uint32_t leaf_count;                 /* 0: no triangles */
    const struct zr_surface_face *faces; /* leaf by leaf */
    const uint32_t *begins;              /* per leaf node - leaf_count: its first index into `faces` */
    const struct zr_surface_box *boxes;  /* per node; 1 is the root */
};

/* Makes the tree in the arena: about 130 bytes per triangle. Fails with ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_surface_tree_make(const struct zr_run *run, const struct zr_solid *solid,
                                    struct zr_surface_tree *out);

struct zr_surface_hit {
    uint32_t triangle;
    struct zr_world_place at;
    double square; /* of the distance */
};

/* Finds the nearest place. Searches on from *hit, whose triangle is a guess: that of a place nearby, or 0. If some
 * place is at most `enough` (a squared distance) away, any such place may be returned; negative: the nearest one. Adds
 * to *steps. The tree is not empty. */
void zr_surface_tree_nearest(const struct zr_surface_tree *tree, struct zr_world_place from, double enough,
                             struct zr_surface_hit *hit, uint64_t *steps);

/* Returns the winding number of a place. Adds to *steps. */
int zr_surface_tree_winding(const struct zr_surface_tree *tree, struct zr_world_place at, uint64_t *steps);

/* The same for a place at most `reach` away. Returns false, with *hit undefined but for its triangle, if there is
 * none. */
bool zr_surface_tree_within(const struct zr_surface_tree *tree, struct zr_world_place from, double reach,
                            struct zr_surface_hit *hit, uint64_t *steps);

/* A ball whose inside the surface does not meet: all of it has one winding number. */
struct zr_surface_ball {
    bool is_known; /* false: the rest is not set */
    struct zr_world_place at;
    double radius;
    int winding;
};

/* Returns the winding number of a place that no surface is nearer to than `distance`: that of the last ball if the
 * place lies in it, or its middle in the ball of the place; else the crossings on the way between both are added.
 * *last becomes the ball of the place, unless the surface is nearer than rounding errors. */
int zr_surface_tree_winding_beside(const struct zr_surface_tree *tree, struct zr_world_place at, double distance,
                                   struct zr_surface_ball *last, uint64_t *steps);

/* Returns the unit normal of a triangle; (0, 0, 0) without an area. */
struct zr_world_place zr_surface_normal(const struct zr_solid *solid, uint32_t triangle);

#endif
