#include "measure/combined.h"

#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "base/team.h"
#include "measure/ray_lists.h"

enum { RAYS = 256, NONE = UINT8_MAX };

/* Share of the changes between neighbouring rays in the error. */
#define CHANGES 0.02

/* Sums over the rays of a row: lengths, and lengths times the place along u and d. */
struct row {
    double length, along_u, along_d;
};

struct measuring {
    const struct zr_cancel *cancel;
    const struct zr_csg *csg;
    const struct zr_ray_lists *lists;
    struct row *rows;
    double *lengths; /* per ray */
};

/* Results of one direction. */
struct direction {
    double volume, changes, moment[3]; /* around the middle of the places */
};

/* ---- rays ---- */

/* Adds the intervals of a ray in which the value of the tree is true. Returns their length. */
static double add_ray(const struct measuring *m, uint32_t ray, double u, struct row *row)
{
    const struct zr_ray_grid *grid = &m->lists->grid;
    const uint64_t *at = m->lists->crossings + m->lists->begins[ray],
                   *end = m->lists->crossings + m->lists->begins[ray + 1];
    int32_t windings[ZR_CSG_PARTS_MAX] = {0};
    uint64_t inside = 0;
    bool value = zr_csg_value(m->csg, 0);
    double length = 0.0;
    for (; at < end; at++) {
        const uint32_t part = zr_crossing_tag(*at);
        windings[part] += zr_crossing_sign(*at);
        inside = windings[part] != 0 ? inside | UINT64_C(1) << part : inside & ~(UINT64_C(1) << part);
        if (value && at > m->lists->crossings + m->lists->begins[ray]) {
            const double from = zr_crossing_place(grid, at[-1]), to = zr_crossing_place(grid, at[0]);
            length += to - from;
            row->along_d += 0.5 * (to - from) * (to + from);
        }
        value = zr_csg_value(m->csg, inside);
    }
    row->along_u += length * u;
    row->length += length;
    return length;
}

static void add_rows(void *context, size_t begin, size_t end)
{
    const struct measuring *m = context;
    const struct zr_ray_grid *grid = &m->lists->grid;
    for (size_t row = begin; row < end && !zr_is_cancelled(m->cancel); row++)
        for (uint32_t column = 0; column < grid->columns; column++) {
            const uint32_t ray = (uint32_t)row * grid->columns + column;
            const double u = ((double)column + 0.5) * grid->width - grid->half[0];
            m->lengths[ray] = add_ray(m, ray, u, &m->rows[row]);
        }
}

static enum zr_status measure(const struct zr_run *run, const struct zr_csg *csg, const struct zr_solid *solid,
                              int number, struct direction *out)
{
    static const struct zr_solid none = {.count = 0};
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const struct zr_run inner = zr_run_in(run, &scratch);
    struct zr_ray_lists lists;
    struct measuring m = {.cancel = run->cancel, .csg = csg, .lists = &lists};
    enum zr_status status = zr_ray_lists_make(&inner, solid, &none, number, RAYS, &lists);
    const struct zr_ray_grid *grid = &lists.grid;
    const double cell = grid->width * grid->height;
    *out = (struct direction){.volume = 0.0};
    if (status == ZR_OK) {
        m.rows = zr_arena_zero(&scratch, grid->rows, sizeof *m.rows);
        m.lengths = zr_arena_zero(&scratch, (size_t)grid->rows * grid->columns, sizeof *m.lengths);
        if (!zr_arena_ok(&scratch)) status = ZR_NO_MEMORY;
    }
    if (status == ZR_OK) zr_team_ranges(run->team, grid->rows, 1, add_rows, &m);
    for (uint32_t row = 0; status == ZR_OK && row < grid->rows; row++) {
        const struct row *r = &m.rows[row];
        const double v = ((double)row + 0.5) * grid->height - grid->half[1];
        out->volume += r->length * cell;
        out->moment[0] += (grid->u.x * r->along_u + grid->v.x * v * r->length + grid->d.x * r->along_d) * cell;
        out->moment[1] += (grid->u.y * r->along_u + grid->v.y * v * r->length + grid->d.y * r->along_d) * cell;
        out->moment[2] += (grid->u.z * r->along_u + grid->v.z * v * r->length + grid->d.z * r->along_d) * cell;
    }
    if (status == ZR_OK) out->changes = 0.5 * CHANGES * zr_ray_changes(grid, m.lengths, 1) * cell;
    out->moment[0] += grid->middle.x * out->volume;
    out->moment[1] += grid->middle.y * out->volume;
    out->moment[2] += grid->middle.z * out->volume;
    zr_arena_close_scratch(&scratch, run->arena);
    return status == ZR_OK && zr_is_cancelled(run->cancel) ? ZR_CANCELLED : status;
}

