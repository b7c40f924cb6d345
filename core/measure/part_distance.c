#include "measure/part_distance.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "measure/surface_tree.h"
#include "scene/parts/part_list.h"

enum { BELOW_MAX = 4096, STACK = 256, STEPS_PER_CANCEL_CHECK = 1 << 12 };

/* Share of the diagonal by which an edge leads through a triangle at least. */
static const double through = 1e-9;

typedef struct zr_world_place place;

/* Two parts. */
struct pair {
    const struct zr_cancel *cancel;
    const struct zr_surface_tree *trees[2];
    uint64_t steps, most_steps;
    double least;  /* lengths below it are 0 */
    double square; /* of the distance found */
    place at[2];
    bool crosses, is_ended;
};

static place minus(place a, place b)
{
    return zr_world_place_minus(a, b);
}

static double dot(place a, place b)
{
    return zr_world_place_dot(a, b);
}

static place along(place from, place step, double t)
{
    return (place){from.x + step.x * t, from.y + step.y * t, from.z + step.z * t};
}

static double clamped(double t)
{
    return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
}

/* ---- two triangles ---- */

static void keep(struct pair *pair, place a, place b, bool is_turned)
{
    const place d = minus(a, b);
    const double square = dot(d, d);
    if (!(square < pair->square)) return;
    pair->square = square;
    pair->at[0] = is_turned ? b : a;
    pair->at[1] = is_turned ? a : b;
}

/* Compares two edges.
 * Source: Ericson, "Real-Time Collision Detection", 2005, 5.1.9. */
static void compare_edges(struct pair *pair, place p, place p_end, place q, place q_end)
{
    const place d1 = minus(p_end, p), d2 = minus(q_end, q), r = minus(p, q);
    const double a = dot(d1, d1), e = dot(d2, d2), f = dot(d2, r);
    double s = 0.0, t = 0.0;
    if (a > 0.0 && e > 0.0) {
        const double b = dot(d1, d2), c = dot(d1, r), area = a * e - b * b;
        s = area > 1e-14 * a * e ? clamped((b * f - c * e) / area) : 0.0;
        t = (b * s + f) / e;
        if (t < 0.0) {
            t = 0.0;
            s = clamped(-c / a);
        } else if (t > 1.0) {
            t = 1.0;
            s = clamped((b - c) / a);
        }
    } else if (a > 0.0) {
        s = clamped(-dot(d1, r) / a);
    } else if (e > 0.0) {
        t = clamped(f / e);
    }
    keep(pair, along(p, d1, s), along(q, d2, t), false);
}

/* Compares an end of an edge with the middle of a triangle, and finds out whether the edge leads through it. */
static void compare_face(struct pair *pair, const place t[3], place from, place to, bool is_turned)
{
    const place ab = minus(t[1], t[0]), ac = minus(t[2], t[0]), n = zr_world_place_cross(ab, ac);
    const double length = sqrt(dot(n, n));
    if (!(length > 0.0)) return;
    const double d = dot(n, minus(from, t[0])) / length, e = dot(n, minus(to, t[0])) / length;
    const place foot = along(from, n, -d / length);
    int inside = 0;
    for (int k = 0; k < 3; k++)
        inside += dot(n, zr_world_place_cross(minus(t[(k + 1) % 3], t[k]), minus(foot, t[k]))) >= 0.0;
    if (inside == 3) keep(pair, from, foot, is_turned);
    if (!((d > pair->least && e < -pair->least) || (d < -pair->least && e > pair->least))) return;
    const place hit = along(from, minus(to, from), d / (d - e));
    for (int k = 0; k < 3; k++) {
        const place side = minus(t[(k + 1) % 3], t[k]);
        const double way = dot(n, zr_world_place_cross(side, minus(hit, t[k]))) / length;
        if (!(way > pair->least * sqrt(dot(side, side)))) return;
    }
    pair->crosses = true;
    pair->square = 0.0;
    pair->at[0] = pair->at[1] = hit;
}

