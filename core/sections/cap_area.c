#include "sections/cap_area.h"

#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/sort.h"
#include "mesh/world_place.h"

enum { CORNERS_PER_CANCEL_CHECK = 1 << 12 };

/* Steps along a row, from one end of the cap to the other: a crossing is a step and a sign. */
#define STEPS 0x1p60

/* Cosine and sine of 19.1 degrees: rows lie along no side of a rectangle. */
#define OBLIQUE_COS 0.94494978
#define OBLIQUE_SIN 0.32721786

struct point {
    double u, v;
};

struct walk {
    const struct zr_run *run;
    const struct zr_mesh *mesh;
    const zr_mat4 *object_to_world;
    struct zr_rings rings;
    struct zr_world_place origin, u, v;
    struct point low, high;
    uint32_t rows;
    uint32_t *ends; /* per row: end of its crossings; while they are put, their begin */
    uint64_t *crossings, count, count_most;
};

/* Integrals of the winding number w, and of 1 where it is not 0. */
struct sums {
    double winding, inside;
    bool has_positive, has_negative, has_excess;
};

static bool is_due(const struct walk *w, uint64_t i)
{
    return i % CORNERS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(w->run->cancel);
}

static struct zr_world_place place_of(const struct walk *w, uint32_t corner)
{
    struct zr_world_place at;
    zr_world_place_of(w->object_to_world, w->mesh->positions[w->mesh->indices[corner]], &at);
    return zr_world_place_minus(at, w->origin);
}

/* ---- the plane ---- */

/* Returns the area vectors' sum, and finds that of the largest ring. */
static struct zr_world_place sum_rings(const struct walk *w, struct zr_world_place *largest)
{
    struct zr_world_place sum = {0, 0, 0};
    *largest = sum;
    for (uint32_t r = 0; r < w->rings.count; r++) {
        const uint32_t begin = w->rings.offsets[r], end = w->rings.offsets[r + 1];
        struct zr_world_place own = {0, 0, 0}, last = place_of(w, end - 1);
        for (uint32_t i = begin; i < end && !is_due(w, i); i++) {
            const struct zr_world_place at = place_of(w, i), area = zr_world_place_cross(last, at);
            own = (struct zr_world_place){own.x + 0.5 * area.x, own.y + 0.5 * area.y, own.z + 0.5 * area.z};
            last = at;
        }
        sum = (struct zr_world_place){sum.x + own.x, sum.y + own.y, sum.z + own.z};
        if (zr_world_place_dot(own, own) > zr_world_place_dot(*largest, *largest)) *largest = own;
    }
    return sum;
}

static struct zr_world_place unit(struct zr_world_place a)
{
    const double length = sqrt(zr_world_place_dot(a, a));
    return (struct zr_world_place){a.x / length, a.y / length, a.z / length};
}

static void find_axes(struct walk *w, struct zr_world_place n)
{
    const double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    const struct zr_world_place axis = {x <= y && x <= z, y < x && y <= z, z < x && z < y},
                                a = unit(zr_world_place_cross(axis, n)), b = zr_world_place_cross(n, a);
    w->u = (struct zr_world_place){OBLIQUE_COS * a.x + OBLIQUE_SIN * b.x, OBLIQUE_COS * a.y + OBLIQUE_SIN * b.y,
                                   OBLIQUE_COS * a.z + OBLIQUE_SIN * b.z};
    w->v = zr_world_place_cross(n, w->u);
}

static struct point point_of(const struct walk *w, uint32_t corner)
{
    const struct zr_world_place at = place_of(w, corner);
    return (struct point){zr_world_place_dot(w->u, at), zr_world_place_dot(w->v, at)};
}

static void find_extent(struct walk *w)
{
    w->low = (struct point){HUGE_VAL, HUGE_VAL};
    w->high = (struct point){-HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = w->rings.offsets[0]; i < w->rings.offsets[w->rings.count] && !is_due(w, i); i++) {
        const struct point p = point_of(w, i);
        w->low = (struct point){zr_least_of(w->low.u, p.u), zr_least_of(w->low.v, p.v)};
        w->high = (struct point){zr_most_of(w->high.u, p.u), zr_most_of(w->high.v, p.v)};
    }
}

/* ---- rows ---- */

static double height_of(const struct walk *w, uint32_t row)
{
    return w->low.v + (w->high.v - w->low.v) * (((double)row + 0.5) / (double)w->rows);
}

/* Returns the first row above a height, or one below that. */
static uint32_t row_near(const struct walk *w, double v)
{
    const double at = (v - w->low.v) / (w->high.v - w->low.v) * (double)w->rows - 1.0;
    return at > 0.0 ? at < (double)w->rows ? (uint32_t)at : w->rows : 0;
}

static void put(struct walk *w, uint32_t row, struct point low, struct point high, bool rises)
{
    const double u = low.u + (height_of(w, row) - low.v) * (high.u - low.u) / (high.v - low.v);
    const double step = (u - w->low.u) / (w->high.u - w->low.u) * STEPS;
    w->crossings[--w->ends[row]] = (uint64_t)(step > 0.0 ? step < STEPS ? step : STEPS : 0.0) << 1 | (rises ? 0u : 1u);
}

