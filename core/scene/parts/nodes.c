#include "scene/parts/nodes.h"

#include "base/cancel.h"

/* About 0.1 ms of work. */
enum { VISITS_PER_CANCEL_CHECK = 4096 };

/* Counts of a node and the nodes below it, valid once DONE. */
struct tally {
    uint64_t instances; /* per visit, this node's own included; saturates */
    uint64_t visits;    /* of this node and nodes below it, per visit of this node; saturates */
    uint32_t height;    /* levels down from this node, itself included */
    uint32_t useful;    /* children with instances; they are the first entries of its part of placing.children */
    enum { UNSEEN, OPEN, DONE } state;
    bool is_child;
};

struct placing {
    const struct zr_nodes *nodes;
    const struct zr_cancel *cancel;
    uint32_t steps; /* visits and counted child entries */
    struct tally *tallies;
    uint32_t *children; /* laid out as nodes->children, but only children with instances */
    struct zr_placement *out;
};

static bool fail(struct placing *placing, enum zr_nodes_fault fault, uint32_t node, uint32_t child)
{
    placing->out->fault = fault;
    placing->out->node = node;
    placing->out->child = child;
    return false;
}

static bool is_stopped(struct placing *placing)
{
    return ++placing->steps % VISITS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(placing->cancel);
}

static uint64_t add_saturating(uint64_t a, uint64_t b)
{
    uint64_t sum;
    return __builtin_add_overflow(a, b, &sum) ? UINT64_MAX : sum;
}

/* ---- counting ---- */

/* Sums the counts of a node whose children are all DONE. False: too deep. */
static bool tally_up(struct placing *placing, uint32_t number)
{
    const struct zr_node *node = &placing->nodes->nodes[number];
    const uint32_t *children = placing->nodes->children + node->first_child;
    uint32_t *useful = placing->children + node->first_child;
    struct tally *tally = &placing->tallies[number];
    tally->state = DONE;
    tally->height = 1;
    tally->instances = node->mesh != ZR_NODE_NO_MESH;
    tally->visits = 1;
    for (uint32_t i = 0; i < node->child_count; i++) {
        const struct tally *child = &placing->tallies[children[i]];
        if (child->instances == 0) continue;
        useful[tally->useful++] = children[i];
        tally->instances = add_saturating(tally->instances, child->instances);
        tally->visits = add_saturating(tally->visits, child->visits);
        if (child->height >= tally->height) tally->height = child->height + 1;
    }
    return tally->height <= ZR_NODES_DEPTH_MAX || fail(placing, ZR_NODES_TOO_DEEP, number, 0);
}

/* An open node on the path, and its next child to count. */
struct link {
    uint32_t node, next_child;
};

/* Counts `start` and all nodes below it, children before parents. A child that is OPEN is an ancestor, which makes a
 * cycle. `path` has room for every node. */
static bool tally_below(struct placing *placing, uint32_t start, struct link *path)
{
    size_t depth = 0;
    path[depth++] = (struct link){start, 0};
    placing->tallies[start].state = OPEN;
    while (depth > 0) {
        struct link *link = &path[depth - 1];
        const struct zr_node *node = &placing->nodes->nodes[link->node];
        if (link->next_child == node->child_count) {
            if (!tally_up(placing, link->node)) return false;
            depth--;
            continue;
        }
        if (is_stopped(placing)) return false;
        uint32_t entry = link->next_child++, child = placing->nodes->children[node->first_child + entry];
        struct tally *tally = &placing->tallies[child];
        if (tally->state == OPEN) return fail(placing, ZR_NODES_CYCLE, link->node, entry);
        if (tally->state == DONE) continue;
        tally->state = OPEN;
        path[depth++] = (struct link){child, 0};
    }
    return true;
}

