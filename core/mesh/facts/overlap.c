#include "mesh/facts/overlap.h"

#include <string.h>

#include "mesh/facts/closed_parts.h"
#include "mesh/facts/ray_grid.h"

enum {
    QUICK_MOST = 128, /* rays along the longest side of the quick grid, and least of it */
    QUICK_LEAST = 32,
    FINE = 256,
    WORK_PER_CANCEL_CHECK = 1 << 12,
    SMALL = 1 << 18, /* bytes; smaller grids get blocks of SMALL_UNIT, so that the system clears fewer pages */
    SMALL_UNIT = 1 << 12,
    HEIGHT_SHIFT = 16, /* a crossing: height, 15 bits of |cosine|, sign */
    COSINES = (1 << 15) - 1
};

/* Intervals up to this thickness do not count, relative to the diagonal. */
#define THIN 1e-6

/* Share of the changes between neighbouring rays in the error. */
#define CHANGES 0.02

/* Measures of the intervals on a ray: integrals of w, and of 1 where w is not 0. */
struct lengths {
    double winding, inside;
};

/* Sums over rays, times the area of a ray's cell; moments along u, v and d. */
struct sums {
    struct lengths volume, moment[3];
    bool has_positive, has_negative, has_excess;
};

struct walk {
    struct zr_arena *arena;
    const struct zr_cancel *cancel;
    const struct zr_wall_faces *faces;
    struct zr_ray_grid grid;
    double thin;
    uint32_t *ends; /* per ray: end of its crossings, and before they are put, their begin */
    uint64_t *crossings, *spare;
    struct lengths *lengths; /* per ray */
    uint64_t work, work_most, work_of_grid, next_look;
    bool is_stopped;
    uint32_t last_rays; /* of the last grid that was walked; 0: none */
    uint64_t last_work;
};

static bool has_work(struct walk *w, uint64_t work)
{
    w->work += work;
    if (w->work > w->work_most) w->is_stopped = true;
    if (w->work >= w->next_look) {
        w->next_look = w->work + WORK_PER_CANCEL_CHECK;
        if (zr_is_cancelled(w->cancel)) w->is_stopped = true;
    }
    return !w->is_stopped;
}

/* ---- triangles ---- */

typedef void visit_fn(struct walk *w, const struct zr_ray_facet *facet, uint32_t row, uint32_t column, int sign);

/* Visits the rays that cross a triangle. */
static void visit_facet(struct walk *w, const struct zr_ray_facet *f, visit_fn *visit)
{
    uint32_t begin, end;
    zr_ray_rows(&w->grid, f, &begin, &end);
    if (!has_work(w, 1 + (uint64_t)(end - begin))) return;
    for (uint32_t row = begin; row < end; row++) {
        uint32_t rise, fall;
        if (!zr_ray_columns(&w->grid, f, row, &rise, &fall)) continue;
        const uint32_t from = rise < fall ? rise : fall, to = rise < fall ? fall : rise;
        if (!has_work(w, to - from)) return;
        for (uint32_t column = from; column < to; column++)
            visit(w, f, row, column, rise > fall ? -1 : 1);
    }
}

static struct zr_world_place place_of(const struct walk *w, uint32_t corner)
{
    const struct zr_wall_faces *faces = w->faces;
    struct zr_world_place at;
    zr_world_place_of(faces->object_to_world, faces->mesh->positions[faces->mesh->indices[corner]], &at);
    return zr_world_place_minus(at, w->grid.middle);
}

static void visit_ring(struct walk *w, uint32_t begin, uint32_t end, bool is_turned, visit_fn *visit)
{
    struct zr_ray_facet f;
    zr_ray_facet_put(&w->grid, place_of(w, begin), &f, 0);
    const int first = is_turned ? 2 : 1, last = 3 - first;
    for (uint32_t i = begin + 1; i + 1 < end && !w->is_stopped; i++) {
        zr_ray_facet_put(&w->grid, place_of(w, i), &f, first);
        zr_ray_facet_put(&w->grid, place_of(w, i + 1), &f, last);
        zr_ray_facet_plane(&f);
        visit_facet(w, &f, visit);
    }
}