/* Counts the rows that an edge crosses, or puts its crossings there. */
static void visit_edge(struct walk *w, struct point a, struct point b)
{
    const bool rises = a.v < b.v;
    const struct point low = rises ? a : b, high = rises ? b : a;
    for (uint32_t row = row_near(w, low.v); row < w->rows && height_of(w, row) < high.v; row++) {
        if (height_of(w, row) < low.v) continue;
        if (w->crossings)
            put(w, row, low, high, rises);
        else
            w->ends[row]++;
        if (is_due(w, ++w->count) || w->count > w->count_most) return;
    }
}

/* Returns false if the crossings are too many, or if cancelled. */
static bool visit_edges(struct walk *w)
{
    w->count = 0;
    for (uint32_t r = 0; r < w->rings.count; r++) {
        const uint32_t begin = w->rings.offsets[r], end = w->rings.offsets[r + 1];
        struct point last = point_of(w, end - 1);
        for (uint32_t i = begin; i < end; i++) {
            const struct point at = point_of(w, i);
            if (is_due(w, i) || w->count > w->count_most) return false;
            visit_edge(w, last, at);
            last = at;
        }
    }
    return w->count <= w->count_most && !zr_is_cancelled(w->run->cancel);
}

/* Counts the crossings of all rows and makes the counts ends. */
static bool count_rows(struct walk *w)
{
    memset(w->ends, 0, w->rows * sizeof *w->ends);
    w->crossings = NULL;
    if (!visit_edges(w)) return false;
    for (uint32_t row = 1; row < w->rows; row++)
        w->ends[row] += w->ends[row - 1];
    return true;
}

/* Adds the runs of a row. A row is as wide as 1. */
static void add_row(const uint64_t *at, uint32_t count, struct sums *sums)
{
    int winding = 0;
    for (uint32_t i = 0; i + 1 < count; i++) {
        winding += at[i] & 1u ? 1 : -1;
        const double length = (double)((at[i + 1] >> 1) - (at[i] >> 1)) / STEPS;
        if (winding == 0 || length <= 1e-9) continue; /* rings that touch */
        sums->winding += winding * length;
        sums->inside += length;
        sums->has_positive = sums->has_positive || winding > 0;
        sums->has_negative = sums->has_negative || winding < 0;
        sums->has_excess = sums->has_excess || winding < -1 || winding > 1;
    }
}

static bool sum_rows(struct walk *w, struct sums *sums)
{
    const uint32_t total = w->rows > 0 ? w->ends[w->rows - 1] : 0;
    w->crossings = zr_arena_alloc(w->run->arena, (size_t)total + 1, sizeof *w->crossings);
    if (!w->crossings || !visit_edges(w)) return false;
    for (uint32_t row = 0; row < w->rows && !zr_is_cancelled(w->run->cancel); row++) {
        const uint32_t begin = w->ends[row], end = row + 1 < w->rows ? w->ends[row + 1] : total;
        zr_sort_u64(w->crossings + begin, end - begin);
        add_row(w->crossings + begin, end - begin, sums);
    }
    return true;
}

/* Finds the sums over the finest rows that the work allows. */
static bool walk_rows(struct walk *w, struct sums *sums)
{
    const uint32_t corners = w->rings.offsets[w->rings.count] - w->rings.offsets[0];
    w->count_most = ZR_CAP_WORK + (uint64_t)ZR_CAP_WORK_OF_CORNER * corners;
    w->ends = zr_arena_alloc(w->run->arena, ZR_CAP_ROWS, sizeof *w->ends);
    if (!w->ends) return false;
    for (w->rows = ZR_CAP_ROWS; w->rows > 1; w->rows /= 2) {
        if (count_rows(w)) return sum_rows(w, sums);
        if (zr_is_cancelled(w->run->cancel)) return false;
    }
    return true;
}

bool zr_cap_area_find(const struct zr_run *run, const struct zr_mesh *mesh, uint32_t cap,
                      const zr_mat4 *object_to_world, double *area)
{
    const uint32_t face = mesh->face_count - mesh->cap_count + cap;
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const struct zr_run inner = zr_run_in(run, &scratch);
    struct walk w = {.run = &inner, .mesh = mesh, .object_to_world = object_to_world};
    struct zr_world_place largest, origin;
    struct sums sums = {.winding = 0.0};
    w.rings = zr_mesh_rings(mesh, face);
    zr_world_place_of(object_to_world, mesh->positions[mesh->indices[mesh->face_offsets[face]]], &origin);
    w.origin = origin;
    const struct zr_world_place sum = sum_rings(&w, &largest);
    *area = sqrt(zr_world_place_dot(sum, sum));
    bool is_done = true;
    if (zr_world_place_dot(largest, largest) > 0.0) {
        const struct zr_world_place n = unit(largest);
        find_axes(&w, n);
        find_extent(&w);
        is_done = walk_rows(&w, &sums);
        if (sums.has_excess || (sums.has_positive && sums.has_negative)) {
            const double whole = (w.high.u - w.low.u) * (w.high.v - w.low.v) / (double)w.rows;
            const double sign = sums.has_positive ? 1.0 : -1.0;
            *area = fabs(zr_world_place_dot(sum, n) - (sums.winding - sign * sums.inside) * whole);
        }
    }
    zr_arena_close_scratch(&scratch, run->arena);
    return is_done;
}
