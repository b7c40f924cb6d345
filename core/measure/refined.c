#include "measure/refined.h"

#include <stdatomic.h>
#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/team.h"

enum { ROUNDS = 16, ITEMS_PER_TASK = 64, STEPS_PER_ITEM = 1 << 15, TRIANGLES_PER_CANCEL_CHECK = 1 << 13 };

/* Searches go this many times as far as the results have to: so a result often tells of the next places, too. */
#define FAR 3.0

/* The middles of a triangle's edges; edge k leads from corner k to the next one. */
struct cut {
    struct zr_world_place middle[3];
    double distance[3];
    bool is_halved[3];
};

struct refining {
    const struct zr_run *run;
    const struct zr_solid *solid;
    const struct zr_surface_tree *other;
    const struct zr_refining *how;
    struct zr_refined_triangle *triangles;
    uint32_t count, room;
    double reach;      /* as that of `how`, but no more than the longest edge needs */
    double *distances; /* per place of the solid */
    uint32_t *active;  /* triangles that may be cut, ascending */
    uint32_t active_count;
    struct cut *cuts; /* per active one */
    atomic_bool is_stopped;
    _Atomic uint64_t steps; /* of all tasks so far */
};

static bool is_due(const struct refining *r, uint32_t i)
{
    return i % TRIANGLES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(r->run->cancel);
}

static enum zr_surface_class class_of(const struct refining *r, double distance)
{
    return fabs(distance) <= r->how->near ? ZR_SURFACE_NEAR : distance > 0.0 ? ZR_SURFACE_OUTSIDE : ZR_SURFACE_INSIDE;
}

/* Searches of one task: each begins with the results of the last one. */
struct searching {
    struct refining *r;
    struct zr_surface_hit hit;
    struct zr_surface_ball ball;
    uint64_t steps;
};

/* Returns the distance with its sign. Beyond r->reach, it may be less, but is at least that. */
static double distance_of(struct searching *s, struct zr_world_place at)
{
    const struct zr_surface_tree *other = s->r->other;
    const double reach = s->r->reach, near = s->r->how->near;
    double distance = FAR * reach;
    if (s->ball.is_known && reach < HUGE_VAL) {
        const struct zr_world_place way = zr_world_place_minus(at, s->ball.at);
        const double rest = s->ball.radius - sqrt(zr_world_place_dot(way, way));
        if (rest > reach) return s->ball.winding != 0 ? -rest : rest;
    }
    if (!(reach < HUGE_VAL)) zr_surface_tree_nearest(other, at, -1.0, &s->hit, &s->steps);
    if (!(reach < HUGE_VAL) || zr_surface_tree_within(other, at, distance, &s->hit, &s->steps))
        distance = sqrt(s->hit.square);
    if (distance <= near) return distance;
    if (!other->solid->is_closed) {
        s->ball = (struct zr_surface_ball){true, at, distance, 0};
        return distance;
    }
    return zr_surface_tree_winding_beside(other, at, distance, &s->ball, &s->steps) != 0 ? -distance : distance;
}

/* True if all of an edge has the class of its ends: the balls around them that the other surface does not meet cover
 * it. */
static bool is_clear(const struct refining *r, double first, double second, double square)
{
    const double rest = fabs(first) + fabs(second) - 2.0 * r->how->near;
    return (first > 0.0) == (second > 0.0) && rest > 0.0 && square < rest * rest;
}

static double square_of(struct zr_world_place a, struct zr_world_place b)
{
    const struct zr_world_place way = zr_world_place_minus(a, b);
    return zr_world_place_dot(way, way);
}

/* True if an edge need not be looked at. */
static bool is_plain(const struct refining *r, const struct zr_refined_triangle *t, int k)
{
    const double square = square_of(t->at[k], t->at[(k + 1) % 3]);
    if (square > r->how->longest * r->how->longest) return false;
    return !(square > r->how->finest * r->how->finest) || is_clear(r, t->distance[k], t->distance[(k + 1) % 3], square);
}

static bool is_whole(const struct refining *r, const struct zr_refined_triangle *t)
{
    return is_plain(r, t, 0) && is_plain(r, t, 1) && is_plain(r, t, 2);
}

/* Decides from the ends of the edge alone, in any order. */
static void halve_edge(struct searching *s, const struct zr_refined_triangle *t, int k, struct cut *cut)
{
    const struct refining *r = s->r;
    const struct zr_world_place a = t->at[k], b = t->at[(k + 1) % 3];
    cut->is_halved[k] = false;
    if (is_plain(r, t, k)) return;
    cut->middle[k] = (struct zr_world_place){0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z)};
    cut->distance[k] = distance_of(s, cut->middle[k]);
    const enum zr_surface_class first = class_of(r, t->distance[k]), second = class_of(r, t->distance[(k + 1) % 3]),
                                middle = class_of(r, cut->distance[k]);
    cut->is_halved[k] = square_of(a, b) > r->how->longest * r->how->longest || first != second || first != middle;
}

