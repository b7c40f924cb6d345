#include "measure/deviation.h"

#include <stdatomic.h>
#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/team.h"
#include "measure/surface_points.h"
#include "mesh/facts/ray_grid.h"

enum { POINTS_PER_TASK = 256, QUERIES_PER_CANCEL_CHECK = 64, TRIANGLES_PER_CANCEL_CHECK = 1 << 14 };

/* Steps beside the surface at which a wall is tested, relative to the diagonal. */
#define BESIDE 1e-6

/* Sums of a task. */
struct sums {
    double mean, abs, square, alignment;
    uint32_t points, within;
    double max; /* magnitude */
    double signed_max;
    struct zr_world_place at;
};

struct measuring {
    const struct zr_cancel *cancel;
    const struct zr_deviation_side *from, *to;
    double threshold_square;
    bool is_signed;
    uint32_t count;
    struct zr_surface_point *points;
    uint64_t *distances;  /* bits of those without sign; UINT64_MAX: left out */
    uint64_t *spare;      /* for sorting */
    struct sums *sums;    /* per task */
    double reached;       /* largest of the points, before corners */
    const uint32_t *uses; /* corners: a triangle of each place; UINT32_MAX: none */
    atomic_bool is_stopped;
    _Atomic uint64_t steps; /* of all tasks so far */
    uint64_t steps_most;
};

/* ---- distances ---- */

/* Work of one task. */
struct working {
    struct measuring *m;
    struct zr_surface_hit hit;
    struct zr_surface_ball ball; /* of the last point, in the other solid */
    uint64_t steps, queries;
};

static bool goes_on(struct working *w)
{
    struct measuring *m = w->m;
    if (w->steps > (uint64_t)ZR_DEVIATION_STEPS * POINTS_PER_TASK)
        atomic_store_explicit(&m->is_stopped, true, memory_order_relaxed);
    if (w->queries++ % QUERIES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(m->cancel)) return false;
    return !atomic_load_explicit(&m->is_stopped, memory_order_relaxed);
}

/* Adds the steps of a task that has ended. */
static void add_steps(struct working *w)
{
    struct measuring *m = w->m;
    if (atomic_fetch_add_explicit(&m->steps, w->steps, memory_order_relaxed) + w->steps > m->steps_most)
        atomic_store_explicit(&m->is_stopped, true, memory_order_relaxed);
}

/* Returns true if a point lies on a wall inside its own solid. */
static bool is_inner(struct working *w, struct zr_world_place at, uint32_t triangle)
{
    const struct zr_deviation_side *own = w->m->from;
    if (!own->has_overlap) return false;
    const struct zr_solid *solid = own->tree->solid;
    const struct zr_world_place n = zr_surface_normal(solid, triangle);
    const double step = BESIDE * solid->diagonal;
    const struct zr_world_place before = {at.x + n.x * step, at.y + n.y * step, at.z + n.z * step},
                                behind = {at.x - n.x * step, at.y - n.y * step, at.z - n.z * step};
    return zr_surface_tree_winding(own->tree, before, &w->steps) != 0 &&
           zr_surface_tree_winding(own->tree, behind, &w->steps) != 0;
}

static double signed_of(struct working *w, struct zr_world_place at, double distance)
{
    if (!w->m->is_signed || distance == 0.0) return distance;
    const int winding = zr_surface_tree_winding_beside(w->m->to->tree, at, distance, &w->ball, &w->steps);
    return winding != 0 ? -distance : distance;
}

static void take_largest(struct sums *sums, double distance, double with_sign, struct zr_world_place at)
{
    if (distance <= sums->max) return;
    sums->max = distance;
    sums->signed_max = with_sign;
    sums->at = at;
}

static void add_point(struct working *w, uint32_t number, struct sums *sums)
{
    struct measuring *m = w->m;
    const struct zr_surface_point *point = &m->points[number];
    if (is_inner(w, point->at, point->triangle)) return;
    zr_surface_tree_nearest(m->to->tree, point->at, -1.0, &w->hit, &w->steps);
    const double distance = sqrt(w->hit.square), with_sign = signed_of(w, point->at, distance);
    const double cosine = fabs(zr_world_place_dot(zr_surface_normal(m->from->tree->solid, point->triangle),
                                                  zr_surface_normal(m->to->tree->solid, w->hit.triangle)));
    memcpy(&m->distances[number], &distance, sizeof distance);
    sums->points++;
    sums->mean += with_sign;
    sums->abs += distance;
    sums->square += w->hit.square;
    sums->alignment += cosine;
    sums->within += w->hit.square <= m->threshold_square && cosine >= ZR_DEVIATION_ALIKE;
    take_largest(sums, distance, with_sign, point->at);
}

static void run_points(void *context, size_t begin, size_t end)
{
    struct measuring *m = context;
    for (size_t task = begin; task < end; task++) {
        struct working w = {.m = m};
        const size_t first = task * POINTS_PER_TASK;
        for (size_t i = first; i < m->count && i < first + POINTS_PER_TASK && goes_on(&w); i++)
            add_point(&w, (uint32_t)i, &m->sums[task]);
        add_steps(&w);
    }
}

/* Looks for a larger distance at a corner. */
static void add_corner(struct working *w, uint32_t number, struct sums *sums)
{
    struct measuring *m = w->m;
    if (m->uses[number] == UINT32_MAX) return;
    const struct zr_world_place at = m->from->tree->solid->places[number];
    zr_surface_tree_nearest(m->to->tree, at, sums->max * sums->max, &w->hit, &w->steps);
    const double distance = sqrt(w->hit.square);
    if (distance <= sums->max || is_inner(w, at, m->uses[number])) return;
    take_largest(sums, distance, signed_of(w, at, distance), at);
}