/* ---- operands ---- */

/* Leaves the triangles of operands, with the numbers of their parts as tags, and finds their box. */
static bool leave_operands(struct zr_arena *arena, const struct zr_csg *csg, struct zr_solid *solid)
{
    uint32_t(*corners)[3] = zr_arena_alloc(arena, solid->count, sizeof *corners), count = 0;
    uint8_t *tags = zr_arena_alloc(arena, solid->count, sizeof *tags);
    if (!corners || !tags) return false;
    for (int k = 0; k < 3; k++) {
        solid->min[k] = HUGE_VAL;
        solid->max[k] = -HUGE_VAL;
    }
    for (uint32_t i = 0; i < solid->count; i++) {
        const uint8_t part = csg->parts[solid->parts[i]];
        struct zr_world_place p[3];
        if (part == 0) continue;
        zr_solid_places(solid, i, p);
        for (int k = 0; k < 3; k++) {
            const double at[3] = {p[k].x, p[k].y, p[k].z};
            for (int axis = 0; axis < 3; axis++) {
                solid->min[axis] = zr_least_of(solid->min[axis], at[axis]);
                solid->max[axis] = zr_most_of(solid->max[axis], at[axis]);
            }
        }
        memcpy(corners[count], solid->corners[i], sizeof *corners);
        tags[count++] = (uint8_t)(part - 1);
    }
    solid->corners = (const uint32_t(*)[3])corners;
    solid->tags = tags;
    solid->count = count;
    return true;
}

static double spread_of(const struct direction directions[ZR_RAY_DIRECTIONS])
{
    double low = directions[0].volume, high = low;
    for (int i = 1; i < ZR_RAY_DIRECTIONS; i++) {
        low = zr_least_of(low, directions[i].volume);
        high = zr_most_of(high, directions[i].volume);
    }
    return high - low;
}

static void join(const struct direction directions[ZR_RAY_DIRECTIONS], struct zr_world_place middle,
                 struct zr_combined *out)
{
    double moment[3] = {0, 0, 0}, changes = 0.0;
    *out = (struct zr_combined){.volume = 0.0};
    for (int i = 0; i < ZR_RAY_DIRECTIONS; i++) {
        out->volume += directions[i].volume / ZR_RAY_DIRECTIONS;
        changes += directions[i].changes / ZR_RAY_DIRECTIONS;
        for (int k = 0; k < 3; k++)
            moment[k] += directions[i].moment[k] / ZR_RAY_DIRECTIONS;
    }
    out->error = spread_of(directions) + changes;
    if (!(out->volume > 0.0)) return;
    out->center = (struct zr_world_place){middle.x + moment[0] / out->volume, middle.y + moment[1] / out->volume,
                                          middle.z + moment[2] / out->volume};
}

enum zr_status zr_combined_find(const struct zr_run *run, const struct zr_scene *scene, const struct zr_combined **out)
{
    struct zr_combined *made = zr_arena_zero(run->arena, 1, sizeof *made);
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    const struct zr_run inner = zr_run_in(run, &scratch);
    struct direction directions[ZR_RAY_DIRECTIONS];
    struct zr_solid solid;
    enum zr_status status = made ? zr_solid_make(&inner, scene, NULL, &solid) : ZR_NO_MEMORY;
    if (status == ZR_OK && !leave_operands(&scratch, scene->csg, &solid)) status = ZR_NO_MEMORY;
    const bool has_any = status == ZR_OK && solid.count > 0;
    for (int i = 0; status == ZR_OK && has_any && i < ZR_RAY_DIRECTIONS; i++)
        status = measure(&inner, scene->csg, &solid, i, &directions[i]);
    if (status == ZR_OK && has_any) join(directions, solid.middle, made);
    zr_arena_close_scratch(&scratch, run->arena);
    *out = made;
    return status;
}
