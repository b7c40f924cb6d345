#include "measure/refined.h"

#include <stdatomic.h>
#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/team.h"

enum { ROUNDS = 16, TRIANGLES_PER_TASK = 64, STEPS_PER_TRIANGLE = 1 << 15, TRIANGLES_PER_CANCEL_CHECK = 1 << 13 };

/* A triangle and the middles of its edges; edge k leads from corner k to the next one. */
struct cut {
    struct zr_world_place middle[3];
    double distance[3];
    bool is_halved[3];
};

struct refining {
    const struct zr_run *run;
    const struct zr_surface_tree *other;
    const struct zr_refining *how;
    struct zr_refined_triangle *triangles;
    struct cut *cuts; /* NULL: distances of the corners are found */
    uint32_t count;
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

static double distance_of(struct refining *r, struct zr_world_place at, struct zr_surface_hit *hit, uint64_t *steps)
{
    zr_surface_tree_nearest(r->other, at, -1.0, hit, steps);
    const double distance = sqrt(hit->square);
    if (!r->other->solid->is_closed || distance <= r->how->near) return distance;
    return zr_surface_tree_winding(r->other, at, steps) != 0 ? -distance : distance;
}

/* Decides from the ends of the edge alone, in any order. */
static void halve_edge(struct refining *r, const struct zr_refined_triangle *t, int k, struct cut *cut,
                       struct zr_surface_hit *hit, uint64_t *steps)
{
    const struct zr_world_place a = t->at[k], b = t->at[(k + 1) % 3], way = zr_world_place_minus(a, b);
    const double square = zr_world_place_dot(way, way);
    const bool is_long = square > r->how->longest * r->how->longest;
    cut->is_halved[k] = is_long;
    if (!is_long && !(square > r->how->finest * r->how->finest)) return;
    cut->middle[k] = (struct zr_world_place){0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z)};
    cut->distance[k] = distance_of(r, cut->middle[k], hit, steps);
    const enum zr_surface_class first = class_of(r, t->distance[k]), second = class_of(r, t->distance[(k + 1) % 3]),
                                middle = class_of(r, cut->distance[k]);
    cut->is_halved[k] = is_long || first != second || first != middle;
}

static void run_tasks(void *context, size_t begin, size_t end)
{
    struct refining *r = context;
    for (size_t task = begin; task < end; task++) {
        struct zr_surface_hit hit = {.triangle = 0};
        uint64_t steps = 0;
        for (size_t i = task * TRIANGLES_PER_TASK; i < r->count && i < (task + 1) * TRIANGLES_PER_TASK; i++) {
            if (atomic_load_explicit(&r->is_stopped, memory_order_relaxed) || zr_is_cancelled(r->run->cancel)) return;
            struct zr_refined_triangle *t = &r->triangles[i];
            if (r->cuts) memset(r->cuts[i].is_halved, 0, sizeof r->cuts[i].is_halved);
            for (int k = 0; k < 3 && !t->is_whole; k++) {
                if (r->cuts)
                    halve_edge(r, t, k, &r->cuts[i], &hit, &steps);
                else
                    t->distance[k] = distance_of(r, t->at[k], &hit, &steps);
            }
            if (steps > (uint64_t)STEPS_PER_TRIANGLE * TRIANGLES_PER_TASK)
                atomic_store_explicit(&r->is_stopped, true, memory_order_relaxed);
        }
        if (atomic_fetch_add_explicit(&r->steps, steps, memory_order_relaxed) + steps > ZR_REFINED_STEPS)
            atomic_store_explicit(&r->is_stopped, true, memory_order_relaxed);
    }
}

static void run_all(struct refining *r)
{
    zr_team_ranges(r->run->team, ((size_t)r->count + TRIANGLES_PER_TASK - 1) / TRIANGLES_PER_TASK, 1, run_tasks, r);
}

static void put(struct zr_refined_triangle **out, const struct zr_refined_triangle *t, const struct cut *cut,
                const int corners[3])
{
    struct zr_refined_triangle *own = (*out)++;
    own->is_whole = !cut->is_halved[0] && !cut->is_halved[1] && !cut->is_halved[2];
    for (int i = 0; i < 3; i++) { /* 0 to 2: corners; 3 to 5: middles */
        const int k = corners[i];
        own->at[i] = k < 3 ? t->at[k] : cut->middle[k - 3];
        own->distance[i] = k < 3 ? t->distance[k] : cut->distance[k - 3];
    }
}

/* Writes the one to four pieces of a triangle. Pieces with two halved edges are cut along one diagonal. */
static void put_pieces(struct zr_refined_triangle **out, const struct zr_refined_triangle *t, const struct cut *cut)
{
    const int halved = cut->is_halved[0] + cut->is_halved[1] + cut->is_halved[2];
    if (halved == 0) put(out, t, cut, (const int[3]){0, 1, 2});
    if (halved == 3)
        for (int k = 0; k < 3; k++)
            put(out, t, cut, (const int[3]){k, 3 + k, 3 + (k + 2) % 3});
    if (halved == 3) put(out, t, cut, (const int[3]){3, 4, 5});
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        if (halved == 1 && cut->is_halved[k]) {
            put(out, t, cut, (const int[3]){k, 3 + k, last});
            put(out, t, cut, (const int[3]){3 + k, next, last});
        }
        if (halved == 2 && !cut->is_halved[k]) { /* the corner opposite to edge k is cut off */
            put(out, t, cut, (const int[3]){last, 3 + last, 3 + next});
            put(out, t, cut, (const int[3]){k, next, 3 + next});
            put(out, t, cut, (const int[3]){k, 3 + next, 3 + last});
        }
    }
}

/* Halves edges once. `most`: of triangles. Returns false if nothing is left to do, or without memory. */
static bool refine(struct refining *r, struct zr_arena *scratch, uint64_t most)
{
    uint64_t count = r->count;
    r->cuts = zr_arena_alloc(scratch, r->count, sizeof *r->cuts);
    if (!r->cuts) return false;
    run_all(r);
    if (atomic_load(&r->is_stopped) || zr_is_cancelled(r->run->cancel)) return false;
    for (uint32_t i = 0; i < r->count && !is_due(r, i); i++)
        for (int k = 0; k < 3; k++)
            count += r->cuts[i].is_halved[k];
    if (count == r->count || count > most) return false;
    struct zr_refined_triangle *all = zr_arena_alloc(scratch, count, sizeof *all), *out = all;
    if (!all) return false;
    for (uint32_t i = 0; i < r->count && !is_due(r, i); i++)
        put_pieces(&out, &r->triangles[i], &r->cuts[i]);
    r->triangles = all;
    r->count = (uint32_t)count;
    return true;
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

static enum zr_status make(struct refining *r, const struct zr_solid *solid, struct zr_arena *scratch,
                           struct zr_refined *out)
{
    r->count = solid->count;
    r->triangles = zr_arena_alloc(scratch, solid->count, sizeof *r->triangles);
    if (!r->triangles) return ZR_NO_MEMORY;
    for (uint32_t t = 0; t < solid->count && !is_due(r, t); t++) {
        r->triangles[t].is_whole = false;
        zr_solid_places(solid, t, r->triangles[t].at);
    }
    run_all(r);
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
    struct refining r = {.run = run, .other = other, .how = how};
    *out = (struct zr_refined){.count = 0};
    const enum zr_status status = make(&r, solid, &scratch, out);
    zr_arena_close_scratch(&scratch, run->arena);
    return status;
}
