/* Hierarchies, counted and expanded. */
#include <math.h>

#include "base/cancel.h"
#include "scene/parts/nodes.h"
#include "support/random.h"
#include "support/tests.h"

enum { NONE = 999, NODES_MAX = 128, LONG = 100000 };

/* Nodes from a table: the mesh of each, or NONE, and its children up to NONE. */
struct tree {
    struct zr_arena arena;
    struct zr_node made[NODES_MAX];
    uint32_t children[2 * NODES_MAX];
    struct zr_nodes nodes;
};

static struct tree *tree_new(void)
{
    struct tree *tree = test_calloc(1, sizeof *tree);
    zr_arena_init(&tree->arena, (size_t)1 << 28);
    tree->nodes.nodes = tree->made;
    tree->nodes.children = tree->children;
    return tree;
}

static void tree_free(struct tree *tree)
{
    zr_arena_free(&tree->arena);
    test_free(tree);
}

static void add_node(struct tree *tree, uint32_t mesh, const uint32_t *children)
{
    struct zr_nodes *nodes = &tree->nodes;
    struct zr_node *node = &tree->made[nodes->count++];
    *node = (struct zr_node){zr_mat4_identity(), mesh == NONE ? ZR_NODE_NO_MESH : mesh, nodes->child_count, 0, NULL};
    for (; *children != NONE; children++, node->child_count++)
        tree->children[nodes->child_count++] = *children;
}

#define CHILDREN(...)                                                                                                  \
    (const uint32_t[])                                                                                                 \
    {                                                                                                                  \
        __VA_ARGS__                                                                                                    \
    }

static void shift(struct tree *tree, uint32_t node, float x)
{
    tree->made[node].local.m[12] = x;
}

static struct zr_placement place(struct tree *tree, uint32_t instances_max)
{
    struct zr_placement placement = zr_nodes_place(&tree->arena, &tree->nodes, instances_max, UINT64_MAX);
    assert_true(zr_arena_ok(&tree->arena));
    return placement;
}

TEST(nodes_are_placed_depth_first_in_listed_order)
{
    struct tree *tree = tree_new();
    add_node(tree, 0, CHILDREN(4, 2, NONE));
    add_node(tree, 1, CHILDREN(NONE)); /* a root, after the first one and all that is below it */
    add_node(tree, 2, CHILDREN(3, NONE));
    add_node(tree, 3, CHILDREN(NONE));
    add_node(tree, 4, CHILDREN(3, NONE)); /* the same child again */
    for (uint32_t i = 0; i < 5; i++)
        shift(tree, i, (float)(1u << i));
    struct zr_placement placement = place(tree, 6);
    const uint32_t meshes[6] = {0, 4, 3, 2, 3, 1};
    const float x[6] = {1, 17, 25, 5, 13, 2};
    assert_int_equal(placement.fault, ZR_NODES_GOOD);
    assert_int_equal(placement.count, 6);
    for (int i = 0; i < 6; i++) {
        assert_int_equal(placement.instances[i].mesh, meshes[i]);
        assert_true(placement.instances[i].object_to_world.m[12] == x[i]);
    }
    assert_int_equal(place(tree, 5).fault, ZR_NODES_TOO_MANY);
    tree_free(tree);
}

TEST(world_is_parent_times_local)
{
    struct tree *tree = tree_new();
    add_node(tree, NONE, CHILDREN(1, NONE));
    add_node(tree, 0, CHILDREN(NONE));
    /* A quarter turn about z, then a step along the turned x. */
    tree->made[0].local = (zr_mat4){{0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}};
    shift(tree, 1, 2);
    struct zr_placement placement = place(tree, 1);
    zr_vec4 p = zr_mat4_apply(&placement.instances[0].object_to_world, (zr_vec4){1, 0, 0, 1});
    assert_true(p.x == 5 && p.y == 3 && p.z == 0 && p.w == 1);
    tree_free(tree);
}

