#include "measure/ray_lists.h"

#include <stdatomic.h>
#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/team.h"

enum {
    TRIANGLES_PER_RANGE = 1 << 12,
    PLACES_PER_RANGE = 1 << 12,
    WORK_PER_CANCEL_CHECK = 1 << 14,
    RAYS_PER_RANGE = 1 << 8
};

/* A place of a solid in the frame of the grid. */
struct seen_place {
    double u, v, d;
};

struct making {
    const struct zr_cancel *cancel;
    const struct zr_solid *solids[2];
    const struct zr_ray_grid *grid;
    struct seen_place *places[2]; /* of each solid */
    uint8_t *met;                 /* per triangle of both: 1 if rays cross it, once they are counted */
    _Atomic uint8_t *hits;        /* per ray: 1, or 2 for the second solid; NULL: crossings are listed */
    _Atomic uint32_t *ends;       /* per ray: count of its crossings; then their end, which becomes their begin */
    uint64_t *crossings;          /* NULL: they are counted */
    uint64_t *spare;              /* as large */
    uint64_t work_most;
    _Atomic uint64_t work;
};

/* Work of one range of triangles. */
struct working {
    struct making *m;
    uint64_t work, next_look;
    bool is_stopped;
};

static bool has_work(struct working *w, uint64_t work)
{
    w->work += work;
    if (w->work < w->next_look) return true;
    const uint64_t all = atomic_fetch_add_explicit(&w->m->work, w->work, memory_order_relaxed) + w->work;
    w->work = 0;
    w->next_look = WORK_PER_CANCEL_CHECK;
    w->is_stopped = all > w->m->work_most || zr_is_cancelled(w->m->cancel);
    return !w->is_stopped;
}

/* A triangle in the frame of the grid, and what its crossings tell beside their heights. */
struct crossing_face {
    struct zr_ray_facet facet;
    bool is_b, has_tag, has_plane, is_met;
    uint8_t tag;
};

static void put_hit(_Atomic uint8_t *hit, uint8_t bit)
{
    if (!(atomic_load_explicit(hit, memory_order_relaxed) & bit))
        atomic_fetch_or_explicit(hit, bit, memory_order_relaxed);
}

static uint64_t crossing_of(const struct making *m, const struct crossing_face *face, uint32_t row, uint32_t column,
                            bool enters)
{
    const uint64_t height = zr_ray_height(m->grid, &face->facet, row, column);
    return face->has_tag ? zr_crossing_tagged(height, face->tag, enters)
                         : zr_crossing_of(height, face->facet.cosine, face->is_b, enters);
}

static void add_row(struct working *w, struct crossing_face *face, uint32_t row)
{
    struct making *m = w->m;
    uint32_t rise, fall;
    if (!zr_ray_columns(m->grid, &face->facet, row, &rise, &fall)) return;
    const uint32_t from = rise < fall ? rise : fall, to = rise < fall ? fall : rise;
    if (!has_work(w, to - from)) return;
    for (uint32_t column = from; m->hits && column < to; column++)
        put_hit(&m->hits[row * m->grid->columns + column], face->is_b ? 2 : 1);
    if (m->hits || from == to) return;
    face->is_met = true;
    if (m->crossings && !face->has_plane) zr_ray_facet_plane(&face->facet);
    face->has_plane = true;
    for (uint32_t column = from; column < to; column++) {
        _Atomic uint32_t *end = &m->ends[row * m->grid->columns + column];
        if (!m->crossings) {
            atomic_fetch_add_explicit(end, 1, memory_order_relaxed);
            continue;
        }
        const uint32_t at = atomic_fetch_sub_explicit(end, 1, memory_order_relaxed) - 1;
        m->crossings[at] = crossing_of(m, face, row, column, rise <= fall);
    }
}

/* True if rays leave through a triangle. A ray that leaves a closed solid enters it, too. */
static bool is_away(const struct zr_ray_facet *f)
{
    return (f->at[1].u - f->at[0].u) * (f->at[2].v - f->at[0].v) -
               (f->at[1].v - f->at[0].v) * (f->at[2].u - f->at[0].u) <
           0.0;
}

