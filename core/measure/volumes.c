#include "measure/volumes.h"

#include "base/arena.h"
#include "base/cancel.h"
#include "base/team.h"
#include "measure/ray_lists.h"

/* Intervals of one solid up to this thickness do not count, relative to the diagonal. */
#define THIN 1e-6

/* Share of the changes between neighbouring rays in the error. */
#define CHANGES 0.02

enum { BOTH, ONLY_A, ONLY_B, KINDS };

/* Sums over the rays of a row, in lengths. */
struct row {
    double lengths[KINDS], thin;
    bool has_positive[2], has_negative[2], has_multiple[2]; /* winding numbers of a and b */
};

struct measuring {
    const struct zr_cancel *cancel;
    const struct zr_ray_lists *lists;
    double thin;
    struct row *rows;
    double (*lengths)[KINDS]; /* per ray */
};

/* Results of one direction. */
struct direction {
    double volumes[KINDS], changes[KINDS], thin;
};

static void note_winding(struct row *row, int solid, int winding)
{
    if (winding > 0) row->has_positive[solid] = true;
    if (winding < 0) row->has_negative[solid] = true;
    if (winding > 1 || winding < -1) row->has_multiple[solid] = true;
}

static void add_ray(const struct measuring *m, uint32_t ray, struct row *row)
{
    struct zr_ray_walk walk = zr_ray_walk_begin(m->lists, ray);
    struct zr_ray_interval at;
    double *lengths = m->lengths[ray];
    while (zr_ray_walk_next(&walk, &at)) {
        const int kind = at.a == 0 ? ONLY_B : at.b == 0 ? ONLY_A : BOTH;
        if (zr_ray_thickness(&at) <= m->thin) {
            if (kind != BOTH) row->thin += at.to - at.from;
            if (kind != BOTH) continue;
        } else {
            note_winding(row, 0, at.a);
            note_winding(row, 1, at.b);
        }
        lengths[kind] += at.to - at.from;
    }
    for (int k = 0; k < KINDS; k++)
        row->lengths[k] += lengths[k];
}

static void add_rows(void *context, size_t begin, size_t end)
{
    const struct measuring *m = context;
    const uint32_t columns = m->lists->grid.columns;
    for (size_t row = begin; row < end && !zr_is_cancelled(m->cancel); row++)
        for (uint32_t column = 0; column < columns; column++)
            add_ray(m, (uint32_t)row * columns + column, &m->rows[row]);
}

/* Joins the winding numbers of all rows of all directions. */
static void note_row(const struct row *row, struct row *all)
{
    for (int solid = 0; solid < 2; solid++) {
        all->has_positive[solid] = all->has_positive[solid] || row->has_positive[solid];
        all->has_negative[solid] = all->has_negative[solid] || row->has_negative[solid];
        all->has_multiple[solid] = all->has_multiple[solid] || row->has_multiple[solid];
    }
}

static enum zr_status measure_lists(const struct zr_run *run, struct measuring *m, struct row *all,
                                    struct direction *out)
{
    const struct zr_ray_grid *grid = &m->lists->grid;
    const double cell = grid->width * grid->height;
    *out = (struct direction){.thin = 0.0};
    m->rows = zr_arena_zero(run->arena, grid->rows, sizeof *m->rows);
    m->lengths = zr_arena_zero(run->arena, (size_t)grid->rows * grid->columns, sizeof *m->lengths);
    if (!zr_arena_ok(run->arena)) return ZR_NO_MEMORY;
    zr_team_ranges(run->team, grid->rows, 1, add_rows, m);
    for (uint32_t row = 0; row < grid->rows; row++) {
        for (int k = 0; k < KINDS; k++)
            out->volumes[k] += m->rows[row].lengths[k] * cell;
        out->thin += m->rows[row].thin * cell;
        note_row(&m->rows[row], all);
    }
    for (int k = 0; k < KINDS; k++)
        out->changes[k] = 0.5 * CHANGES * zr_ray_changes(grid, &m->lengths[0][k], KINDS) * cell;
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_OK;
}

/* Results that directions add to. */
struct wanted {
    struct zr_volumes *volumes;
    double thin;
    struct zr_regions *regions; /* NULL: none */
};

static enum zr_status measure(const struct zr_run *run, const struct zr_solid *a, const struct zr_solid *b, int number,
                              uint32_t rays, struct row *all, struct direction *out, const struct wanted *wanted)
{
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const struct zr_run inner = zr_run_in(run, &scratch);
    struct zr_ray_lists lists;
    struct measuring m = {.cancel = run->cancel, .lists = &lists, .thin = THIN * zr_most_of(a->diagonal, b->diagonal)};
    enum zr_status status = zr_ray_lists_make(&inner, a, b, number, rays, &lists);
    if (status == ZR_OK) status = measure_lists(&inner, &m, all, out);
    if (status == ZR_OK && number == 0 && wanted->regions)
        status = zr_regions_find(&inner, &lists, wanted->thin, wanted->regions);
    wanted->volumes->rays += lists.grid.columns * lists.grid.rows;
    zr_arena_close_scratch(&scratch, run->arena);
    return status;
}

