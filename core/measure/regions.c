#include "measure/regions.h"

#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "measure/ray_lists.h"

enum { ITEMS_PER_CANCEL_CHECK = 1 << 12, CELLS_LEAST = 8, SHIFT_CELLS = 8 };

/* An interval inside one solid alone. */
struct piece {
    double from, to, thickness;
    double before, behind; /* how far the faces at its ends may be shifted on a neighbouring ray */
    uint32_t ray;
    bool is_b;
};

struct finding {
    const struct zr_run *run;
    const struct zr_ray_lists *lists;
    double thin;
    uint32_t *begins; /* per ray, and one more */
    struct piece *pieces;
    uint32_t *parents;         /* per piece; the root is the first one */
    struct zr_region *regions; /* per root */
};

static bool is_due(const struct finding *f, size_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(f->run->cancel);
}

/* ---- pieces ---- */

/* Returns how far a face moves along the rays from one to the next, by the cosine between them: a thin region along a
 * face that rays graze has no overlap between neighbours. */
static double shift_of(const struct zr_ray_grid *grid, double cosine)
{
    const double most = (double)SHIFT_CELLS, sine = sqrt(zr_most_of(0.0, 1.0 - cosine * cosine));
    return zr_most_of(grid->width, grid->height) * (sine < most * cosine ? sine / cosine : most);
}

/* Adds an interval that has ended, unless it is thin. `out` is NULL to count. Returns the number added. */
static uint32_t put(const struct finding *f, const struct zr_ray_interval *at, uint32_t ray, struct piece *out)
{
    const double thickness = zr_ray_thickness(at);
    if (thickness <= f->thin) return 0;
    if (out)
        *out = (struct piece){at->from,
                              at->to,
                              thickness,
                              shift_of(&f->lists->grid, at->enters),
                              shift_of(&f->lists->grid, at->leaves),
                              ray,
                              at->a == 0};
    return 1;
}

/* Lists the pieces of a ray. Intervals that touch, as within overlapping shells, are one. */
static uint32_t list_ray(const struct finding *f, uint32_t ray, struct piece *out)
{
    struct zr_ray_walk walk = zr_ray_walk_begin(f->lists, ray);
    struct zr_ray_interval at, open = {.from = 0.0};
    bool is_open = false;
    uint32_t found = 0;
    while (zr_ray_walk_next(&walk, &at)) {
        const bool is_single = at.a == 0 || at.b == 0;
        if (is_open && is_single && at.from == open.to && (at.a == 0) == (open.a == 0)) {
            open.to = at.to;
            open.leaves = at.leaves;
            continue;
        }
        if (is_open) found += put(f, &open, ray, out ? out + found : NULL);
        is_open = is_single;
        open = at;
    }
    if (is_open) found += put(f, &open, ray, out ? out + found : NULL);
    return found;
}

static bool list_pieces(struct finding *f, uint32_t rays)
{
    uint64_t count = 0;
    f->begins = zr_arena_alloc(f->run->arena, (size_t)rays + 1, sizeof *f->begins);
    if (!f->begins) return false;
    for (uint32_t i = 0; i < rays && !is_due(f, i); i++) {
        f->begins[i] = (uint32_t)count;
        count += list_ray(f, i, NULL);
    }
    f->begins[rays] = (uint32_t)count; /* at most the crossings */
    f->pieces = zr_arena_alloc(f->run->arena, count, sizeof *f->pieces);
    f->parents = zr_arena_alloc(f->run->arena, count, sizeof *f->parents);
    f->regions = zr_arena_zero(f->run->arena, count, sizeof *f->regions);
    if (!zr_arena_ok(f->run->arena) || zr_is_cancelled(f->run->cancel)) return false;
    for (uint32_t i = 0; i < rays && !is_due(f, i); i++)
        list_ray(f, i, f->pieces + f->begins[i]);
    for (uint32_t i = 0; i < count; i++)
        f->parents[i] = i;
    return true;
}

/* ---- joining ---- */

static uint32_t root_of(uint32_t *parents, uint32_t i)
{
    while (parents[i] != i)
        i = parents[i] = parents[parents[i]];
    return i;
}

/* Joins the pieces of two rays that overlap. */
static void join(struct finding *f, uint32_t ray, uint32_t other)
{
    uint32_t i = f->begins[ray], k = f->begins[other];
    while (i < f->begins[ray + 1] && k < f->begins[other + 1]) {
        const struct piece *p = &f->pieces[i], *q = &f->pieces[k];
        if (p->is_b == q->is_b && p->from - zr_most_of(p->before, q->behind) < q->to &&
            q->from - zr_most_of(q->before, p->behind) < p->to) {
            const uint32_t a = root_of(f->parents, i), b = root_of(f->parents, k);
            f->parents[a < b ? b : a] = a < b ? a : b;
        }
        *(p->to < q->to ? &i : &k) += 1;
    }
}