static void add_triangle(struct working *w, const struct zr_solid *solid, uint32_t triangle, bool is_b, uint8_t *met)
{
    const struct zr_ray_grid *grid = w->m->grid;
    const struct seen_place *places = w->m->places[is_b];
    struct crossing_face face = {.is_b = is_b, .has_tag = solid->tags, .tag = solid->tags ? solid->tags[triangle] : 0};
    struct zr_ray_facet *f = &face.facet;
    uint32_t begin, end;
    for (int k = 0; k < 3; k++) {
        const struct seen_place *at = &places[solid->corners[triangle][k]];
        f->at[k].u = at->u;
        f->at[k].v = at->v;
        f->at[k].d = at->d;
    }
    if (w->m->hits && solid->is_closed && is_away(f)) return;
    zr_ray_rows(grid, f, &begin, &end);
    if (!has_work(w, 1 + (uint64_t)(end - begin))) return;
    for (uint32_t row = begin; row < end && !w->is_stopped; row++)
        add_row(w, &face, row);
    if (met) *met = face.is_met;
}

static void add_range(void *context, size_t begin, size_t end)
{
    struct working w = {.m = context};
    const uint32_t first = w.m->solids[0]->count;
    for (size_t i = begin; i < end && !w.is_stopped; i++) {
        const bool is_b = i >= first;
        uint8_t *met = w.m->met ? &w.m->met[i] : NULL;
        if (w.m->crossings && !*met) continue;
        if (met) *met = 0;
        add_triangle(&w, w.m->solids[is_b], (uint32_t)(is_b ? i - first : i), is_b, met);
    }
    w.next_look = 0;
    has_work(&w, 0);
}

static void add_all(struct zr_team *team, struct making *m)
{
    atomic_store(&m->work, 0);
    zr_team_ranges(team, (size_t)m->solids[0]->count + m->solids[1]->count, TRIANGLES_PER_RANGE, add_range, m);
}

/* Places of the first solid come before those of the second one. */
static void see_range(void *context, size_t begin, size_t end)
{
    const struct making *m = context;
    const struct zr_ray_grid *grid = m->grid;
    const size_t first = m->solids[0]->place_count;
    if (zr_is_cancelled(m->cancel)) return;
    for (size_t i = begin; i < end; i++) {
        const bool is_b = i >= first;
        const struct zr_world_place at =
            zr_world_place_minus(m->solids[is_b]->places[is_b ? i - first : i], grid->middle);
        m->places[is_b][is_b ? i - first : i] = (struct seen_place){
            zr_world_place_dot(grid->u, at), zr_world_place_dot(grid->v, at), zr_world_place_dot(grid->d, at)};
    }
}

static bool see_places(const struct zr_run *run, struct zr_arena *arena, struct making *m)
{
    for (int i = 0; i < 2; i++)
        m->places[i] = zr_arena_alloc(arena, m->solids[i]->place_count, sizeof **m->places);
    if (!zr_arena_ok(arena)) return false;
    zr_team_ranges(run->team, (size_t)m->solids[0]->place_count + m->solids[1]->place_count, PLACES_PER_RANGE,
                   see_range, m);
    return true;
}

/* Returns the most work that a grid may take; the coarsest one is never refused. */
static uint64_t work_most_of(const struct making *m, uint32_t rays)
{
    return rays > 1 ? ZR_RAY_WORK + ZR_RAY_WORK_PER_TRIANGLE * ((uint64_t)m->solids[0]->count + m->solids[1]->count)
                    : UINT64_MAX;
}

static void sort_range(void *context, size_t begin, size_t end)
{
    const struct making *m = context;
    for (size_t i = begin; i < end && !zr_is_cancelled(m->cancel); i++) {
        const uint32_t from = atomic_load_explicit(&m->ends[i], memory_order_relaxed),
                       to = atomic_load_explicit(&m->ends[i + 1], memory_order_relaxed);
        zr_ray_sort(m->crossings + from, to - from, m->spare + from, m->cancel);
    }
}

/* Counts the crossings of a grid, and takes room for them. False: it is too fine, or cancelled. */
static bool count(const struct zr_run *run, struct making *m, uint32_t rays)
{
    const size_t bytes = ((size_t)rays + 1) * sizeof *m->ends;
    uint64_t sum = 0;
    if (zr_arena_block_bytes(bytes) > zr_arena_left(run->arena)) return false;
    m->ends = zr_arena_zero(run->arena, (size_t)rays + 1, sizeof *m->ends);
    if (!m->ends) return false;
    add_all(run->team, m);
    if (atomic_load(&m->work) > m->work_most || zr_is_cancelled(m->cancel)) return false;
    for (uint32_t i = 0; i <= rays; i++) {
        sum += atomic_load_explicit(&m->ends[i], memory_order_relaxed);
        atomic_store_explicit(&m->ends[i], (uint32_t)sum, memory_order_relaxed);
    }
    const size_t half = zr_arena_left(run->arena) / 2; /* sizes may have 32 bits */
    if (sum > UINT32_MAX || sum > half / sizeof *m->crossings) return false;
    if (zr_arena_block_bytes((size_t)sum * sizeof *m->crossings) > half) return false;
    m->crossings = zr_arena_alloc(run->arena, sum, sizeof *m->crossings);
    return m->crossings;
}