TEST(cycle_is_told_by_the_entry_that_closes_it)
{
    struct tree *tree = tree_new();
    add_node(tree, 0, CHILDREN(1, NONE));
    add_node(tree, NONE, CHILDREN(3, 2, NONE));
    add_node(tree, NONE, CHILDREN(3, 1, NONE));
    add_node(tree, NONE, CHILDREN(NONE));
    struct zr_placement placement = place(tree, 100);
    assert_int_equal(placement.fault, ZR_NODES_CYCLE);
    assert_int_equal(placement.node, 2);
    assert_int_equal(placement.child, 1);
    tree_free(tree);

    tree = tree_new(); /* a circle without a root */
    add_node(tree, 0, CHILDREN(1, NONE));
    add_node(tree, 0, CHILDREN(0, NONE));
    placement = place(tree, 100);
    assert_int_equal(placement.fault, ZR_NODES_CYCLE);
    assert_int_equal(placement.node, 1);
    tree_free(tree);

    tree = tree_new();
    add_node(tree, 0, CHILDREN(NONE));
    add_node(tree, 0, CHILDREN(0, 1, NONE)); /* itself */
    placement = place(tree, 100);
    assert_int_equal(placement.fault, ZR_NODES_CYCLE);
    assert_int_equal(placement.node, 1);
    assert_int_equal(placement.child, 1);
    tree_free(tree);
}

/* `levels` nodes, each the child of the one before, twice. */
static struct tree *doubling_chain(uint32_t levels, uint32_t mesh)
{
    struct tree *tree = tree_new();
    for (uint32_t i = 0; i < levels; i++)
        add_node(tree, NONE, CHILDREN(i + 1, i + 1, NONE));
    add_node(tree, mesh, CHILDREN(NONE));
    return tree;
}

TEST(doubling_chain_is_counted_without_being_walked)
{
    const uint32_t levels[] = {17, 40, 64, 100}; /* 2^64 and 2^100 are beyond the counter */
    for (size_t i = 0; i < sizeof levels / sizeof levels[0]; i++) {
        struct tree *tree = doubling_chain(levels[i], 0);
        assert_int_equal(place(tree, 100000).fault, ZR_NODES_TOO_MANY);
        assert_int_equal(place(tree, UINT32_MAX).fault, i == 0 ? ZR_NODES_GOOD : ZR_NODES_TOO_MANY);
        tree_free(tree);
    }
    struct tree *tree = doubling_chain(16, 0);
    struct zr_placement placement = place(tree, 1u << 16);
    assert_int_equal(placement.fault, ZR_NODES_GOOD);
    assert_int_equal(placement.count, 1u << 16);
    tree_free(tree);
}

TEST(paths_without_a_mesh_are_not_walked)
{
    struct tree *tree = doubling_chain(100, NONE);
    add_node(tree, 7, CHILDREN(0, NONE));
    struct zr_placement placement = place(tree, 1);
    assert_int_equal(placement.fault, ZR_NODES_GOOD);
    assert_int_equal(placement.count, 1);
    assert_int_equal(placement.instances[0].mesh, 7);
    tree_free(tree);
}

TEST(matrix_out_of_range_names_the_node_that_leaves_it)
{
    struct tree *tree = tree_new();
    add_node(tree, NONE, CHILDREN(1, NONE));
    add_node(tree, NONE, CHILDREN(2, NONE));
    add_node(tree, 0, CHILDREN(NONE));
    for (uint32_t i = 0; i < 3; i++)
        tree->made[i].local.m[0] = 1e7f;
    struct zr_placement placement = place(tree, 10);
    assert_int_equal(placement.fault, ZR_NODES_OUT_OF_RANGE);
    assert_int_equal(placement.node, 2);
    tree->made[2].local.m[0] = NAN;
    assert_int_equal(place(tree, 10).node, 2);
    tree->made[2].mesh = ZR_NODE_NO_MESH; /* then nothing is drawn there */
    assert_int_equal(place(tree, 10).fault, ZR_NODES_GOOD);
    tree_free(tree);
}

/* Each node is the child of the one before it, and the last has a mesh; or the other way
 * round, so that what is below a node is done when that node is come to. */