static void compare_triangles(struct pair *pair, const place a[3], const place b[3])
{
    for (int i = 0; i < 3; i++) {
        compare_face(pair, b, a[i], a[(i + 1) % 3], false);
        compare_face(pair, a, b[i], b[(i + 1) % 3], true);
        for (int k = 0; k < 3; k++)
            compare_edges(pair, a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]);
    }
}

/* ---- two trees ---- */

static double square_between(const struct zr_surface_box *a, const struct zr_surface_box *b)
{
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        const double gap =
            zr_most_of(0.0, zr_most_of((double)a->min[k] - (double)b->max[k], (double)b->min[k] - (double)a->max[k]));
        sum += gap * gap;
    }
    return sum;
}

static double size_of(const struct zr_surface_box *box)
{
    double most = 0.0;
    for (int k = 0; k < 3; k++)
        most = zr_most_of(most, (double)box->max[k] - (double)box->min[k]);
    return most;
}

static void compare_leaves(struct pair *pair, uint32_t a, uint32_t b)
{
    const struct zr_surface_tree *s = pair->trees[0], *t = pair->trees[1];
    const uint32_t i0 = s->begins[a - s->leaf_count], k0 = t->begins[b - t->leaf_count];
    for (uint32_t i = i0; i < s->solid->count && i < i0 + ZR_SURFACE_LEAF; i++)
        for (uint32_t k = k0; k < t->solid->count && k < k0 + ZR_SURFACE_LEAF && !pair->crosses; k++) {
            compare_triangles(pair, s->faces[i].at, t->faces[k].at);
            pair->steps++;
        }
}

/* A pair of nodes to be visited. */
struct visit {
    uint32_t nodes[2];
    double square; /* of the distance of their boxes */
};

/* Pairs at distance 0 are visited until the parts cross. */
static bool is_close(const struct pair *pair, double square)
{
    return square < pair->square || (square == 0.0 && !pair->crosses);
}

static void search(struct pair *pair)
{
    const struct zr_surface_tree *a = pair->trees[0], *b = pair->trees[1];
    struct visit stack[STACK] = {{{1, 1}, 0.0}};
    for (int depth = 1; depth > 0 && !pair->crosses; pair->steps++) {
        const struct visit at = stack[--depth];
        if (pair->steps % STEPS_PER_CANCEL_CHECK < 1 + ZR_SURFACE_LEAF * ZR_SURFACE_LEAF &&
            zr_is_cancelled(pair->cancel))
            return;
        if (pair->steps > pair->most_steps) {
            pair->is_ended = true;
            return;
        }
        if (!is_close(pair, at.square)) continue;
        const bool is_leaf_a = at.nodes[0] >= a->leaf_count, is_leaf_b = at.nodes[1] >= b->leaf_count;
        if (is_leaf_a && is_leaf_b) {
            compare_leaves(pair, at.nodes[0], at.nodes[1]);
            continue;
        }
        const bool splits_a =
            is_leaf_b || (!is_leaf_a && size_of(&a->boxes[at.nodes[0]]) >= size_of(&b->boxes[at.nodes[1]]));
        struct visit next[2];
        for (uint32_t k = 0; k < 2; k++) {
            next[k] = at;
            next[k].nodes[splits_a ? 0 : 1] = 2 * at.nodes[splits_a ? 0 : 1] + k;
            next[k].square = square_between(&a->boxes[next[k].nodes[0]], &b->boxes[next[k].nodes[1]]);
        }
        const int nearer = next[1].square < next[0].square;
        if (depth + 2 > STACK) {
            pair->is_ended = true;
            return;
        }
        stack[depth++] = next[!nearer];
        stack[depth++] = next[nearer];
    }
}

/* ---- parts ---- */