static void visit_all(struct walk *w, visit_fn *visit)
{
    const struct zr_wall_faces *faces = w->faces;
    for (uint32_t i = faces->begin; i < faces->end && !w->is_stopped; i++) {
        const struct zr_rings rings = zr_mesh_rings(faces->mesh, faces->faces ? faces->faces[i] : i);
        for (uint32_t r = 0; r < rings.count; r++)
            visit_ring(w, rings.offsets[r], rings.offsets[r + 1],
                       r > 0 && zr_ring_turns_as_first(faces->mesh, &rings, r), visit);
    }
}

static void count_crossing(struct walk *w, const struct zr_ray_facet *f, uint32_t row, uint32_t column, int sign)
{
    (void)f;
    (void)sign;
    w->ends[row * w->grid.columns + column]++;
}

/* Puts the height of a triangle on a ray, within those of its corners. */
static void put_crossing(struct walk *w, const struct zr_ray_facet *f, uint32_t row, uint32_t column, int sign)
{
    w->crossings[--w->ends[row * w->grid.columns + column]] = zr_ray_height(&w->grid, f, row, column) << HEIGHT_SHIFT |
                                                              (uint64_t)(f->cosine * (double)COSINES + 0.5) << 1 |
                                                              (sign > 0 ? 1u : 0u);
}

/* ---- rays ---- */

static double cosine_of(uint64_t crossing)
{
    return (double)(crossing >> 1 & COSINES) / (double)COSINES;
}

static void add_interval(double from, double to, int winding, struct lengths *length, struct lengths *moment)
{
    const double middle = 0.5 * (from + to), own = to - from;
    length->winding += (double)winding * own;
    length->inside += own;
    moment->winding += (double)winding * own * middle;
    moment->inside += own * middle;
}

/* Adds a ray to the sums. A ray on which the winding number does not come back to 0, as between corners that are only
 * nearly equal, does not count. */
static void add_ray(struct walk *w, uint32_t ray, const uint64_t *at, uint32_t count, struct sums *sums)
{
    const double unit = 2.0 * w->grid.half[2] / ZR_RAY_HEIGHTS;
    struct lengths length = {0, 0}, moment = {0, 0};
    bool positive = false, negative = false;
    int winding = 0;
    for (uint32_t i = 0; i < count; i++) {
        winding += at[i] & 1u ? 1 : -1;
        if (winding == 0 || i + 1 == count) continue;
        const double from = (double)(at[i] >> HEIGHT_SHIFT) * unit, to = (double)(at[i + 1] >> HEIGHT_SHIFT) * unit;
        if ((to - from) * zr_least_of(cosine_of(at[i]), cosine_of(at[i + 1])) <= w->thin) continue;
        add_interval(from - w->grid.half[2], to - w->grid.half[2], winding, &length, &moment);
        positive = positive || winding > 0;
        negative = negative || winding < 0;
    }
    if (winding != 0) return;
    const double middle[2] = {((double)(ray % w->grid.columns) + 0.5) * w->grid.width - w->grid.half[0],
                              ((double)(ray / w->grid.columns) + 0.5) * w->grid.height - w->grid.half[1]};
    w->lengths[ray] = length;
    sums->has_positive = sums->has_positive || positive;
    sums->has_negative = sums->has_negative || negative;
    sums->has_excess = sums->has_excess || fabs(length.winding) != length.inside;
    sums->volume.winding += length.winding;
    sums->volume.inside += length.inside;
    for (int k = 0; k < 2; k++) {
        sums->moment[k].winding += length.winding * middle[k];
        sums->moment[k].inside += length.inside * middle[k];
    }
    sums->moment[2].winding += moment.winding;
    sums->moment[2].inside += moment.inside;
}

/* ---- grids ---- */

static void begin_grid(struct walk *w, uint32_t rays)
{
    zr_ray_grid_divide(&w->grid, rays);
    w->work_most = rays > 1 ? w->work_of_grid : UINT64_MAX;
    w->is_stopped = false;
    w->work = w->next_look = 0;
}

