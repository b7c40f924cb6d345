#include "geometry/triangulate.h"

#include <string.h>

typedef struct zr_loop_corner node;

/* State of the face while triangles are cut from it. */
struct cutter {
    struct zr_loops *loops;
    node *nodes;
    uint32_t left; /* remaining nodes of the loop */
    uint32_t (*out)[3];
    uint32_t count;
    uint64_t visits;
};

enum { TRIANGLE = 3 };

/* ---- sizes ---- */

uint32_t zr_triangulate_nodes_max(uint32_t corners, uint32_t rings)
{
    uint64_t nodes = corners + 2 * (uint64_t)(rings > 0 ? rings - 1 : 0);
    return nodes < UINT32_MAX ? (uint32_t)nodes : UINT32_MAX;
}

uint32_t zr_triangulate_count_max(uint32_t corners, uint32_t rings)
{
    uint32_t nodes = zr_triangulate_nodes_max(corners, rings);
    return nodes > 2 ? nodes - 2 : 0;
}

/* Returns a capacity of at least `wanted`, at least doubled, so that gradually growing faces do not fill the arena. */
static uint32_t grown(uint32_t capacity, uint32_t wanted)
{
    return capacity > wanted / 2 && capacity <= UINT32_MAX / 2 ? 2 * capacity : wanted;
}

bool zr_triangulator_reserve(struct zr_arena *arena, struct zr_triangulator *scratch, uint32_t corners, uint32_t rings)
{
    uint32_t nodes = zr_triangulate_nodes_max(corners, rings);
    if (nodes > scratch->node_capacity) {
        nodes = grown(scratch->node_capacity, nodes);
        scratch->loops.nodes = zr_arena_alloc(arena, nodes, sizeof *scratch->loops.nodes);
        scratch->node_capacity = scratch->loops.nodes ? nodes : 0;
    }
    if (rings > scratch->ring_capacity) {
        rings = grown(scratch->ring_capacity, rings);
        scratch->loops.rightmost = zr_arena_alloc(arena, rings, sizeof *scratch->loops.rightmost);
        scratch->ring_capacity = scratch->loops.rightmost ? rings : 0;
    }
    return zr_arena_ok(arena);
}

/* ---- ears ---- */

/* Cuts corner b off. Nodes that are the same corner, at the ends of a bridge, give no triangle: its edges cancel. */
static void cut(struct cutter *t, uint32_t b)
{
    node *nodes = t->nodes, *at = &nodes[b];
    uint32_t a = at->previous, c = at->next;
    uint32_t i = nodes[a].corner, j = at->corner, k = nodes[c].corner;
    bool left = zr_loop_corner_turn(&nodes[a], at, &nodes[c]) >= 0.0;
    if (i != j && j != k && k != i)
        memcpy(t->out[t->count++], (uint32_t[3]){i, left ? j : k, left ? k : j}, sizeof *t->out);
    at->done = true;
    t->left--;
    nodes[a].next = c;
    nodes[c].previous = a;
    nodes[a].blocked = nodes[c].blocked = false;
}

/* Returns true if an edge leads from p, which has the position of `at`, into the angle from b to c. */
static bool enters(const node *nodes, const node *p, const node *at, const node *b, const node *c)
{
    const node *previous = &nodes[p->previous], *next = &nodes[p->next];
    return (zr_loop_corner_turn(at, b, previous) > 0.0 && zr_loop_corner_turn(at, previous, c) > 0.0) ||
           (zr_loop_corner_turn(at, b, next) > 0.0 && zr_loop_corner_turn(at, next, c) > 0.0);
}

/* Returns true if p, which is in the triangle's bounding box, prevents the ear. Among corners inside it or on its
 * edges, only those that turn right, or do not turn, can: a corner that turns left touches it from outside. */
static bool is_in_the_way(const node *nodes, const node *p, const node *a, const node *b, const node *c)
{
    if (zr_loop_corner_turn(a, b, p) < 0.0 || zr_loop_corner_turn(b, c, p) < 0.0 || zr_loop_corner_turn(c, a, p) < 0.0)
        return false;
    if (zr_loop_corner_is_at(p, a)) return enters(nodes, p, a, b, c);
    if (zr_loop_corner_is_at(p, b)) return enters(nodes, p, b, c, a);
    if (zr_loop_corner_is_at(p, c)) return enters(nodes, p, c, a, b);
    return zr_loop_corner_turn(&nodes[p->previous], p, &nodes[p->next]) <= 0.0;
}

/* Returns true if the path turns back on itself at the corner, or has no length there: cutting it off loses no area. A
 * spike that points outwards must be cut at once, so that none of its sides counts as the side of an ear. */