static bool goes_on(const struct refining *r)
{
    return !atomic_load_explicit(&r->is_stopped, memory_order_relaxed) && !zr_is_cancelled(r->run->cancel);
}

/* Adds the steps of a task that has ended. */
static void add_steps(const struct searching *s)
{
    struct refining *r = s->r;
    const uint64_t all = atomic_fetch_add_explicit(&r->steps, s->steps, memory_order_relaxed) + s->steps;
    if (all > ZR_REFINED_STEPS || s->steps > (uint64_t)STEPS_PER_ITEM * ITEMS_PER_TASK)
        atomic_store_explicit(&r->is_stopped, true, memory_order_relaxed);
}

static void measure_places(void *context, size_t begin, size_t end)
{
    struct searching s = {.r = context};
    for (size_t i = begin; i < end && goes_on(s.r); i++)
        s.r->distances[i] = distance_of(&s, s.r->solid->places[i]);
    add_steps(&s);
}

static void halve_edges(void *context, size_t begin, size_t end)
{
    struct searching s = {.r = context};
    for (size_t i = begin; i < end && goes_on(s.r); i++)
        for (int k = 0; k < 3; k++)
            halve_edge(&s, &s.r->triangles[s.r->active[i]], k, &s.r->cuts[i]);
    add_steps(&s);
}

/* Makes one piece. */
static void put(struct zr_refined_triangle **out, const struct zr_refined_triangle *t, const struct cut *cut,
                const int corners[3])
{
    struct zr_refined_triangle *own = (*out)++;
    for (int i = 0; i < 3; i++) { /* 0 to 2: corners; 3 to 5: middles */
        const int k = corners[i];
        own->at[i] = k < 3 ? t->at[k] : cut->middle[k - 3];
        own->distance[i] = k < 3 ? t->distance[k] : cut->distance[k - 3];
    }
}

/* Writes the two to four pieces of a triangle. Pieces with two halved edges are cut along one diagonal. */
static int put_pieces(const struct zr_refined_triangle *t, const struct cut *cut, struct zr_refined_triangle pieces[4])
{
    struct zr_refined_triangle *out = pieces;
    const int halved = cut->is_halved[0] + cut->is_halved[1] + cut->is_halved[2];
    if (halved == 3)
        for (int k = 0; k < 3; k++)
            put(&out, t, cut, (const int[3]){k, 3 + k, 3 + (k + 2) % 3});
    if (halved == 3) put(&out, t, cut, (const int[3]){3, 4, 5});
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        if (halved == 1 && cut->is_halved[k]) {
            put(&out, t, cut, (const int[3]){k, 3 + k, last});
            put(&out, t, cut, (const int[3]){3 + k, next, last});
        }
        if (halved == 2 && !cut->is_halved[k]) { /* the corner opposite to edge k is cut off */
            put(&out, t, cut, (const int[3]){last, 3 + last, 3 + next});
            put(&out, t, cut, (const int[3]){k, next, 3 + next});
            put(&out, t, cut, (const int[3]){k, 3 + next, 3 + last});
        }
    }
    return (int)(out - pieces);
}

/* Replaces a triangle by its pieces, of which all but the first are new. Writes those that may be cut again. */
static uint32_t cut_triangle(struct refining *r, uint32_t number, const struct cut *cut, uint32_t *active)
{
    const struct zr_refined_triangle own = r->triangles[number];
    struct zr_refined_triangle pieces[4];
    const int count = put_pieces(&own, cut, pieces);
    uint32_t found = 0;
    for (int i = 0; i < count; i++) {
        const uint32_t place = i == 0 ? number : r->count++;
        r->triangles[place] = pieces[i];
        if (!is_whole(r, &pieces[i])) active[found++] = place;
    }
    return found;
}

/* Makes room for triangles, and for more of the next rounds. */
static bool make_room(struct refining *r, struct zr_arena *scratch, uint64_t count)
{
    if (count <= r->room) return true;
    r->room = (uint32_t)(count + count / 4);
    r->triangles = zr_arena_grow(scratch, r->triangles, r->count, r->room, sizeof *r->triangles);
    return r->triangles;
}