static struct zr_placement place_chain(struct zr_arena *arena, uint32_t length, bool forward)
{
    struct zr_node *made = zr_arena_alloc(arena, length, sizeof *made);
    uint32_t *children = zr_arena_alloc(arena, length, sizeof *children), entries = 0;
    uint32_t last = forward ? length - 1 : 0;
    for (uint32_t i = 0; i < length; i++) {
        made[i] = (struct zr_node){zr_mat4_identity(), i == last ? 0 : ZR_NODE_NO_MESH, entries, i != last, NULL};
        if (i != last) children[entries++] = forward ? i + 1 : i - 1;
    }
    struct zr_nodes nodes = {length, entries, made, children, NULL};
    return zr_nodes_place(arena, &nodes, 10, UINT64_MAX);
}

/* 2 leaves below a chain of 100 nodes: 2 instances and 102 visits; below two such chains 4 and 204, and so on. */
TEST(shared_nodes_are_visited_once_for_each_way_and_no_more_than_the_limit)
{
    struct tree *tree = tree_new();
    add_node(tree, NONE, CHILDREN(1, 1, NONE));
    for (uint32_t i = 1; i <= 100; i++)
        add_node(tree, NONE, CHILDREN(i + 1, NONE));
    add_node(tree, 0, CHILDREN(NONE));
    add_node(tree, 0, CHILDREN(NONE)); /* alone */
    struct zr_placement placement = zr_nodes_place(&tree->arena, &tree->nodes, 10, 204);
    assert_int_equal(placement.fault, ZR_NODES_GOOD);
    assert_int_equal(placement.count, 3);
    assert_int_equal(placement.visits, 204);
    assert_int_equal(zr_nodes_place(&tree->arena, &tree->nodes, 10, 203).fault, ZR_NODES_TOO_MANY_VISITS);
    tree_free(tree);
}

/* By the instances that were placed until then, and not by a clock. */
TEST(placing_looks_at_the_flag)
{
    enum { CHAIN = 200, TIMES = 256 };
    struct zr_arena arena;
    zr_arena_init(&arena, (size_t)1 << 28);
    struct zr_node *made = zr_arena_alloc(&arena, CHAIN + 1, sizeof *made);
    uint32_t *children = zr_arena_alloc(&arena, TIMES + CHAIN, sizeof *children), entries = 0;
    assert_true(zr_arena_ok(&arena));
    for (uint32_t i = 0; i <= CHAIN; i++) {
        const uint32_t times = i == 0 ? TIMES : i < CHAIN;
        made[i] = (struct zr_node){zr_mat4_identity(), i == CHAIN ? 0 : ZR_NODE_NO_MESH, entries, times, NULL};
        for (uint32_t k = 0; k < times; k++)
            children[entries++] = i + 1;
    }
    const struct zr_nodes nodes = {CHAIN + 1, entries, made, children, NULL};
    assert_int_equal(zr_nodes_place(&arena, &nodes, TIMES, UINT64_MAX).count, TIMES);
    const struct zr_cancel cancel = {.raised = true};
    arena.cancel = &cancel;
    assert_true(zr_nodes_place(&arena, &nodes, TIMES, UINT64_MAX).count <= 4096 / CHAIN);
    zr_arena_free(&arena);
}

TEST(chain_is_placed_up_to_the_depth_limit)
{
    struct zr_arena arena;
    zr_arena_init(&arena, (size_t)1 << 28);
    for (int forward = 0; forward < 2; forward++) {
        struct zr_placement placement = place_chain(&arena, ZR_NODES_DEPTH_MAX, forward);
        assert_int_equal(placement.fault, ZR_NODES_GOOD);
        placement = place_chain(&arena, ZR_NODES_DEPTH_MAX + 1, forward);
        assert_int_equal(placement.fault, ZR_NODES_TOO_DEEP);
        assert_int_equal(placement.node, forward ? 0 : ZR_NODES_DEPTH_MAX);
        assert_int_equal(place_chain(&arena, LONG, forward).fault, ZR_NODES_TOO_DEEP);
    }
    zr_arena_free(&arena);
}

