#include "measure/surface_tree.h"

#include "base/arena.h"
#include "base/cancel.h"
#include "base/team.h"
#include "mesh/facts/ray_grid.h"

enum {
    ROUNDS = 40, /* of selecting; a few are usual */
    RANGES_PER_LEVEL = 64,
    ITEMS_PER_RANGE = 1 << 12,
    LEAVES_PER_RANGE = 1 << 10,
    ITEMS_PER_CANCEL_CHECK = 1 << 14,
    DEPTH = 64,
    VISITS_PER_CANCEL_CHECK = 1 << 14
};

/* Share of the radius of a ball without surface that is free of rounding errors. */
#define SAFE 0.999999

/* Places nearer to the surface than this, relative to the diagonal, may be at its wrong side by rounding errors: no
 * others are decided by them. */
#define LEAST 1e-9

static bool is_due(const struct zr_run *run, size_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(run->cancel);
}

/* ---- making ---- */

/* A triangle while nodes are divided. */
struct item {
    float middle[3];
    uint32_t triangle;
};

struct making {
    const struct zr_run *run;
    struct zr_surface_tree *tree;
    struct item *items;
    uint32_t *begins;
    struct zr_surface_box *boxes;
    struct zr_surface_face *faces;
    uint32_t level;                /* first node of the level that is divided */
    uint32_t lowest_level, lowest; /* first node of the lowest level, and number of leaves there */
};

/* Leaves of the lowest level come first in the order of space. */
static uint32_t leaf_of_node(const struct making *m, uint32_t node)
{
    return node >= m->lowest_level ? node - m->lowest_level : node - m->tree->leaf_count + m->lowest;
}

static uint32_t node_of_leaf(const struct making *m, uint32_t leaf)
{
    return leaf < m->lowest ? m->lowest_level + leaf : m->tree->leaf_count + (leaf - m->lowest);
}

/* Returns the index of the first item below a node. */
static uint32_t begin_of(const struct making *m, uint32_t node)
{
    while (node < m->tree->leaf_count)
        node *= 2;
    return leaf_of_node(m, node) * ZR_SURFACE_LEAF;
}

/* Returns the index behind the last item below a node. */
static uint32_t end_of(const struct making *m, uint32_t node)
{
    while (node < m->tree->leaf_count)
        node = 2 * node + 1;
    const uint64_t end = ((uint64_t)leaf_of_node(m, node) + 1) * ZR_SURFACE_LEAF;
    return end < m->tree->solid->count ? (uint32_t)end : m->tree->solid->count;
}

static bool is_before(const struct item *a, const struct item *b, int axis)
{
    return a->middle[axis] < b->middle[axis] || (a->middle[axis] == b->middle[axis] && a->triangle < b->triangle);
}

static void swap(struct item *a, struct item *b)
{
    const struct item other = *a;
    *a = *b;
    *b = other;
}

/* Moves the items that come before the middle one of three behind `begin`. Returns the place of that one. */
static uint32_t divide(const struct making *m, uint32_t begin, uint32_t end, int axis)
{
    struct item *items = m->items, *first = &items[begin], *half = &items[begin + (end - begin) / 2],
                *last = &items[end - 1];
    if (is_before(half, first, axis)) swap(half, first);
    if (is_before(last, half, axis)) swap(last, half);
    if (is_before(half, first, axis)) swap(half, first);
    swap(half, last);
    uint32_t place = begin;
    for (uint32_t i = begin; i + 1 < end; i++) {
        if (is_due(m->run, i)) return begin;
        if (is_before(&items[i], last, axis)) swap(&items[i], &items[place++]);
    }
    swap(&items[place], last);
    return place;
}

/* Moves the items that come first along an axis before `middle`. After ROUNDS, some may be at the wrong side, which
 * costs time only. */
static void select_items(const struct making *m, uint32_t begin, uint32_t middle, uint32_t end, int axis)
{
    for (int round = 0; round < ROUNDS && end - begin > 1; round++) {
        const uint32_t place = divide(m, begin, end, axis);
        if (place == middle || zr_is_cancelled(m->run->cancel)) return;
        if (place < middle)
            begin = place + 1;
        else
            end = place;
    }
}