/* Halves edges once. `most`: of triangles. Returns false if nothing is left to do, or without memory. */
static bool refine(struct refining *r, struct zr_arena *scratch, uint64_t most)
{
    uint64_t count = r->count;
    uint32_t found = 0;
    r->cuts = zr_arena_alloc(scratch, r->active_count, sizeof *r->cuts);
    if (!r->cuts) return false;
    zr_team_ranges(r->run->team, r->active_count, ITEMS_PER_TASK, halve_edges, r);
    if (!goes_on(r)) return false;
    for (uint32_t i = 0; i < r->active_count && !is_due(r, i); i++)
        for (int k = 0; k < 3; k++)
            count += r->cuts[i].is_halved[k];
    if (count == r->count || count > most) return false;
    uint32_t *active = zr_arena_alloc(scratch, r->active_count + (count - r->count), sizeof *active);
    if (!active || !make_room(r, scratch, count)) return false;
    for (uint32_t i = 0; i < r->active_count && !is_due(r, i); i++) {
        const bool *is_halved = r->cuts[i].is_halved;
        if (is_halved[0] || is_halved[1] || is_halved[2])
            found += cut_triangle(r, r->active[i], &r->cuts[i], active + found);
    }
    r->active = active;
    r->active_count = found;
    return found > 0;
}

static void classify(struct refining *r)
{
    for (uint32_t i = 0; i < r->count && !is_due(r, i); i++) {
        struct zr_refined_triangle *t = &r->triangles[i];
        const enum zr_surface_class a = class_of(r, t->distance[0]), b = class_of(r, t->distance[1]),
                                    c = class_of(r, t->distance[2]);
        t->own = a == b || a == c ? a : b == c ? b : ZR_SURFACE_NEAR;
    }
}

/* Returns the length of the longest edge. */
static double longest_of(const struct refining *r)
{
    double most = 0.0;
    for (uint32_t t = 0; t < r->solid->count && !is_due(r, t); t++) {
        struct zr_world_place p[3];
        zr_solid_places(r->solid, t, p);
        for (int k = 0; k < 3; k++)
            most = zr_most_of(most, square_of(p[k], p[(k + 1) % 3]));
    }
    return sqrt(most);
}

/* Lists the triangles that may be cut. */
static bool list_active(struct refining *r, struct zr_arena *scratch)
{
    r->active = zr_arena_alloc(scratch, r->count, sizeof *r->active);
    if (!r->active) return false;
    for (uint32_t i = 0; i < r->count && !is_due(r, i); i++)
        if (!is_whole(r, &r->triangles[i])) r->active[r->active_count++] = i;
    return true;
}

static enum zr_status make(struct refining *r, struct zr_arena *scratch, struct zr_refined *out)
{
    const struct zr_solid *solid = r->solid;
    r->count = solid->count;
    r->room = solid->count + solid->count / 8;
    r->triangles = zr_arena_alloc(scratch, r->room, sizeof *r->triangles);
    r->distances = zr_arena_alloc(scratch, solid->place_count, sizeof *r->distances);
    if (!zr_arena_ok(scratch)) return ZR_NO_MEMORY;
    r->reach = r->how->reach;
    if (r->reach < HUGE_VAL) r->reach = zr_least_of(r->reach, 0.501 * longest_of(r) + 2.0 * r->how->near);
    zr_team_ranges(r->run->team, solid->place_count, ITEMS_PER_TASK, measure_places, r);
    for (uint32_t t = 0; t < solid->count && !is_due(r, t); t++) {
        zr_solid_places(solid, t, r->triangles[t].at);
        for (int k = 0; k < 3; k++)
            r->triangles[t].distance[k] = r->distances[solid->corners[t][k]];
    }
    if (!list_active(r, scratch)) return ZR_NO_MEMORY;
    for (int round = 0; round < ROUNDS && refine(r, scratch, (uint64_t)ZR_REFINED_MOST + solid->count);)
        round++;
    if (zr_is_cancelled(r->run->cancel)) return ZR_CANCELLED;
    if (!zr_arena_ok(scratch)) return ZR_NO_MEMORY;
    out->is_omitted = atomic_load(&r->is_stopped);
    if (out->is_omitted) return ZR_OK;
    classify(r);
    struct zr_refined_triangle *at = zr_arena_alloc_beside(r->run->arena, scratch, r->count, sizeof *r->triangles);
    if (!at) return ZR_NO_MEMORY;
    memcpy(at, r->triangles, r->count * sizeof *at);
    out->at = at;
    out->count = r->count;
    return ZR_OK;
}

enum zr_status zr_refined_make(const struct zr_run *run, const struct zr_solid *solid,
                               const struct zr_surface_tree *other, const struct zr_refining *how,
                               struct zr_refined *out)
{
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    struct refining r = {.run = run, .solid = solid, .other = other, .how = how};
    *out = (struct zr_refined){.count = 0};
    const enum zr_status status = make(&r, &scratch, out);
    zr_arena_close_scratch(&scratch, run->arena);
    return status;
}
