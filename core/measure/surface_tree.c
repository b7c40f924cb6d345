#include "measure/surface_tree.h"

#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "mesh/facts/ray_grid.h"

enum {
    DIGIT = 10,
    DIGITS = 1 << DIGIT,
    CELL_BITS = 30,
    ITEMS_PER_CANCEL_CHECK = 1 << 14,
    DEPTH = 64,
    VISITS_PER_CANCEL_CHECK = 1 << 14
};

static bool is_due(const struct zr_run *run, size_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(run->cancel);
}

/* ---- making ---- */

/* Spreads the lowest 10 bits to every third bit. */
static uint32_t spread_to_thirds(uint32_t x)
{
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

/* Cells of the box along a curve in the order of Morton. */
static uint32_t key_of(const struct zr_solid *solid, uint32_t triangle)
{
    struct zr_world_place p[3];
    uint32_t key = 0;
    zr_solid_places(solid, triangle, p);
    const double middle[3] = {(p[0].x + p[1].x + p[2].x) / 3.0, (p[0].y + p[1].y + p[2].y) / 3.0,
                              (p[0].z + p[1].z + p[2].z) / 3.0};
    double side = 0.0;
    for (int k = 0; k < 3; k++)
        side = zr_most_of(side, solid->max[k] - solid->min[k]);
    for (int k = 0; k < 3; k++) {
        const double cell = side > 0.0 ? (middle[k] - solid->min[k]) / side * 1023.0 : 0.0;
        key |= spread_to_thirds((uint32_t)zr_most_of(0.0, zr_least_of(cell, 1023.0))) << k;
    }
    return key;
}

/* Sorts the triangles by their keys; equal ones keep their order. */
static bool sort(const struct zr_run *run, const struct zr_solid *solid, struct zr_arena *scratch, uint32_t *order)
{
    uint32_t *keys = zr_arena_alloc(scratch, solid->count, sizeof *keys);
    uint32_t *spare = zr_arena_alloc(scratch, solid->count, sizeof *spare);
    if (!zr_arena_ok(scratch)) return false;
    for (uint32_t i = 0; i < solid->count && !is_due(run, i); i++) {
        keys[i] = key_of(solid, i);
        order[i] = i;
    }
    for (int shift = 0; shift < CELL_BITS; shift += DIGIT) {
        uint32_t begins[DIGITS + 1] = {0};
        if (zr_is_cancelled(run->cancel)) return true;
        for (uint32_t i = 0; i < solid->count; i++)
            begins[(keys[i] >> shift) % DIGITS + 1]++;
        for (int d = 0; d < DIGITS; d++)
            begins[d + 1] += begins[d];
        for (uint32_t i = 0; i < solid->count; i++) {
            if (is_due(run, i)) return true;
            spare[begins[(keys[order[i]] >> shift) % DIGITS]++] = order[i];
        }
        memcpy(order, spare, solid->count * sizeof *order);
    }
    return true;
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

/* Nodes of the lowest level come first in the order of space. */
static uint32_t node_of_leaf(uint32_t leaf, uint32_t count)
{
    uint32_t level = 1;
    while (2 * (uint64_t)level <= 2 * (uint64_t)count - 1)
        level *= 2;
    const uint32_t lowest = 2 * count - level;
    return leaf < lowest ? level + leaf : count + (leaf - lowest);
}

static void fill(const struct zr_run *run, const struct zr_surface_tree *tree, uint32_t *begins,
                 struct zr_surface_box *boxes)
{
    const struct zr_solid *solid = tree->solid;
    for (uint32_t leaf = 0; leaf < tree->leaf_count && !is_due(run, leaf); leaf++) {
        const uint32_t node = node_of_leaf(leaf, tree->leaf_count), begin = leaf * ZR_SURFACE_LEAF;
        struct zr_surface_box *box = &boxes[node];
        begins[node - tree->leaf_count] = begin;
        *box = (struct zr_surface_box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
        for (uint32_t i = begin; i < solid->count && i < begin + ZR_SURFACE_LEAF; i++) {
            struct zr_world_place p[3];
            zr_solid_places(solid, tree->order[i], p);
            for (int k = 0; k < 3; k++)
                include(box, p[k]);
        }
    }
    for (uint32_t node = tree->leaf_count; node-- > 1;) {
        boxes[node] = boxes[2 * node];
        join(&boxes[node], &boxes[2 * node + 1]);
    }
}

enum zr_status zr_surface_tree_make(const struct zr_run *run, const struct zr_solid *solid, struct zr_surface_tree *out)
{
    const uint32_t leaves = (uint32_t)(((uint64_t)solid->count + ZR_SURFACE_LEAF - 1) / ZR_SURFACE_LEAF);
    uint32_t *order = zr_arena_alloc(run->arena, solid->count, sizeof *order);
    uint32_t *begins = zr_arena_alloc(run->arena, leaves, sizeof *begins);
    struct zr_surface_box *boxes = zr_arena_alloc(run->arena, 2 * (size_t)leaves, sizeof *boxes);
    *out = (struct zr_surface_tree){solid, run->cancel, leaves, order, begins, boxes};
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const bool is_sorted = sort(run, solid, &scratch, order);
    zr_arena_close_scratch(&scratch, run->arena);
    if (!is_sorted) return ZR_NO_MEMORY;
    if (!zr_is_cancelled(run->cancel)) fill(run, out, begins, boxes);
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
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

static void look(const struct zr_solid *solid, uint32_t triangle, struct zr_world_place from,
                 struct zr_surface_hit *hit)
{
    struct zr_world_place p[3];
    zr_solid_places(solid, triangle, p);
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

void zr_surface_tree_nearest(const struct zr_surface_tree *tree, struct zr_world_place from, double enough,
                             struct zr_surface_hit *hit, uint64_t *steps)
{
    const double at[3] = {from.x, from.y, from.z};
    struct {
        uint32_t node;
        double square;
    } stack[DEPTH] = {{1, 0.0}};
    uint64_t visits = 1;
    hit->square = HUGE_VAL;
    look(tree->solid, hit->triangle < tree->solid->count ? hit->triangle : 0, from, hit);
    for (int depth = 1; depth > 0 && hit->square > enough && !is_ended(tree, visits); visits++) {
        const uint32_t node = stack[--depth].node;
        if (!(stack[depth].square < hit->square)) continue;
        if (node >= tree->leaf_count) {
            const uint32_t begin = tree->begins[node - tree->leaf_count];
            for (uint32_t i = begin; i < tree->solid->count && i < begin + ZR_SURFACE_LEAF; i++, visits++)
                look(tree->solid, tree->order[i], from, hit);
            continue;
        }
        const double left = square_of_box(&tree->boxes[2 * node], at),
                     right = square_of_box(&tree->boxes[2 * node + 1], at);
        const uint32_t first = left <= right ? 2 * node : 2 * node + 1;
        stack[depth].node = first ^ 1u;
        stack[depth++].square = zr_most_of(left, right);
        stack[depth].node = first;
        stack[depth++].square = zr_least_of(left, right);
    }
    *steps += visits;
}

/* ---- inside ---- */

/* Returns 1 or -1 if the ray from `at` along d leaves or enters through a triangle, else 0. */
static int cross(const struct zr_ray_grid *grid, const struct zr_world_place t[3], const double at[3])
{
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
    if (f.at[0].d + (d > f.low ? d < f.high ? d : f.high : f.low) <= at[2]) return 0;
    return rise <= at[0] ? -1 : 1;
}

/* Returns true if the ray meets a box. `pad`: more than the rounding errors. */
static bool meets(const struct zr_surface_box *box, const double from[3], const double along_ray[3], double pad)
{
    double low = -pad, high = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        const double a = ((double)box->min[k] - pad - from[k]) / along_ray[k],
                     b = ((double)box->max[k] + pad - from[k]) / along_ray[k];
        low = zr_most_of(low, zr_least_of(a, b));
        high = zr_least_of(high, zr_most_of(a, b));
    }
    return low <= high;
}

int zr_surface_tree_winding(const struct zr_surface_tree *tree, struct zr_world_place at, uint64_t *steps)
{
    static const double unit[3] = {1, 1, 1};
    struct zr_ray_grid grid;
    zr_ray_grid_turn(&grid, 0, unit);
    const double from[3] = {at.x, at.y, at.z}, ray[3] = {grid.d.x, grid.d.y, grid.d.z},
                 local[3] = {zr_world_place_dot(grid.u, at), zr_world_place_dot(grid.v, at),
                             zr_world_place_dot(grid.d, at)};
    const double far = zr_most_of(fabs(at.x), zr_most_of(fabs(at.y), fabs(at.z)));
    const double pad = 1e-9 * zr_most_of(tree->solid->diagonal, far);
    uint32_t stack[DEPTH] = {1};
    uint64_t visits = 1;
    int winding = 0;
    for (int depth = meets(&tree->boxes[1], from, ray, pad) ? 1 : 0; depth > 0 && !is_ended(tree, visits); visits++) {
        const uint32_t node = stack[--depth];
        if (node >= tree->leaf_count) {
            const uint32_t begin = tree->begins[node - tree->leaf_count];
            for (uint32_t i = begin; i < tree->solid->count && i < begin + ZR_SURFACE_LEAF; i++, visits++) {
                struct zr_world_place p[3];
                zr_solid_places(tree->solid, tree->order[i], p);
                winding += cross(&grid, p, local);
            }
            continue;
        }
        for (uint32_t child = 2 * node; child <= 2 * node + 1; child++)
            if (meets(&tree->boxes[child], from, ray, pad)) stack[depth++] = child;
    }
    *steps += visits;
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