/* Divides the items of nodes along the longest side of the box around their middles. */
static void divide_nodes(void *context, size_t from, size_t to)
{
    const struct making *m = context;
    for (size_t node = from; node < to && !zr_is_cancelled(m->run->cancel); node++) {
        const uint32_t number = (uint32_t)node + m->level, begin = begin_of(m, number), end = end_of(m, number);
        float min[3] = {INFINITY, INFINITY, INFINITY}, max[3] = {-INFINITY, -INFINITY, -INFINITY};
        int axis = 0;
        for (uint32_t i = begin; i < end && !is_due(m->run, i); i++)
            for (int k = 0; k < 3; k++) {
                const float at = m->items[i].middle[k];
                if (at < min[k]) min[k] = at;
                if (at > max[k]) max[k] = at;
            }
        for (int k = 1; k < 3; k++)
            if (max[k] - min[k] > max[axis] - min[axis]) axis = k;
        select_items(m, begin, end_of(m, 2 * number), end, axis);
    }
}

static float rounded_down(double value)
{
    const float near = (float)value;
    return (double)near > value ? nextafterf(near, -INFINITY) : near;
}

static float rounded_up(double value)
{
    const float near = (float)value;
    return (double)near < value ? nextafterf(near, INFINITY) : near;
}

static void include(struct zr_surface_box *box, struct zr_world_place p)
{
    const double at[3] = {p.x, p.y, p.z};
    for (int k = 0; k < 3; k++) {
        const float low = rounded_down(at[k]), high = rounded_up(at[k]);
        if (low < box->min[k]) box->min[k] = low;
        if (high > box->max[k]) box->max[k] = high;
    }
}

static void join(struct zr_surface_box *box, const struct zr_surface_box *more)
{
    for (int k = 0; k < 3; k++) {
        if (more->min[k] < box->min[k]) box->min[k] = more->min[k];
        if (more->max[k] > box->max[k]) box->max[k] = more->max[k];
    }
}

static void put_items(void *context, size_t from, size_t to)
{
    const struct making *m = context;
    for (size_t i = from; i < to && !is_due(m->run, i); i++) {
        struct zr_world_place p[3];
        zr_solid_places(m->tree->solid, (uint32_t)i, p);
        m->items[i] =
            (struct item){{(float)((p[0].x + p[1].x + p[2].x) / 3.0), (float)((p[0].y + p[1].y + p[2].y) / 3.0),
                           (float)((p[0].z + p[1].z + p[2].z) / 3.0)},
                          (uint32_t)i};
    }
}