/* The box around both solids. */
static void begin_grid(const struct zr_solid *a, const struct zr_solid *b, int direction, struct zr_ray_grid *grid)
{
    double half[3], middle[3];
    for (int k = 0; k < 3; k++) {
        double min = a->min[k], max = a->max[k];
        if (a->count == 0 || (b->count > 0 && b->min[k] < min)) min = b->min[k];
        if (a->count == 0 || (b->count > 0 && b->max[k] > max)) max = b->max[k];
        half[k] = 0.5 * (max - min);
        middle[k] = 0.5 * (min + max);
    }
    grid->middle = (struct zr_world_place){middle[0], middle[1], middle[2]};
    zr_ray_grid_turn(grid, direction, half);
}

enum zr_status zr_ray_lists_make(const struct zr_run *run, const struct zr_solid *a, const struct zr_solid *b,
                                 int direction, uint32_t rays, struct zr_ray_lists *out)
{
    bool is_ready = false;
    struct making m = {.cancel = run->cancel, .solids = {a, b}, .grid = &out->grid};
    *out = (struct zr_ray_lists){.begins = NULL};
    begin_grid(a, b, direction, &out->grid);
    m.met = zr_arena_alloc(run->arena, (size_t)a->count + b->count, sizeof *m.met);
    if (!m.met || !see_places(run, run->arena, &m)) return ZR_NO_MEMORY;
    for (; rays > 0 && !is_ready && !zr_is_cancelled(run->cancel); rays /= 2) {
        zr_ray_grid_divide(&out->grid, rays);
        m.work_most = work_most_of(&m, rays);
        m.crossings = NULL;
        is_ready = count(run, &m, out->grid.columns * out->grid.rows);
    }
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    if (!is_ready) return ZR_NO_MEMORY;
    const uint32_t all = out->grid.columns * out->grid.rows,
                   crossings = atomic_load_explicit(&m.ends[all], memory_order_relaxed);
    m.work_most = UINT64_MAX;
    add_all(run->team, &m);
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    m.spare = zr_arena_alloc(&scratch, crossings, sizeof *m.spare);
    if (m.spare) zr_team_ranges(run->team, all, RAYS_PER_RANGE, sort_range, &m);
    zr_arena_close_scratch(&scratch, run->arena);
    out->begins = (const uint32_t *)(const void *)m.ends;
    out->crossings = m.crossings;
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : zr_arena_ok(run->arena) ? ZR_OK : ZR_NO_MEMORY;
}

enum zr_status zr_ray_hits_make(const struct zr_run *run, const struct zr_solid *a, const struct zr_solid *b,
                                int direction, uint32_t rays, struct zr_ray_hits *out)
{
    bool is_ready = false;
    struct making m = {.cancel = run->cancel, .solids = {a, b}, .grid = &out->grid};
    *out = (struct zr_ray_hits){.hits = NULL};
    begin_grid(a, b, direction, &out->grid);
    if (!see_places(run, run->arena, &m)) return ZR_NO_MEMORY;
    for (; rays > 0 && !is_ready && !zr_is_cancelled(run->cancel); rays /= 2) {
        zr_ray_grid_divide(&out->grid, rays);
        m.work_most = work_most_of(&m, rays);
        m.hits = zr_arena_zero(run->arena, (size_t)out->grid.columns * out->grid.rows, sizeof *m.hits);
        if (!m.hits) return ZR_NO_MEMORY;
        add_all(run->team, &m);
        is_ready = atomic_load(&m.work) <= m.work_most;
    }
    out->hits = (const uint8_t *)(const void *)m.hits;
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : is_ready ? ZR_OK : ZR_NO_MEMORY;
}

struct zr_ray_walk zr_ray_walk_begin(const struct zr_ray_lists *lists, uint32_t ray)
{
    struct zr_ray_walk walk = {.grid = &lists->grid,
                               .at = lists->crossings + lists->begins[ray],
                               .end = lists->crossings + lists->begins[ray + 1]};
    int sums[2] = {0, 0};
    for (const uint64_t *at = walk.at; at < walk.end; at++)
        sums[zr_crossing_is_b(*at)] += zr_crossing_sign(*at);
    if (sums[0] != 0 || sums[1] != 0) walk.at = walk.end;
    return walk;
}