static double ratio_of(const double volumes[KINDS])
{
    const double all = volumes[BOTH] + volumes[ONLY_A] + volumes[ONLY_B];
    return all > 0.0 ? volumes[BOTH] / all : 0.0;
}

static double spread_of(const double values[ZR_RAY_DIRECTIONS])
{
    return zr_most_of(values[0], zr_most_of(values[1], values[2])) -
           zr_least_of(values[0], zr_least_of(values[1], values[2]));
}

/* Finds the volume of one solid: the exact sum, or by the rays, of which `only` and BOTH are inside. */
static void find_own(const struct zr_solid *solid, int number, const struct row *all, const struct direction *found,
                     const struct zr_volumes *volumes, struct zr_own_volume *out)
{
    const int only = number == 0 ? ONLY_A : ONLY_B;
    *out = (struct zr_own_volume){.volume = fabs(solid->volume), .is_inside_out = solid->volume < 0.0};
    out->has_overlap = all->has_multiple[number] || (all->has_positive[number] && all->has_negative[number]);
    if (!out->has_overlap) return;
    double values[ZR_RAY_DIRECTIONS], changes = 0.0;
    for (int i = 0; i < ZR_RAY_DIRECTIONS; i++) {
        values[i] = found[i].volumes[BOTH] + found[i].volumes[only];
        changes += (found[i].changes[BOTH] + found[i].changes[only]) / ZR_RAY_DIRECTIONS;
    }
    out->volume = volumes->both + (number == 0 ? volumes->only_a : volumes->only_b);
    out->error = spread_of(values) + changes;
    out->is_inside_out = !all->has_positive[number];
}

static void find_all(const struct direction *found, struct zr_volumes *out)
{
    double ratios[ZR_RAY_DIRECTIONS], means[KINDS] = {0, 0, 0}, changes = 0.0, thin = 0.0;
    for (int i = 0; i < ZR_RAY_DIRECTIONS; i++) {
        ratios[i] = ratio_of(found[i].volumes);
        for (int k = 0; k < KINDS; k++)
            means[k] += found[i].volumes[k] / ZR_RAY_DIRECTIONS;
        changes += found[i].changes[BOTH] / ZR_RAY_DIRECTIONS;
        thin += found[i].thin / ZR_RAY_DIRECTIONS;
    }
    for (int k = 0; k < KINDS; k++) {
        const double values[ZR_RAY_DIRECTIONS] = {found[0].volumes[k], found[1].volumes[k], found[2].volumes[k]};
        out->volume_error = zr_most_of(out->volume_error, spread_of(values));
    }
    const double all = means[BOTH] + means[ONLY_A] + means[ONLY_B];
    out->both = means[BOTH];
    out->only_a = means[ONLY_A];
    out->only_b = means[ONLY_B];
    out->iou = ratio_of(means);
    out->volume_error += changes + thin;
    out->error = all > 0.0 ? spread_of(ratios) + (changes + thin) / all : 0.0;
    if (out->only_a == 0.0 && out->only_b == 0.0 && all > 0.0) out->error = thin / all; /* each ray is shared */
}

/* Returns how far the rays are off for a whole solid whose volume is known. */
static double excess_of(const struct zr_own_volume *own, double measured)
{
    return own->has_overlap ? 0.0 : fabs(measured - own->volume);
}

enum zr_status zr_volumes_find(const struct zr_run *run, const struct zr_solid *a, const struct zr_solid *b,
                               uint32_t rays, double thin, struct zr_volumes *out, struct zr_regions *regions)
{
    struct direction found[ZR_RAY_DIRECTIONS];
    const struct wanted wanted = {out, thin, regions};
    struct row all = {.thin = 0.0};
    *out = (struct zr_volumes){.rays = 0};
    for (int i = 0; i < ZR_RAY_DIRECTIONS; i++) {
        const enum zr_status status = measure(run, a, b, i, rays, &all, &found[i], &wanted);
        if (status != ZR_OK) return status;
    }
    find_all(found, out);
    find_own(a, 0, &all, found, out, &out->a);
    find_own(b, 1, &all, found, out, &out->b);
    out->volume_error +=
        zr_most_of(excess_of(&out->a, out->both + out->only_a), excess_of(&out->b, out->both + out->only_b));
    return ZR_OK;
}