/* Counts from every node, not only from roots, since a cycle has no root. */
static bool tally_all(struct placing *placing, struct link *path, uint64_t *instances)
{
    const struct zr_nodes *nodes = placing->nodes;
    for (uint32_t i = 0; i < nodes->count; i++)
        for (uint32_t k = 0; k < nodes->nodes[i].child_count; k++)
            placing->tallies[nodes->children[nodes->nodes[i].first_child + k]].is_child = true;
    *instances = 0;
    for (uint32_t i = 0; i < nodes->count; i++) {
        const struct tally *tally = &placing->tallies[i];
        if (tally->state == UNSEEN && !tally_below(placing, i, path)) return false;
        if (tally->is_child) continue;
        *instances = add_saturating(*instances, tally->instances);
        if (tally->instances > 0) placing->out->visits = add_saturating(placing->out->visits, tally->visits);
    }
    return true;
}

/* ---- placing ---- */

/* A node on the path from a root, and its matrix in this visit. */
struct step {
    uint32_t node, next_child;
    zr_mat4 world;
    struct zr_matrix exact; /* set if the nodes have them */
};

/* Appends a node to the path and places its mesh, if it has one. */
static bool enter(struct placing *placing, struct step *path, size_t depth, uint32_t number)
{
    const struct zr_node *node = &placing->nodes->nodes[number];
    struct zr_placement *out = placing->out;
    struct step *step = &path[depth];
    step->node = number;
    step->next_child = 0;
    step->world = node->local;
    if (placing->nodes->exact) step->exact = placing->nodes->exact[number];
    if (depth > 0) step->world = zr_mat4_mul(&path[depth - 1].world, &node->local);
    if (depth > 0 && out->exact) step->exact = zr_matrix_mul(&path[depth - 1].exact, &step->exact);
    if (!zr_mat4_is_within(&step->world, ZR_MATRIX_MAX)) return fail(placing, ZR_NODES_OUT_OF_RANGE, number, 0);
    if (node->mesh != ZR_NODE_NO_MESH && out->exact) out->exact[out->count] = step->exact;
    if (node->mesh != ZR_NODE_NO_MESH)
        out->instances[out->count++] = (struct zr_instance){node->mesh, step->world, node->name};
    return true;
}

static bool place_below(struct placing *placing, uint32_t root)
{
    struct step path[ZR_NODES_DEPTH_MAX];
    size_t depth = 0;
    if (!enter(placing, path, depth++, root)) return false;
    while (depth > 0) {
        struct step *step = &path[depth - 1];
        if (step->next_child == placing->tallies[step->node].useful) {
            depth--;
            continue;
        }
        uint32_t child = placing->children[placing->nodes->nodes[step->node].first_child + step->next_child++];
        if (is_stopped(placing) || !enter(placing, path, depth++, child)) return false;
    }
    return true;
}

struct zr_placement zr_nodes_place(struct zr_arena *arena, const struct zr_nodes *nodes, uint32_t instances_max,
                                   uint64_t visits_max)
{
    struct zr_placement out = {.fault = ZR_NODES_GOOD};
    struct placing placing = {.nodes = nodes,
                              .cancel = arena->cancel,
                              .tallies = zr_arena_zero(arena, nodes->count, sizeof *placing.tallies),
                              .children = zr_arena_alloc(arena, nodes->child_count, sizeof *placing.children),
                              .out = &out};
    struct link *path = zr_arena_alloc(arena, nodes->count, sizeof *path);
    uint64_t instances;
    if (!zr_arena_ok(arena) || !tally_all(&placing, path, &instances)) return out;
    if (instances > instances_max) {
        fail(&placing, ZR_NODES_TOO_MANY, 0, 0);
        return out;
    }
    if (out.visits > visits_max) {
        fail(&placing, ZR_NODES_TOO_MANY_VISITS, 0, 0);
        return out;
    }
    out.instances = zr_arena_alloc(arena, (size_t)instances + 1, sizeof *out.instances);
    if (nodes->exact) out.exact = zr_arena_alloc(arena, (size_t)instances + 1, sizeof *out.exact);
    if (!zr_arena_ok(arena)) return out;
    for (uint32_t i = 0; i < nodes->count; i++)
        if (!placing.tallies[i].is_child && placing.tallies[i].instances > 0 && !place_below(&placing, i)) break;
    return out;
}