static void fill_leaves(void *context, size_t from, size_t to)
{
    const struct making *m = context;
    const struct zr_solid *solid = m->tree->solid;
    for (size_t leaf = from; leaf < to && !is_due(m->run, leaf); leaf++) {
        const uint32_t node = node_of_leaf(m, (uint32_t)leaf), begin = (uint32_t)leaf * ZR_SURFACE_LEAF;
        struct zr_surface_box *box = &m->boxes[node];
        m->begins[node - m->tree->leaf_count] = begin;
        *box = (struct zr_surface_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
        for (uint32_t i = begin; i < solid->count && i < begin + ZR_SURFACE_LEAF; i++) {
            struct zr_surface_face *face = &m->faces[i];
            face->triangle = m->items[i].triangle;
            zr_solid_places(solid, face->triangle, face->at);
            face->normal = zr_surface_normal(solid, face->triangle);
            face->offset = zr_world_place_dot(face->normal, face->at[0]);
            for (int k = 0; k < 3; k++)
                include(box, face->at[k]);
        }
    }
}

static void make(struct making *m)
{
    struct zr_team *team = m->run->team;
    const uint32_t leaves = m->tree->leaf_count;
    zr_team_ranges(team, m->tree->solid->count, ITEMS_PER_RANGE, put_items, m);
    for (m->level = 1; m->level < leaves && !zr_is_cancelled(m->run->cancel); m->level *= 2) {
        const uint32_t nodes = 2 * m->level <= leaves ? m->level : leaves - m->level;
        zr_team_ranges(team, nodes, 1 + nodes / RANGES_PER_LEVEL, divide_nodes, m);
    }
    zr_team_ranges(team, leaves, LEAVES_PER_RANGE, fill_leaves, m);
    for (uint32_t node = leaves; node-- > 1 && !is_due(m->run, node);) {
        m->boxes[node] = m->boxes[2 * node];
        join(&m->boxes[node], &m->boxes[2 * node + 1]);
    }
}

enum zr_status zr_surface_tree_make(const struct zr_run *run, const struct zr_solid *solid, struct zr_surface_tree *out)
{
    const uint32_t leaves = (uint32_t)(((uint64_t)solid->count + ZR_SURFACE_LEAF - 1) / ZR_SURFACE_LEAF);
    struct making m = {.run = run, .tree = out, .lowest_level = 1};
    m.faces = zr_arena_alloc(run->arena, solid->count, sizeof *m.faces);
    m.begins = zr_arena_alloc(run->arena, leaves, sizeof *m.begins);
    m.boxes = zr_arena_alloc(run->arena, 2 * (size_t)leaves, sizeof *m.boxes);
    *out = (struct zr_surface_tree){solid, run->cancel, leaves, m.faces, m.begins, m.boxes};
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    while (2 * (uint64_t)m.lowest_level <= 2 * (uint64_t)leaves - 1 && leaves > 0)
        m.lowest_level *= 2;
    m.lowest = 2 * leaves - m.lowest_level;
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    m.items = zr_arena_alloc(&scratch, solid->count, sizeof *m.items);
    if (m.items && leaves > 0) make(&m);
    zr_arena_close_scratch(&scratch, run->arena);
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : zr_arena_ok(run->arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* ---- nearest places ---- */

static struct zr_world_place along(struct zr_world_place from, struct zr_world_place step, double t)
{
    return (struct zr_world_place){from.x + step.x * t, from.y + step.y * t, from.z + step.z * t};
}

/* Returns the place of a triangle that is nearest to p.
 * Source: Ericson, "Real-Time Collision Detection", 2005, 5.1.5. */
static struct zr_world_place nearest_of(const struct zr_world_place t[3], struct zr_world_place p)
{
    const struct zr_world_place ab = zr_world_place_minus(t[1], t[0]), ac = zr_world_place_minus(t[2], t[0]),
                                ap = zr_world_place_minus(p, t[0]), bp = zr_world_place_minus(p, t[1]),
                                cp = zr_world_place_minus(p, t[2]);
    const double d1 = zr_world_place_dot(ab, ap), d2 = zr_world_place_dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) return t[0];
    const double d3 = zr_world_place_dot(ab, bp), d4 = zr_world_place_dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) return t[1];
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return along(t[0], ab, d1 / (d1 - d3));
    const double d5 = zr_world_place_dot(ab, cp), d6 = zr_world_place_dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) return t[2];
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return along(t[0], ac, d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
        return along(t[1], zr_world_place_minus(t[2], t[1]), (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double sum = va + vb + vc;
    if (!(sum > 0.0)) return t[0]; /* a sliver */
    return along(along(t[0], ab, vb / sum), ac, vc / sum);
}

static void look(const struct zr_world_place p[3], uint32_t triangle, struct zr_world_place from,
                 struct zr_surface_hit *hit)
{
    const struct zr_world_place at = nearest_of(p, from), to = zr_world_place_minus(from, at);
    const double square = zr_world_place_dot(to, to);
    if (square < hit->square) *hit = (struct zr_surface_hit){triangle, at, square};
}

/* Leaves add several visits at once. */
static bool is_ended(const struct zr_surface_tree *tree, uint64_t visits)
{
    return visits % VISITS_PER_CANCEL_CHECK < 1 + ZR_SURFACE_LEAF && zr_is_cancelled(tree->cancel);
}

static double square_of_box(const struct zr_surface_box *box, const double at[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        const double gap = zr_most_of(0.0, zr_most_of((double)box->min[k] - at[k], at[k] - (double)box->max[k]));
        sum += gap * gap;
    }
    return sum;
}

/* True if the plane of a face is at least as far as the nearest place so far. `slack`: more than the rounding errors. */
static bool is_plane_far(const struct zr_surface_face *face, struct zr_world_place from, double slack, double square)
{
    const double gap = fabs(zr_world_place_dot(face->normal, from) - face->offset) - slack;
    return gap > 0.0 && gap * gap >= square;
}

static void search(const struct zr_surface_tree *tree, struct zr_world_place from, double enough,
                   struct zr_surface_hit *hit, uint64_t *steps)
{
    const double at[3] = {from.x, from.y, from.z};
    struct {
        uint32_t node;
        double square;
    } stack[DEPTH] = {{1, 0.0}};
    uint64_t visits = 1;
    const double slack = 1e-14 * (tree->solid->diagonal + (fabs(from.x) + fabs(from.y) + fabs(from.z)));
    for (int depth = 1; depth > 0 && hit->square > enough && !is_ended(tree, visits); visits++) {
        const uint32_t node = stack[--depth].node;
        if (!(stack[depth].square < hit->square)) continue;
        if (node >= tree->leaf_count) {
            const uint32_t begin = tree->begins[node - tree->leaf_count];
            for (uint32_t i = begin; i < tree->solid->count && i < begin + ZR_SURFACE_LEAF; i++, visits++)
                if (!is_plane_far(&tree->faces[i], from, slack, hit->square))
                    look(tree->faces[i].at, tree->faces[i].triangle, from, hit);
            continue;
        }
        const double left = square_of_box(&tree->boxes[2 * node], at),
                     right = square_of_box(&tree->boxes[2 * node + 1], at);
        const uint32_t first = left <= right ? 2 * node : 2 * node + 1;
        if (zr_most_of(left, right) < hit->square) {
            stack[depth].node = first ^ 1u;
            stack[depth++].square = zr_most_of(left, right);
        }
        stack[depth].node = first;
        stack[depth++].square = zr_least_of(left, right);
    }
    *steps += visits;
}

/* Begins with the guess. */
static void look_at_guess(const struct zr_surface_tree *tree, struct zr_world_place from, struct zr_surface_hit *hit)
{
    const uint32_t guess = hit->triangle < tree->solid->count ? hit->triangle : 0;
    struct zr_world_place p[3];
    zr_solid_places(tree->solid, guess, p);
    look(p, guess, from, hit);
}

void zr_surface_tree_nearest(const struct zr_surface_tree *tree, struct zr_world_place from, double enough,
                             struct zr_surface_hit *hit, uint64_t *steps)
{
    hit->square = HUGE_VAL;
    look_at_guess(tree, from, hit);
    search(tree, from, enough, hit, steps);
}

bool zr_surface_tree_within(const struct zr_surface_tree *tree, struct zr_world_place from, double reach,
                            struct zr_surface_hit *hit, uint64_t *steps)
{
    const double square = reach * reach;
    hit->square = square;
    look_at_guess(tree, from, hit);
    search(tree, from, -1.0, hit, steps);
    return hit->square < square;
}

/* ---- inside ---- */

/* The begin of a ray in its frame, and the height of its end. */
struct seen {
    double at[3], end;
};

/* Returns 1 or -1 if the ray leaves or enters through a triangle, else 0. */
static int cross(const struct zr_ray_grid *grid, const struct zr_world_place t[3], const struct seen *ray)
{
    const double *at = ray->at;
    struct zr_ray_facet f;
    double rise = 0.0, fall = 0.0;
    int found = 0;
    for (int k = 0; k < 3; k++)
        zr_ray_facet_put(grid, t[k], &f, k);
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3;
        if ((f.at[k].v <= at[1]) == (f.at[next].v <= at[1])) continue;
        const bool rises = f.at[k].v <= at[1];
        const int low = rises ? k : next, high = rises ? next : k;
        const double u =
            f.at[low].u + (at[1] - f.at[low].v) * (f.at[high].u - f.at[low].u) / (f.at[high].v - f.at[low].v);
        *(rises ? &rise : &fall) = u;
        found++;
    }
    if (found != 2 || (rise <= at[0]) == (fall <= at[0])) return 0;
    zr_ray_facet_plane(&f);
    const double d = f.du * (at[0] - f.at[0].u) + f.dv * (at[1] - f.at[0].v);
    const double height = f.at[0].d + (d > f.low ? d < f.high ? d : f.high : f.low);
    if (height <= at[2] || height > ray->end) return 0;
    return rise <= at[0] ? -1 : 1;
}

/* A ray, or a segment if `length` is not HUGE_VAL. */
struct ray {
    struct zr_ray_grid grid; /* u, v and d alone */
    double from[3], length;
};

/* Returns true if the ray meets a box. `pad`: more than the rounding errors. */
static bool meets(const struct zr_surface_box *box, const struct ray *ray, const double along_ray[3], double pad)
{
    double low = -pad, high = ray->length + pad;
    for (int k = 0; k < 3; k++) {
        const double a = ((double)box->min[k] - pad - ray->from[k]) / along_ray[k],
                     b = ((double)box->max[k] + pad - ray->from[k]) / along_ray[k];
        low = zr_most_of(low, zr_least_of(a, b));
        high = zr_least_of(high, zr_most_of(a, b));
    }
    return low <= high;
}

/* Returns the sum of crossings: those that leave count 1, and those that enter -1. */
static int sum_crossings(const struct zr_surface_tree *tree, const struct ray *ray, uint64_t *steps)
{
    const struct zr_ray_grid *grid = &ray->grid;
    const struct zr_world_place at = {ray->from[0], ray->from[1], ray->from[2]};
    const double along_ray[3] = {grid->d.x, grid->d.y, grid->d.z};
    const struct seen seen = {
        {zr_world_place_dot(grid->u, at), zr_world_place_dot(grid->v, at), zr_world_place_dot(grid->d, at)},
        zr_world_place_dot(grid->d, at) + ray->length};
    const double far = zr_most_of(fabs(at.x), zr_most_of(fabs(at.y), fabs(at.z)));
    const double pad = 1e-9 * zr_most_of(tree->solid->diagonal, far);
    uint32_t stack[DEPTH] = {1};
    uint64_t visits = 1;
    int sum = 0;
    for (int depth = meets(&tree->boxes[1], ray, along_ray, pad) ? 1 : 0; depth > 0 && !is_ended(tree, visits);
         visits++) {
        const uint32_t node = stack[--depth];
        if (node >= tree->leaf_count) {
            const uint32_t begin = tree->begins[node - tree->leaf_count];
            for (uint32_t i = begin; i < tree->solid->count && i < begin + ZR_SURFACE_LEAF; i++, visits++)
                sum += cross(grid, tree->faces[i].at, &seen);
            continue;
        }
        for (uint32_t child = 2 * node; child <= 2 * node + 1; child++)
            if (meets(&tree->boxes[child], ray, along_ray, pad)) stack[depth++] = child;
    }
    *steps += visits;
    return sum;
}

int zr_surface_tree_winding(const struct zr_surface_tree *tree, struct zr_world_place at, uint64_t *steps)
{
    static const double unit[3] = {1, 1, 1};
    struct ray ray = {.from = {at.x, at.y, at.z}, .length = HUGE_VAL};
    zr_ray_grid_turn(&ray.grid, 0, unit);
    return sum_crossings(tree, &ray, steps);
}

/* Returns the difference of the winding numbers of two places. */
static int difference_of(const struct zr_surface_tree *tree, struct zr_world_place from, struct zr_world_place to,
                         uint64_t *steps)
{
    const struct zr_world_place way = zr_world_place_minus(to, from);
    const double length = sqrt(zr_world_place_dot(way, way)), x = fabs(way.x), y = fabs(way.y), z = fabs(way.z);
    const bool is_x = x <= y && x <= z, is_y = !is_x && y <= z;
    const struct zr_world_place axis = {is_x, is_y, !is_x && !is_y};
    struct ray ray = {.from = {from.x, from.y, from.z}, .length = length};
    ray.grid.d = (struct zr_world_place){way.x / length, way.y / length, way.z / length};
    const struct zr_world_place across = zr_world_place_cross(axis, ray.grid.d);
    const double size = sqrt(zr_world_place_dot(across, across));
    ray.grid.u = (struct zr_world_place){across.x / size, across.y / size, across.z / size};
    ray.grid.v = zr_world_place_cross(ray.grid.d, ray.grid.u);
    return sum_crossings(tree, &ray, steps);
}

int zr_surface_tree_winding_beside(const struct zr_surface_tree *tree, struct zr_world_place at, double distance,
                                   struct zr_surface_ball *last, uint64_t *steps)
{
    const double least = LEAST * tree->solid->diagonal;
    const struct zr_world_place way = zr_world_place_minus(at, last->at);
    const double radius = SAFE * zr_most_of(distance, last->radius), square = zr_world_place_dot(way, way);
    int winding = last->winding;
    if (!last->is_known)
        winding = zr_surface_tree_winding(tree, at, steps);
    else if (!(square < radius * radius) && square > least * least)
        winding += difference_of(tree, at, last->at, steps);
    if (distance > least) *last = (struct zr_surface_ball){true, at, distance, winding};
    return winding;
}

struct zr_world_place zr_surface_normal(const struct zr_solid *solid, uint32_t triangle)
{
    struct zr_world_place p[3];
    zr_solid_places(solid, triangle, p);
    const struct zr_world_place n =
        zr_world_place_cross(zr_world_place_minus(p[1], p[0]), zr_world_place_minus(p[2], p[0]));
    const double length = sqrt(zr_world_place_dot(n, n));
    if (!(length > 0.0)) return (struct zr_world_place){0, 0, 0};
    return (struct zr_world_place){n.x / length, n.y / length, n.z / length};
}