static bool is_spike(const node *nodes, uint32_t at)
{
    const node *b = &nodes[at], *a = &nodes[b->previous], *c = &nodes[b->next];
    return zr_loop_corner_turn(a, b, c) == 0.0 && zr_loop_corner_along(a, b, c) <= 0.0;
}

static bool is_ear(struct cutter *t, uint32_t at)
{
    const node *nodes = t->nodes, *b = &nodes[at], *a = &nodes[b->previous], *c = &nodes[b->next];
    if (!(zr_loop_corner_turn(a, b, c) > 0.0)) return is_spike(nodes, at);
    double u0 = a->u < b->u ? a->u : b->u, u1 = a->u > b->u ? a->u : b->u;
    double v0 = a->v < b->v ? a->v : b->v, v1 = a->v > b->v ? a->v : b->v;
    u0 = c->u < u0 ? c->u : u0;
    u1 = c->u > u1 ? c->u : u1;
    v0 = c->v < v0 ? c->v : v0;
    v1 = c->v > v1 ? c->v : v1;
    for (const node *p = &nodes[c->next]; p != a; p = &nodes[p->next]) {
        t->visits++;
        if (p->u < u0 || p->u > u1 || p->v < v0 || p->v > v1) continue;
        if (is_in_the_way(nodes, p, a, b, c)) return false;
    }
    return true;
}

/* Used if no ear is left: returns the corner with the smallest triangle, which may be straight. */
static uint32_t least_bad(struct cutter *t, uint32_t at)
{
    double smallest = (double)INFINITY;
    uint32_t best = at, i = at;
    do {
        const node *b = &t->nodes[i];
        double area = fabs(zr_loop_corner_turn(&t->nodes[b->previous], b, &t->nodes[b->next]));
        if (area < smallest) {
            best = i;
            smallest = area;
        }
        t->visits++;
        i = b->next;
    } while (i != at);
    return best;
}

/* Returns the corner at which to continue after the corner between a and c was cut: it skips one, so that the ears do
 * not form a fan. */
static uint32_t after_cut(const node *nodes, uint32_t a, uint32_t c)
{
    return is_spike(nodes, a) ? a : is_spike(nodes, c) ? c : nodes[c].next;
}

/* Cuts ears around the loop. A corner that is no ear is not tested again until a neighbour is cut: this is exact if
 * edges do not cross; if they do, testing again has not improved results. */
static void cut_loop(struct cutter *t, uint32_t at)
{
    node *nodes = t->nodes;
    t->left = 1;
    for (uint32_t i = nodes[at].next; i != at; i = nodes[i].next)
        t->left++;
    uint32_t missed = 0;
    while (t->left > TRIANGLE) {
        if (zr_loops_stopped(t->loops, ++t->visits)) return;
        if (nodes[at].blocked || !is_ear(t, at)) {
            nodes[at].blocked = true;
            at = nodes[at].next;
            if (++missed < t->left) continue;
            at = least_bad(t, at);
        }
        uint32_t a = nodes[at].previous, c = nodes[at].next;
        cut(t, at);
        at = after_cut(nodes, a, c);
        missed = 0;
    }
    cut(t, at);
    nodes[nodes[at].previous].done = nodes[nodes[at].next].done = true;
}

/* ---- the face ---- */

static uint32_t cut_into_fans(const uint32_t *ring_offsets, uint32_t rings, uint32_t (*out)[3])
{
    uint32_t count = 0;
    for (uint32_t r = 0; r < rings; r++)
        for (uint32_t i = ring_offsets[r] + 2; i < ring_offsets[r + 1]; i++)
            memcpy(out[count++], (uint32_t[3]){i - 1, i, ring_offsets[r]}, sizeof *out);
    return count;
}

uint32_t zr_triangulate(struct zr_triangulator *scratch, const zr_vec4 *points, const uint32_t *ring_offsets,
                        uint32_t rings, uint32_t (*out)[3])
{
    int axes[2];
    struct zr_loops *loops = &scratch->loops;
    loops->visits = loops->next_look = 0;
    if (!zr_loops_axes(points, ring_offsets, rings, axes)) return cut_into_fans(ring_offsets, rings, out);
    zr_loops_join(loops, points, ring_offsets, rings, axes);
    struct cutter cutter = {.loops = loops, .nodes = loops->nodes, .out = out, .visits = loops->visits};
    for (uint32_t i = 0; i < loops->node_count && !zr_is_cancelled(loops->cancel); i++)
        if (!loops->nodes[i].done) cut_loop(&cutter, i);
    loops->visits = cutter.visits;
    return zr_is_cancelled(loops->cancel) ? 0 : cutter.count;
}