/* Makes the counts of crossings to ends, and finds the largest. */
static size_t sum_counts(struct walk *w, uint32_t rays, uint32_t *most)
{
    size_t sum = 0;
    *most = 0;
    for (uint32_t i = 0; i < rays; i++) {
        if (w->ends[i] > *most) *most = w->ends[i];
        sum += w->ends[i];
        w->ends[i] = (uint32_t)sum;
    }
    return sum;
}

/* Returns the work of sorting crossings, of which a ray has up to `most`: none for usual depths. */
static uint64_t work_of_sorting(size_t count, uint32_t most)
{
    uint64_t doublings = 0;
    for (; most > 8; most /= 2)
        doublings++;
    return count * doublings / 8;
}

/* Counts the crossings of a grid, and takes room for them. False if it is too fine. */
static bool count_crossings(struct walk *w)
{
    const uint32_t rays = w->grid.columns * w->grid.rows;
    uint32_t most;
    const size_t own = rays * (sizeof *w->ends + sizeof *w->lengths);
    if (zr_arena_block_bytes(own) > zr_arena_left(w->arena)) return false;
    w->arena->unit = own < SMALL ? SMALL_UNIT : ZR_ARENA_BLOCK;
    w->lengths = zr_arena_zero(w->arena, rays, sizeof *w->lengths + sizeof *w->ends);
    if (!w->lengths) return false;
    w->ends = (uint32_t *)(void *)(w->lengths + rays);
    visit_all(w, count_crossing);
    if (w->is_stopped) return false;
    const size_t count = sum_counts(w, rays, &most), bytes = (count + most) * sizeof *w->crossings;
    if (!has_work(w, work_of_sorting(count, most))) return false;
    if (count > UINT32_MAX || zr_arena_block_bytes(bytes) > zr_arena_left(w->arena)) return false;
    w->crossings = zr_arena_alloc(w->arena, count + most, sizeof *w->crossings);
    w->spare = w->crossings + count;
    return w->crossings;
}

static void add_rays(struct walk *w, struct sums *sums)
{
    const uint32_t rays = w->grid.columns * w->grid.rows, end_of_all = (uint32_t)(w->spare - w->crossings);
    w->work = w->next_look = 0;
    visit_all(w, put_crossing);
    for (uint32_t i = 0; i < rays && !w->is_stopped; i++) {
        const uint32_t begin = w->ends[i], end = i + 1 < rays ? w->ends[i + 1] : end_of_all;
        zr_ray_sort(w->crossings + begin, end - begin, w->spare, w->cancel);
        if (end - begin > WORK_PER_CANCEL_CHECK) w->next_look = w->work;
        if (has_work(w, 0)) add_ray(w, i, w->crossings + begin, end - begin, sums);
    }
}

static double excess_of(const struct lengths *lengths, double sign)
{
    return lengths->winding - sign * lengths->inside;
}

/* Returns the sum of half a cell times the largest difference of the excess between neighbouring rays. */
static double changes_of(const struct walk *w, double sign)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < w->grid.columns * w->grid.rows; i++) {
        const uint32_t row = i / w->grid.columns, column = i % w->grid.columns;
        const uint32_t others[4] = {column > 0 ? i - 1 : i, column + 1 < w->grid.columns ? i + 1 : i,
                                    row > 0 ? i - w->grid.columns : i,
                                    row + 1 < w->grid.rows ? i + w->grid.columns : i};
        double most = 0.0;
        for (int k = 0; k < 4; k++)
            most = zr_most_of(most, fabs(excess_of(&w->lengths[i], sign) - excess_of(&w->lengths[others[k]], sign)));
        sum += most;
    }
    return 0.5 * sum * w->grid.width * w->grid.height;
}

/* True if a grid takes too much work, by that of the last one. Crossings grow with the square of the rays. */
static bool is_too_fine(const struct walk *w, uint32_t rays)
{
    const double finer = (double)rays / (double)w->last_rays;
    return w->last_rays > 0 && rays > 1 && (double)w->last_work * finer * finer > (double)w->work_of_grid;
}

/* Walks along the rays of a grid, or of the finest coarser one that the work and the memory allow. False if cancelled
 * or without memory. */
