#include "mesh/facts/overlap.h"

#include <string.h>

#include "base/sort.h"
#include "mesh/facts/closed_parts.h"

enum {
    QUICK_MOST = 128, /* rays along the longest side of the quick grid, and least of it */
    QUICK_LEAST = 32,
    FINE = 256,
    SLENDER = 8, /* the shorter side has at least this part of the rays of the longer one */
    WORK_PER_CANCEL_CHECK = 1 << 12,
    SORTED_AT_ONCE = 1 << 12,
    SMALL = 1 << 18, /* bytes; smaller grids get blocks of SMALL_UNIT, so that the system clears fewer pages */
    SMALL_UNIT = 1 << 12,
    HEIGHT_SHIFT = 16, /* a crossing: height, 15 bits of |cosine|, sign */
    COSINES = (1 << 15) - 1
};

/* Steps of a height along a ray: 2^47 from one end of the box to the other. */
#define HEIGHTS 0x1p47

/* Intervals up to this thickness do not count, relative to the diagonal. */
#define THIN 1e-6

/* Share of the changes between neighbouring rays in the error. */
#define CHANGES 0.02

/* Directions of rays: rot((0.3, 0.5, 0.8), 37.3 degrees) rot((1, 0.2, 0.1), 19.1 degrees) */
static const struct zr_world_place axes[3] = {{0.77179749535245268, -0.33749036023969281, 0.53891454138199235},
                                              {0.56148016925650057, 0.75949794126626735, -0.32848576338099178},
                                              {-0.29844370608101645, 0.55611431734633843, 0.77567275338446939}};

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
    struct zr_world_place middle; /* of the box; places are relative to it */
    struct zr_world_place u, v, d;
    double half[3]; /* of the extents along u, v and d */
    double steps;   /* of heights, per unit */
    double thin;
    uint32_t columns, rows;
    double width, height; /* of a cell */
    uint32_t *ends;       /* per ray: end of its crossings, and before they are put, their begin */
    uint64_t *crossings, *spare;
    struct lengths *lengths; /* per ray */
    uint64_t work, work_most, work_of_grid, next_look;
    bool is_stopped;
    uint32_t last_rays; /* of the last grid that was walked; 0: none */
    uint64_t last_work;
};

/* A triangle in the frame of a walk. Its plane has the height at[0].d + du u + dv v at (u, v) from at[0]. */
struct facet {
    struct {
        double u, v, d;
    } at[3];
    double cosine, du, dv, low, high; /* lowest and highest corner, from at[0] */
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

typedef void visit_fn(struct walk *w, const struct facet *facet, uint32_t row, uint32_t column, int sign);

/* Returns the number of cells of `size` whose middles lie before `at`, at most `count`. */
static uint32_t cells_before(double at, double half, double size, uint32_t count)
{
    const double cells = (at + half) / size + 0.5;
    return cells <= 0.0 ? 0 : cells >= (double)count ? count : (uint32_t)cells;
}

/* Finds the columns at which the border of a triangle rises and falls on a row. False: it does not meet the row. */
static bool find_columns(const struct walk *w, const struct facet *f, double v, uint32_t *rise, uint32_t *fall)
{
    int found = 0;
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3;
        if ((f->at[k].v <= v) == (f->at[next].v <= v)) continue;
        const bool rises = f->at[k].v <= v;
        const int low = rises ? k : next, high = rises ? next : k;
        const double u =
            f->at[low].u + (v - f->at[low].v) * (f->at[high].u - f->at[low].u) / (f->at[high].v - f->at[low].v);
        *(rises ? rise : fall) = cells_before(u, w->half[0], w->width, w->columns);
        found++;
    }
    return found == 2;
}