static void join_all(struct finding *f)
{
    const uint32_t columns = f->lists->grid.columns, rows = f->lists->grid.rows;
    for (uint32_t i = 0; i < columns * rows && !is_due(f, i); i++) {
        if (i % columns + 1 < columns) join(f, i, i + 1);
        if (i / columns + 1 < rows) join(f, i, i + columns);
    }
}

/* ---- sums ---- */

static struct zr_world_place place_on(const struct zr_ray_grid *grid, uint32_t ray, double d)
{
    const double u = ((double)(ray % grid->columns) + 0.5) * grid->width - grid->half[0],
                 v = ((double)(ray / grid->columns) + 0.5) * grid->height - grid->half[1];
    return (struct zr_world_place){grid->middle.x + ((grid->u.x * u + grid->v.x * v) + grid->d.x * d),
                                   grid->middle.y + ((grid->u.y * u + grid->v.y * v) + grid->d.y * d),
                                   grid->middle.z + ((grid->u.z * u + grid->v.z * v) + grid->d.z * d)};
}

static void include(struct zr_region *region, struct zr_world_place p)
{
    const double at[3] = {p.x, p.y, p.z};
    for (int k = 0; k < 3; k++) {
        region->min[k] = zr_least_of(region->min[k], at[k]);
        region->max[k] = zr_most_of(region->max[k], at[k]);
    }
}

static void add(const struct zr_ray_grid *grid, const struct piece *piece, struct zr_region *region)
{
    const struct zr_world_place middle = place_on(grid, piece->ray, 0.5 * (piece->from + piece->to));
    const double volume = (piece->to - piece->from) * (grid->width * grid->height),
                 at[3] = {middle.x, middle.y, middle.z};
    if (region->volume == 0.0) {
        region->is_b = piece->is_b;
        for (int k = 0; k < 3; k++) {
            region->min[k] = HUGE_VAL;
            region->max[k] = -HUGE_VAL;
        }
    }
    region->volume += volume;
    for (int k = 0; k < 3; k++)
        region->center[k] += volume * at[k];
    include(region, place_on(grid, piece->ray, piece->from));
    include(region, place_on(grid, piece->ray, piece->to));
    if (piece->thickness <= region->thickness) return;
    region->thickness = piece->thickness;
    region->at = middle;
}

/* Inserts a region before smaller ones; the smallest one is omitted if there are too many. */
static void insert(const struct zr_region *region, struct zr_regions *out)
{
    uint32_t place = out->count;
    while (place > 0 && out->at[place - 1].volume < region->volume)
        place--;
    if (out->count == ZR_REGIONS_MAX)
        out->omitted++;
    else
        out->count++;
    if (place == ZR_REGIONS_MAX) return;
    memmove(&out->at[place + 1], &out->at[place], (out->count - 1 - place) * sizeof *region);
    out->at[place] = *region;
    for (int k = 0; k < 3; k++)
        out->at[place].center[k] /= region->volume;
}

static enum zr_status find(struct finding *f, struct zr_regions *out)
{
    const struct zr_ray_grid *grid = &f->lists->grid;
    const uint32_t rays = grid->columns * grid->rows;
    const double area = grid->width * grid->height;
    if (!list_pieces(f, rays)) return zr_is_cancelled(f->run->cancel) ? ZR_CANCELLED : ZR_NO_MEMORY;
    join_all(f);
    out->cell = sqrt(area);
    for (uint32_t i = 0; i < f->begins[rays] && !is_due(f, i); i++)
        add(grid, &f->pieces[i], &f->regions[root_of(f->parents, i)]);
    for (uint32_t i = 0; i < f->begins[rays] && !is_due(f, i); i++)
        if (f->parents[i] == i && f->regions[i].volume >= CELLS_LEAST * area * out->cell) insert(&f->regions[i], out);
    return zr_is_cancelled(f->run->cancel) ? ZR_CANCELLED : ZR_OK;
}

enum zr_status zr_regions_find(const struct zr_run *run, const struct zr_ray_lists *lists, double thin,
                               struct zr_regions *out)
{
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const struct zr_run inner = zr_run_in(run, &scratch);
    struct finding f = {.run = &inner, .lists = lists, .thin = thin};
    *out = (struct zr_regions){.count = 0};
    const enum zr_status status = find(&f, out);
    zr_arena_close_scratch(&scratch, run->arena);
    return status;
}