/* What zr_nodes_place must come to, by plain recursion. */
static void place_plainly(const struct zr_nodes *nodes, uint32_t number, zr_mat4 parent, struct zr_placement *out)
{
    const struct zr_node *node = &nodes->nodes[number];
    zr_mat4 world = zr_mat4_mul(&parent, &node->local);
    if (node->mesh != ZR_NODE_NO_MESH) out->instances[out->count++] = (struct zr_instance){node->mesh, world, NULL};
    for (uint32_t i = 0; i < node->child_count; i++)
        place_plainly(nodes, nodes->children[node->first_child + i], world, out);
}

/* Nodes in random order, each with children of higher rank only. */
static struct tree *random_tree(struct random *random)
{
    enum { COUNT = 12 };
    uint32_t number_of[COUNT], children[COUNT];
    struct tree *tree = tree_new();
    for (uint32_t i = 0; i < COUNT; i++) {
        uint32_t place_at = random_below(random, i + 1);
        if (place_at < i) number_of[i] = number_of[place_at];
        number_of[place_at] = i;
    }
    uint32_t rank_of[COUNT];
    for (uint32_t rank = 0; rank < COUNT; rank++)
        rank_of[number_of[rank]] = rank;
    for (uint32_t i = 0; i < COUNT; i++) {
        uint32_t count = 0, higher = COUNT - 1 - rank_of[i];
        while (higher > 0 && count < 3 && random_below(random, 3) > 0)
            children[count++] = number_of[rank_of[i] + 1 + random_below(random, higher)];
        children[count] = NONE;
        add_node(tree, random_below(random, 2) ? i : NONE, children);
        for (int k = 0; k < 16; k++)
            tree->made[i].local.m[k] = k % 4 == 3 ? k == 15 : (float)random_range(random, -2, 2);
    }
    return tree;
}

TEST(random_hierarchies_are_placed_as_by_plain_recursion)
{
    struct random random = random_seeded(5);
    uint32_t most = 0;
    for (int round = 0; round < 300; round++) {
        struct tree *tree = random_tree(&random);
        const struct zr_nodes *nodes = &tree->nodes;
        static struct zr_instance instances[20000];
        struct zr_placement want = {.instances = instances};
        for (uint32_t i = 0; i < nodes->count; i++) {
            bool is_child = false;
            for (uint32_t k = 0; k < nodes->child_count; k++)
                is_child = is_child || nodes->children[k] == i;
            if (!is_child) place_plainly(nodes, i, zr_mat4_identity(), &want);
        }
        struct zr_placement got = place(tree, want.count);
        assert_int_equal(got.fault, ZR_NODES_GOOD);
        assert_int_equal(got.count, want.count);
        for (uint32_t i = 0; i < want.count; i++) {
            assert_int_equal(got.instances[i].mesh, want.instances[i].mesh);
            for (int k = 0; k < 16; k++)
                assert_true(got.instances[i].object_to_world.m[k] == want.instances[i].object_to_world.m[k]);
        }
        if (want.count > 0) assert_int_equal(place(tree, want.count - 1).fault, ZR_NODES_TOO_MANY);
        if (want.count > most) most = want.count;
        tree_free(tree);
    }
    assert_true(most > 50);
}

TEST(every_memory_ceiling_fails_cleanly_or_places_all)
{
    struct tree *tree = doubling_chain(5, 0);
    int failures = 0, successes = 0;
    for (size_t ceiling = 0; ceiling < 8192; ceiling += 64) {
        struct zr_arena arena;
        zr_arena_init(&arena, ceiling);
        struct zr_placement placement = zr_nodes_place(&arena, &tree->nodes, 100, UINT64_MAX);
        if (zr_arena_ok(&arena)) {
            assert_int_equal(placement.count, 32);
            successes++;
        } else {
            assert_int_equal(successes, 0);
            failures++;
        }
        zr_arena_free(&arena);
    }
    assert_true(failures > 10 && successes > 10);
    tree_free(tree);
}

RUN_TESTS(NULL, NULL)
