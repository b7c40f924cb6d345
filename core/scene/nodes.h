/* nodes.h - scene: a hierarchy of nodes -> the instances that it places.
 *
 * Space:  a node's matrix leads from its own space to its parent's; object to world is
 *         parent · local from the root down, in floats and in rule 1's order.
 * Order:  depth first, a node before its children, roots and children as they are listed.
 * Why counted first: a node may be the child of several others, so that a few lines can
 *         stand for more instances than there are atoms. All of them are counted, and
 *         refused where they are too many, before the first is made; and only nodes that
 *         lead to a mesh are visited. Nothing here recurs.
 */
#ifndef ZR_NODES_H
#define ZR_NODES_H

#include "base/arena.h"
#include "scene/scene.h"

#define ZR_NODE_NO_MESH UINT32_MAX

/* Nodes from a root down to a mesh. */
enum { ZR_NODES_DEPTH_MAX = 256 };

/* A visit is one node on one way from a root to a mesh, for which one matrix is multiplied. A hierarchy without shared
 * nodes has as many as nodes; one with shared nodes has up to so many for each instance of the limit, and as many as
 * nodes. */
enum { ZR_NODES_VISITS_AN_INSTANCE = 32 };

struct zr_node {
    zr_mat4 local;                     /* to the parent's space; entries within ZR_MATRIX_MAX */
    uint32_t mesh;                     /* or ZR_NODE_NO_MESH */
    uint32_t first_child, child_count; /* in zr_nodes.children */
    const char *name;                  /* for the instances that it places; may be NULL */
};

/* Every child is below `count`. A node that is nobody's child is a root. */
struct zr_nodes {
    uint32_t count, child_count;
    const struct zr_node *nodes;
    const uint32_t *children;
};

enum zr_nodes_fault {
    ZR_NODES_GOOD,
    ZR_NODES_CYCLE,    /* entry `child` of the children of `node` leads back to one of its ancestors, or itself */
    ZR_NODES_TOO_DEEP, /* below `node` there are more levels than ZR_NODES_DEPTH_MAX, itself counted */
    ZR_NODES_TOO_MANY, /* more instances than the limit */
    ZR_NODES_TOO_MANY_VISITS, /* more visits than the limit */
    ZR_NODES_OUT_OF_RANGE     /* the matrix of `node` in world space is beyond ZR_MATRIX_MAX */
};

struct zr_placement {
    enum zr_nodes_fault fault;
    uint32_t node, child;
    uint32_t count;                /* of instances */
    uint64_t visits;               /* of nodes; saturates */
    struct zr_instance *instances; /* with room for one more behind them */
};

/* Everything points into the arena; check zr_arena_ok afterwards. Takes time for every node, every child entry, and
 * every visit. Once arena->cancel is raised, it ends soon, with some of the instances. */
struct zr_placement zr_nodes_place(struct zr_arena *arena, const struct zr_nodes *nodes, uint32_t instances_max,
                                   uint64_t visits_max);

#endif