static bool walk_grid(struct walk *w, uint32_t rays, struct sums *sums)
{
    bool is_ready = false;
    *sums = (struct sums){.has_excess = false};
    while (is_too_fine(w, rays))
        rays /= 2;
    for (; rays > 0 && !is_ready && !zr_is_cancelled(w->cancel); rays /= 2) {
        begin_grid(w, rays);
        is_ready = count_crossings(w);
        w->last_rays = rays;
        w->last_work = w->work;
    }
    if (is_ready) add_rays(w, sums);
    return is_ready && !w->is_stopped;
}

/* Measures the excess in one direction, and adds a third of it. */
static bool measure(struct walk *w, double sign, double *volume, struct zr_overlap *out)
{
    struct zr_arena *arena = w->arena, scratch = zr_arena_open_scratch(arena);
    struct sums sums;
    w->arena = &scratch;
    const bool is_done = walk_grid(w, FINE, &sums);
    if (is_done) {
        const double cell = w->grid.width * w->grid.height, u = excess_of(&sums.moment[0], sign) * cell,
                     v = excess_of(&sums.moment[1], sign) * cell, d = excess_of(&sums.moment[2], sign) * cell;
        *volume = excess_of(&sums.volume, sign) * cell;
        out->volume += *volume / 3.0;
        out->error += CHANGES * changes_of(w, sign) / 3.0;
        out->moment[0] += ((w->grid.u.x * u + w->grid.v.x * v) + w->grid.d.x * d) / 3.0;
        out->moment[1] += ((w->grid.u.y * u + w->grid.v.y * v) + w->grid.d.y * d) / 3.0;
        out->moment[2] += ((w->grid.u.z * u + w->grid.v.z * v) + w->grid.d.z * d) / 3.0;
    }
    w->arena = arena;
    zr_arena_close_scratch(&scratch, arena);
    return is_done;
}

/* Finds by a quick grid whether there is an excess, and its sign. */
static bool look(struct walk *w, double *sign, bool *is_found)
{
    struct zr_arena *arena = w->arena, scratch = zr_arena_open_scratch(arena);
    struct sums sums;
    uint32_t rays = QUICK_LEAST;
    while (rays < QUICK_MOST && rays * rays / 16 < w->faces->end - w->faces->begin)
        rays *= 2;
    w->arena = &scratch;
    const bool is_done = walk_grid(w, rays, &sums);
    *is_found = sums.has_excess || (sums.has_positive && sums.has_negative);
    *sign = sums.has_negative && !sums.has_positive ? -1.0 : 1.0;
    w->arena = arena;
    zr_arena_close_scratch(&scratch, arena);
    return is_done;
}

bool zr_overlap_find(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_wall_faces *faces,
                     const struct zr_overlap_box *box, struct zr_overlap *out)
{
    const double half[3] = {0.5 * (box->max[0] - box->min[0]), 0.5 * (box->max[1] - box->min[1]),
                            0.5 * (box->max[2] - box->min[2])};
    struct walk w = {.arena = arena, .cancel = cancel, .faces = faces, .work_of_grid = box->work};
    double sign, volumes[3];
    *out = (struct zr_overlap){.is_found = false};
    w.grid.middle = (struct zr_world_place){box->min[0] + half[0], box->min[1] + half[1], box->min[2] + half[2]};
    w.thin = 2.0 * THIN * sqrt((half[0] * half[0] + half[1] * half[1]) + half[2] * half[2]);
    if (w.thin == 0.0 || faces->end - faces->begin < ZR_OVERLAP_FACES_LEAST) return true;
    zr_ray_grid_turn(&w.grid, 0, half);
    if (!look(&w, &sign, &out->is_found)) return false;
    for (int i = 0; i < 3 && out->is_found; i++) {
        zr_ray_grid_turn(&w.grid, i, half);
        if (!measure(&w, sign, &volumes[i], out)) return false;
    }
    if (!out->is_found) return true;
    out->error += zr_most_of(volumes[0], zr_most_of(volumes[1], volumes[2])) -
                  zr_least_of(volumes[0], zr_least_of(volumes[1], volumes[2]));
    out->moment[0] += out->volume * (w.grid.middle.x - box->apex.x);
    out->moment[1] += out->volume * (w.grid.middle.y - box->apex.y);
    out->moment[2] += out->volume * (w.grid.middle.z - box->apex.z);
    return true;
}