/* Visits the rays that cross a triangle. */
static void visit_facet(struct walk *w, const struct facet *f, visit_fn *visit)
{
    double low = f->at[0].v, high = f->at[0].v;
    for (int k = 1; k < 3; k++) {
        low = zr_least_of(low, f->at[k].v);
        high = zr_most_of(high, f->at[k].v);
    }
    const uint32_t begin = cells_before(low, w->half[1], w->height, w->rows),
                   end = cells_before(high, w->half[1], w->height, w->rows);
    if (!has_work(w, 1 + (uint64_t)(end - begin))) return;
    for (uint32_t row = begin > 0 ? begin - 1 : 0; row < end + 1 && row < w->rows; row++) {
        uint32_t rise, fall;
        if (!find_columns(w, f, ((double)row + 0.5) * w->height - w->half[1], &rise, &fall)) continue;
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
    return zr_world_place_minus(at, w->middle);
}

static void put_corner(const struct walk *w, struct zr_world_place at, struct facet *f, int corner)
{
    f->at[corner].u = zr_world_place_dot(w->u, at);
    f->at[corner].v = zr_world_place_dot(w->v, at);
    f->at[corner].d = zr_world_place_dot(w->d, at);
}

static void find_plane(struct facet *f)
{
    const struct zr_world_place a = {f->at[1].u - f->at[0].u, f->at[1].v - f->at[0].v, f->at[1].d - f->at[0].d},
                                b = {f->at[2].u - f->at[0].u, f->at[2].v - f->at[0].v, f->at[2].d - f->at[0].d},
                                n = zr_world_place_cross(a, b);
    const double length = sqrt(zr_world_place_dot(n, n));
    f->cosine = length > 0.0 ? fabs(n.z) / length : 0.0;
    f->low = zr_least_of(0.0, zr_least_of(a.z, b.z));
    f->high = zr_most_of(0.0, zr_most_of(a.z, b.z));
    f->du = n.z != 0.0 ? -n.x / n.z : 0.0;
    f->dv = n.z != 0.0 ? -n.y / n.z : 0.0;
}

static void visit_ring(struct walk *w, uint32_t begin, uint32_t end, bool is_turned, visit_fn *visit)
{
    struct facet f;
    put_corner(w, place_of(w, begin), &f, 0);
    const int first = is_turned ? 2 : 1, last = 3 - first;
    for (uint32_t i = begin + 1; i + 1 < end && !w->is_stopped; i++) {
        put_corner(w, place_of(w, i), &f, first);
        put_corner(w, place_of(w, i + 1), &f, last);
        find_plane(&f);
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

static void count_crossing(struct walk *w, const struct facet *f, uint32_t row, uint32_t column, int sign)
{
    (void)f;
    (void)sign;
    w->ends[row * w->columns + column]++;
}

/* Puts the height of a triangle on a ray, within those of its corners. */
static void put_crossing(struct walk *w, const struct facet *f, uint32_t row, uint32_t column, int sign)
{
    const double u = ((double)column + 0.5) * w->width - w->half[0] - f->at[0].u,
                 v = ((double)row + 0.5) * w->height - w->half[1] - f->at[0].v, d = f->du * u + f->dv * v;
    const double height = (f->at[0].d + (d > f->low ? d < f->high ? d : f->high : f->low) + w->half[2]) * w->steps;
    const double step = height > 0.0 ? height < HEIGHTS ? height : HEIGHTS : 0.0;
    w->crossings[--w->ends[row * w->columns + column]] =
        (uint64_t)step << HEIGHT_SHIFT | (uint64_t)(f->cosine * (double)COSINES + 0.5) << 1 | (sign > 0 ? 1u : 0u);
}

/* ---- rays ---- */

static void merge(const uint64_t *from, uint32_t begin, uint32_t middle, uint32_t end, uint64_t *to)
{
    for (uint32_t i = begin, left = begin, right = middle; i < end; i++)
        to[i] = left == middle || (right < end && from[right] < from[left]) ? from[right++] : from[left++];
}

/* Sorts in pieces, so that a cancelled request need not wait for many crossings of one ray. */
static void sort_crossings(struct walk *w, uint64_t *at, uint32_t count)
{
    for (uint64_t i = 0; i < count; i += SORTED_AT_ONCE) {
        if (!has_work(w, 0)) return;
        zr_sort_u64(at + i, (uint32_t)(count - i < SORTED_AT_ONCE ? count - i : SORTED_AT_ONCE));
        w->next_look = w->work;
    }
    for (uint64_t run = SORTED_AT_ONCE; run < count; run *= 2) {
        for (uint64_t begin = 0; begin < count && has_work(w, 0); begin += 2 * run) {
            const uint64_t middle = begin + run < count ? begin + run : count,
                           end = begin + 2 * run < count ? begin + 2 * run : count;
            merge(at, (uint32_t)begin, (uint32_t)middle, (uint32_t)end, w->spare);
            w->next_look = w->work;
        }
        memcpy(at, w->spare, count * sizeof *at);
    }
}

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
    const double unit = 2.0 * w->half[2] / HEIGHTS;
    struct lengths length = {0, 0}, moment = {0, 0};
    bool positive = false, negative = false;
    int winding = 0;
    for (uint32_t i = 0; i < count; i++) {
        winding += at[i] & 1u ? 1 : -1;
        if (winding == 0 || i + 1 == count) continue;
        const double from = (double)(at[i] >> HEIGHT_SHIFT) * unit, to = (double)(at[i + 1] >> HEIGHT_SHIFT) * unit;
        if ((to - from) * zr_least_of(cosine_of(at[i]), cosine_of(at[i + 1])) <= w->thin) continue;
        add_interval(from - w->half[2], to - w->half[2], winding, &length, &moment);
        positive = positive || winding > 0;
        negative = negative || winding < 0;
    }
    if (winding != 0) return;
    const double middle[2] = {((double)(ray % w->columns) + 0.5) * w->width - w->half[0],
                              ((double)(ray / w->columns) + 0.5) * w->height - w->half[1]};
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

/* Returns half the extent of the box along an axis, and a little more, so that no corner lies on the border. */
static double half_along(struct zr_world_place axis, const double half[3])
{
    return ((fabs(axis.x) * half[0] + fabs(axis.y) * half[1]) + fabs(axis.z) * half[2]) * (1.0 + 1e-9);
}

/* Turns the rays of a walk. `half`: half of the box's sides. */
static void turn_to(struct walk *w, int direction, const double half[3])
{
    w->d = axes[direction];
    w->u = axes[(direction + 1) % 3];
    w->v = axes[(direction + 2) % 3];
    w->half[0] = half_along(w->u, half);
    w->half[1] = half_along(w->v, half);
    w->half[2] = half_along(w->d, half);
    w->steps = HEIGHTS / (2.0 * w->half[2]);
}

static void begin_grid(struct walk *w, uint32_t rays)
{
    const double longest = zr_most_of(w->half[0], w->half[1]);
    const uint32_t least = rays / SLENDER > 0 ? rays / SLENDER : 1;
    w->columns = (uint32_t)((double)rays * w->half[0] / longest + 0.5);
    w->rows = (uint32_t)((double)rays * w->half[1] / longest + 0.5);
    if (w->columns < least) w->columns = least;
    if (w->rows < least) w->rows = least;
    w->width = 2.0 * w->half[0] / (double)w->columns;
    w->height = 2.0 * w->half[1] / (double)w->rows;
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
    const uint32_t rays = w->columns * w->rows;
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
    const uint32_t rays = w->columns * w->rows, end_of_all = (uint32_t)(w->spare - w->crossings);
    w->work = w->next_look = 0;
    visit_all(w, put_crossing);
    for (uint32_t i = 0; i < rays && !w->is_stopped; i++) {
        const uint32_t begin = w->ends[i], end = i + 1 < rays ? w->ends[i + 1] : end_of_all;
        sort_crossings(w, w->crossings + begin, end - begin);
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
    for (uint32_t i = 0; i < w->columns * w->rows; i++) {
        const uint32_t row = i / w->columns, column = i % w->columns;
        const uint32_t others[4] = {column > 0 ? i - 1 : i, column + 1 < w->columns ? i + 1 : i,
                                    row > 0 ? i - w->columns : i, row + 1 < w->rows ? i + w->columns : i};
        double most = 0.0;
        for (int k = 0; k < 4; k++)
            most = zr_most_of(most, fabs(excess_of(&w->lengths[i], sign) - excess_of(&w->lengths[others[k]], sign)));
        sum += most;
    }
    return 0.5 * sum * w->width * w->height;
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
        const double cell = w->width * w->height, u = excess_of(&sums.moment[0], sign) * cell,
                     v = excess_of(&sums.moment[1], sign) * cell, d = excess_of(&sums.moment[2], sign) * cell;
        *volume = excess_of(&sums.volume, sign) * cell;
        out->volume += *volume / 3.0;
        out->error += CHANGES * changes_of(w, sign) / 3.0;
        out->moment[0] += ((w->u.x * u + w->v.x * v) + w->d.x * d) / 3.0;
        out->moment[1] += ((w->u.y * u + w->v.y * v) + w->d.y * d) / 3.0;
        out->moment[2] += ((w->u.z * u + w->v.z * v) + w->d.z * d) / 3.0;
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
    w.middle = (struct zr_world_place){box->min[0] + half[0], box->min[1] + half[1], box->min[2] + half[2]};
    w.thin = 2.0 * THIN * sqrt((half[0] * half[0] + half[1] * half[1]) + half[2] * half[2]);
    if (w.thin == 0.0 || faces->end - faces->begin < ZR_OVERLAP_FACES_LEAST) return true;
    turn_to(&w, 0, half);
    if (!look(&w, &sign, &out->is_found)) return false;
    for (int i = 0; i < 3 && out->is_found; i++) {
        turn_to(&w, i, half);
        if (!measure(&w, sign, &volumes[i], out)) return false;
    }
    if (!out->is_found) return true;
    out->error += zr_most_of(volumes[0], zr_most_of(volumes[1], volumes[2])) -
                  zr_least_of(volumes[0], zr_least_of(volumes[1], volumes[2]));
    out->moment[0] += out->volume * (w.middle.x - box->apex.x);
    out->moment[1] += out->volume * (w.middle.y - box->apex.y);
    out->moment[2] += out->volume * (w.middle.z - box->apex.z);
    return true;
}