/* Takes the triangles of a part. */
static bool take_part(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_solid *whole,
                      uint32_t part, struct zr_solid *out)
{
    uint32_t(*corners)[3] = zr_arena_alloc(arena, whole->count, sizeof *corners);
    uint32_t(*vertices)[3] = zr_arena_alloc(arena, whole->count, sizeof *vertices);
    if (!corners || !vertices) return false;
    *out = *whole;
    out->count = 0;
    for (uint32_t t = 0; t < whole->count && !(t % 8192 == 0 && zr_is_cancelled(cancel)); t++) {
        if (whole->parts[t] != part) continue;
        memcpy(corners[out->count], whole->corners[t], sizeof *corners);
        memcpy(vertices[out->count], whole->vertices[t], sizeof *vertices);
        out->count++;
    }
    out->corners = (const uint32_t(*)[3])corners;
    out->vertices = (const uint32_t(*)[3])vertices;
    return true;
}

/* True if each edge is used as often in one direction as in the other: the sum of numbers that stand for the edges is
 * then 0, and otherwise it is not, but for one case in 2^64. */
static bool is_closed(const struct zr_solid *solid, const struct zr_cancel *cancel)
{
    uint64_t sum = 0;
    for (uint32_t t = 0; t < solid->count && !(t % 8192 == 0 && zr_is_cancelled(cancel)); t++)
        for (int k = 0; k < 3; k++) {
            const uint32_t a = solid->vertices[t][k], b = solid->vertices[t][(k + 1) % 3];
            uint64_t mixed = (uint64_t)(a < b ? a : b) << 32 | (a < b ? b : a);
            mixed = (mixed ^ mixed >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
            mixed = (mixed ^ mixed >> 27) * UINT64_C(0x94d049bb133111eb);
            mixed ^= mixed >> 31;
            sum += a < b ? mixed : a > b ? 0 - mixed : 0;
        }
    return sum == 0;
}

/* Looks for a place just inside of a part that lies in the other one, too: parts whose faces coincide cross without
 * an edge that leads through a face. */
static void look_below(struct pair *pair, int k)
{
    const struct zr_solid *solid = pair->trees[k]->solid;
    const double below = 1e3 * pair->least;
    for (uint32_t t = 0; t < solid->count && t < BELOW_MAX && !pair->crosses && !zr_is_cancelled(pair->cancel); t++) {
        place p[3];
        zr_solid_places(solid, t, p);
        const place n = zr_surface_normal(solid, t),
                    middle = {(p[0].x + p[1].x + p[2].x) / 3.0, (p[0].y + p[1].y + p[2].y) / 3.0,
                              (p[0].z + p[1].z + p[2].z) / 3.0};
        const place at = along(middle, n, -below);
        if (zr_surface_tree_winding(pair->trees[k], at, &pair->steps) == 0 ||
            zr_surface_tree_winding(pair->trees[!k], at, &pair->steps) == 0)
            continue;
        pair->crosses = true;
        pair->square = 0.0;
        pair->at[0] = pair->at[1] = middle;
    }
}

/* A part inside of another one crosses it. */
static void look_inside(struct pair *pair)
{
    const bool is_touching = pair->square <= pair->least * pair->least;
    if (is_touching && is_closed(pair->trees[0]->solid, pair->cancel) && is_closed(pair->trees[1]->solid, pair->cancel))
        for (int k = 0; k < 2 && !pair->crosses; k++)
            look_below(pair, k);
    for (int k = 0; k < 2 && !pair->crosses; k++) {
        const struct zr_solid *inner = pair->trees[k]->solid;
        if (!is_closed(pair->trees[!k]->solid, pair->cancel)) continue;
        const place at = inner->places[inner->corners[0][0]];
        struct zr_surface_hit hit = {.triangle = 0};
        zr_surface_tree_nearest(pair->trees[!k], at, -1.0, &hit, &pair->steps);
        if (!(hit.square > pair->least * pair->least)) continue;
        if (zr_surface_tree_winding(pair->trees[!k], at, &pair->steps) == 0) continue;
        pair->crosses = true;
        pair->square = 0.0;
        pair->at[0] = pair->at[1] = at;
    }
}

static uint32_t find_part(const struct zr_part_list *list, const char *name)
{
    const struct zr_part *part = zr_part_list_find(list, name);
    return part ? (uint32_t)(part - list->at) : UINT32_MAX;
}

static enum zr_status measure(const struct zr_run *run, const struct zr_solid *whole, const uint32_t parts[2],
                              struct zr_part_distance *out)
{
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const struct zr_run inner = zr_run_in(run, &scratch);
    struct zr_solid solids[2];
    struct zr_surface_tree trees[2];
    struct pair pair = {.cancel = run->cancel, .least = through * whole->diagonal, .square = HUGE_VAL};
    enum zr_status status = ZR_OK;
    for (int k = 0; k < 2 && status == ZR_OK; k++) {
        pair.trees[k] = &trees[k];
        status = take_part(&scratch, run->cancel, whole, parts[k], &solids[k]) ? ZR_OK : ZR_NO_MEMORY;
        if (status == ZR_OK) status = zr_surface_tree_make(&inner, &solids[k], &trees[k]);
    }
    if (status == ZR_OK && solids[0].count > 0 && solids[1].count > 0) {
        pair.most_steps = ZR_DISTANCE_STEPS_LEAST + ZR_DISTANCE_STEPS * ((uint64_t)solids[0].count + solids[1].count);
        search(&pair);
        if (!pair.crosses && !pair.is_ended && !zr_is_cancelled(run->cancel)) look_inside(&pair);
        out->is_found = pair.crosses || !pair.is_ended;
        out->crosses = pair.crosses;
        out->distance = sqrt(pair.square);
        for (int k = 0; k < 2; k++) {
            out->places[k][0] = pair.at[k].x + whole->middle.x;
            out->places[k][1] = pair.at[k].y + whole->middle.y;
            out->places[k][2] = pair.at[k].z + whole->middle.z;
        }
    }
    zr_arena_close_scratch(&scratch, run->arena);
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : status;
}

static enum zr_status measure_all(const struct zr_run *run, const struct zr_scene *scene, struct zr_part_distance *out)
{
    const struct zr_part_list list = zr_part_list_make(run->arena, scene, UINT32_MAX);
    struct zr_scene in_world = *scene; /* whose places are not those of the file */
    struct zr_solid whole;
    in_world.file.up = NULL;
    in_world.origin = NULL;
    enum zr_status status = zr_solid_make(run, &in_world, NULL, &whole);
    for (uint32_t i = 0; i < scene->distance_count && status == ZR_OK; i++) {
        uint32_t parts[2];
        for (int k = 0; k < 2 && status == ZR_OK; k++) {
            char pointer[40];
            out[i].parts[k] = scene->distances[i].parts[k];
            parts[k] = find_part(&list, out[i].parts[k]);
            if (parts[k] != UINT32_MAX) continue;
            snprintf(pointer, sizeof pointer, "/distances/%" PRIu32 "/%d", i, k);
            status = zr_error_add(run->error, ZR_BAD_SCENE, pointer,
                                  "the scene has no part \"%.100s\"; the first is \"%.100s\"", out[i].parts[k],
                                  list.count > 0 ? list.at[0].name : "");
        }
        if (status == ZR_OK) status = measure(run, &whole, parts, &out[i]);
    }
    return status;
}

enum zr_status zr_part_distances_find(const struct zr_run *run, const struct zr_scene *scene,
                                      const struct zr_part_distance **out)
{
    struct zr_part_distance *found = zr_arena_zero(run->arena, scene->distance_count, sizeof *found);
    if (!found) return ZR_NO_MEMORY;
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const struct zr_run inner = zr_run_in(run, &scratch);
    const enum zr_status status = measure_all(&inner, scene, found);
    zr_arena_close_scratch(&scratch, run->arena);
    *out = found;
    return status;
}