static void run_corners(void *context, size_t begin, size_t end)
{
    struct measuring *m = context;
    const uint32_t count = m->from->tree->solid->place_count;
    for (size_t task = begin; task < end; task++) {
        struct working w = {.m = m};
        const size_t first = task * POINTS_PER_TASK;
        m->sums[task] = (struct sums){.max = m->reached};
        for (size_t i = first; i < count && i < first + POINTS_PER_TASK && goes_on(&w); i++)
            add_corner(&w, (uint32_t)i, &m->sums[task]);
        add_steps(&w);
    }
}

/* ---- results ---- */

static void add_sums(const struct sums *own, struct sums *all)
{
    all->mean += own->mean;
    all->abs += own->abs;
    all->square += own->square;
    all->alignment += own->alignment;
    all->points += own->points;
    all->within += own->within;
    take_largest(all, own->max, own->signed_max, own->at);
}

/* Returns the distance that 95 % of the points do not exceed. */
static double find_p95(struct measuring *m, uint32_t points)
{
    double value;
    if (points == 0) return 0.0;
    zr_ray_sort(m->distances, m->count, m->spare, m->cancel); /* bits of positive numbers have their order */
    memcpy(&value, &m->distances[(uint64_t)(points - 1) * 95 / 100], sizeof value);
    return value;
}

static void measure_points(struct zr_team *team, struct measuring *m, struct sums *all, struct zr_deviation *out)
{
    const size_t tasks = (m->count + POINTS_PER_TASK - 1) / POINTS_PER_TASK;
    memset(m->distances, 0xff, m->count * sizeof *m->distances);
    memset(m->sums, 0, tasks * sizeof *m->sums);
    zr_team_ranges(team, tasks, 1, run_points, m);
    for (size_t i = 0; i < tasks; i++)
        add_sums(&m->sums[i], all);
    const double points = all->points > 0 ? (double)all->points : 1.0;
    *out = (struct zr_deviation){.is_signed = m->is_signed, .points = all->points};
    out->mean = all->mean / points;
    out->abs = all->abs / points;
    out->square = all->square / points;
    out->rms = sqrt(out->square);
    out->within = (double)all->within / points;
    out->alignment = all->alignment / points;
    out->p95 = find_p95(m, all->points);
}

static void measure_corners(struct zr_team *team, struct measuring *m, struct sums *all)
{
    const size_t tasks = ((size_t)m->from->tree->solid->place_count + POINTS_PER_TASK - 1) / POINTS_PER_TASK;
    m->reached = all->max;
    zr_team_ranges(team, tasks, 1, run_corners, m);
    for (size_t i = 0; i < tasks; i++)
        take_largest(all, m->sums[i].max, m->sums[i].signed_max, m->sums[i].at);
}

/* Lists a triangle of each place. */
static uint32_t *list_uses(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_solid *solid)
{
    uint32_t *uses = zr_arena_alloc(arena, solid->place_count, sizeof *uses);
    if (!uses) return NULL;
    memset(uses, 0xff, solid->place_count * sizeof *uses);
    for (uint32_t t = solid->count; t-- > 0 && (t % TRIANGLES_PER_CANCEL_CHECK > 0 || !zr_is_cancelled(cancel));)
        for (int k = 0; k < 3; k++)
            uses[solid->corners[t][k]] = t;
    return uses;
}

static enum zr_status measure(const struct zr_run *run, struct zr_arena *scratch, struct measuring *m, uint32_t points,
                              struct zr_deviation *out)
{
    const struct zr_solid *solid = m->from->tree->solid;
    const uint32_t most = points > solid->place_count ? points : solid->place_count;
    struct sums all = {.points = 0};
    m->steps_most =
        ZR_DEVIATION_STEPS_LEAST + (uint64_t)ZR_DEVIATION_STEPS_MEAN * ((uint64_t)points + solid->place_count);
    m->points = zr_arena_alloc(scratch, points, sizeof *m->points);
    m->distances = zr_arena_alloc(scratch, points, sizeof *m->distances);
    m->spare = zr_arena_alloc(scratch, points, sizeof *m->spare);
    m->sums = zr_arena_alloc(scratch, (size_t)most / POINTS_PER_TASK + 1, sizeof *m->sums);
    m->uses = list_uses(scratch, run->cancel, solid);
    if (!zr_arena_ok(scratch)) return ZR_NO_MEMORY;
    m->count = zr_surface_points_place(solid, run->cancel, points, m->points);
    measure_points(run->team, m, &all, out);
    measure_corners(run->team, m, &all);
    out->max = all.signed_max;
    out->at = all.at;
    if (atomic_load(&m->is_stopped)) *out = (struct zr_deviation){.is_omitted = true};
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}

enum zr_status zr_deviation_find(const struct zr_run *run, const struct zr_deviation_side *from,
                                 const struct zr_deviation_side *to, uint32_t points, double threshold,
                                 struct zr_deviation *out)
{
    *out = (struct zr_deviation){.is_omitted = true};
    if (from->tree->leaf_count == 0 || to->tree->leaf_count == 0) return ZR_OK;
    struct measuring m = {.cancel = run->cancel,
                          .from = from,
                          .to = to,
                          .threshold_square = threshold * threshold,
                          .is_signed = to->tree->solid->is_closed};
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const enum zr_status status = measure(run, &scratch, &m, points, out);
    zr_arena_close_scratch(&scratch, run->arena);
    return status;
}
