/* nodes.h - scene: flattens a hierarchy of nodes into instances.
 *
 * Space:  a node's matrix maps its own space to its parent's; object to world is parent · local from the root down, in
 *         floats and in rule 1's order.
 * Order:  depth first, a node before its children, roots and children in their order in the lists.
 * Limits: nodes may share children, so that a short file can describe an exponential number of instances. They are
 *         counted first, and an excess is refused before the first instance is made. Only nodes above a mesh are
 *         visited. The code uses no recursion.
 */
#ifndef ZR_NODES_H
#define ZR_NODES_H

#include "base/arena.h"
#include "base/matrix.h"
#include "scene/scene.h"

#define ZR_NODE_NO_MESH UINT32_MAX

/* Levels from a root down to a mesh, both included. */
enum { ZR_NODES_DEPTH_MAX = 256 };

/* A visit is one node on one path from a root to a mesh, and costs one product of matrices. Without shared nodes, there
 * is at most one visit per node. The limit of visits is this number per instance of the limit, plus the number of
 * nodes. */
enum { ZR_NODE_VISITS_PER_INSTANCE = 32 };

struct zr_node {
    zr_mat4 local;                     /* to the parent's space; entries within ZR_MATRIX_MAX */
    uint32_t mesh;                     /* or ZR_NODE_NO_MESH */
    uint32_t first_child, child_count; /* in zr_nodes.children */
    const char *name;                  /* copied to its instances; may be NULL */
};

/* Every child is below `count`. A node without a parent is a root. */
struct zr_nodes {
    uint32_t count, child_count;
    const struct zr_node *nodes;
    const uint32_t *children;
    const struct zr_matrix *exact; /* one per node: its local matrix in double; NULL: none */
};

enum zr_nodes_fault {
    ZR_NODES_GOOD,
    ZR_NODES_CYCLE,           /* entry `child` of the children of `node` is `node` or one of its ancestors */
    ZR_NODES_TOO_DEEP,        /* `node` and the levels below it are more than ZR_NODES_DEPTH_MAX */
    ZR_NODES_TOO_MANY,        /* more instances than the limit */
    ZR_NODES_TOO_MANY_VISITS, /* more visits than the limit */
    ZR_NODES_OUT_OF_RANGE     /* the matrix of `node` in world space is beyond ZR_MATRIX_MAX */
};

struct zr_placement {
    enum zr_nodes_fault fault;
    uint32_t node, child;
    uint32_t count;                /* instances */
    uint64_t visits;               /* saturates */
    struct zr_instance *instances; /* in the arena, with room for one more at the end */
    struct zr_matrix *exact;       /* if the nodes have them: one per instance, object to world in double */
};

/* Places all instances, or reports a fault. Check zr_arena_ok afterwards. Time is linear in nodes, child entries and
 * visits. If arena->cancel is raised, returns soon with part of the instances. */
struct zr_placement zr_nodes_place(struct zr_arena *arena, const struct zr_nodes *nodes, uint32_t instances_max,
                                   uint64_t visits_max);

#endif
