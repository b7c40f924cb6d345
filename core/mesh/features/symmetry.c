#include "mesh/features/symmetry.h"

#include "base/trig.h"
#include "mesh/features/cylinder_fit.h"
#include "mesh/features/near_grid.h"

enum { BY_AREA = 1024, OTHERS = 2048, SAMPLES_MOST = BY_AREA + 2 * OTHERS };

static const double REACH = 2e-3;       /* of the size */
static const double SAME_MOMENT = 1e-3; /* of the sum of the three */
static const double SAME_AXIS = 0.9999; /* cosine */

/* Turns that no regular polygon of up to ZR_TURNS_MOST corners has. */
static const double ODD_TURNS[] = {51.43, 137.51, 15.21};

struct trying {
    struct zr_feature_work *work;
    const struct zr_near_grid *grid;
    zr_dvec3 center;
    const zr_dvec3 *samples; /* from the centre */
    uint32_t count;
};

/* ---- centre and directions ---- */

static double area_of(const struct zr_surface *surface, uint32_t triangle, zr_dvec3 corners[3])
{
    for (int k = 0; k < 3; k++)
        corners[k] = surface->places[surface->corners[triangle][k]];
    const zr_dvec3 cross = zr_dvec3_cross(zr_dvec3_sub(corners[1], corners[0]), zr_dvec3_sub(corners[2], corners[0]));
    return 0.5 * sqrt(zr_dvec3_dot(cross, cross));
}

static void add_direction(struct zr_symmetry *out, zr_dvec3 axis)
{
    for (uint32_t i = 0; i < out->direction_count; i++)
        if (fabs(zr_dvec3_dot(out->directions[i], axis)) > SAME_AXIS) return;
    if (out->direction_count < ZR_SYMMETRIES_MAX) out->directions[out->direction_count++] = axis;
}

/* Adds the moments of a triangle around the centre: of its corners and its middle. */
static void add_moments(struct zr_normal_sums *sums, const zr_dvec3 corners[3], zr_dvec3 center, double area)
{
    zr_dvec3 middle = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        const zr_dvec3 p = zr_dvec3_sub(corners[k], center);
        middle = zr_dvec3_add_scaled(middle, p, 1.0 / 3.0);
        zr_normal_sums_add(sums, p, area / 12.0);
    }
    zr_normal_sums_add(sums, middle, 0.75 * area);
}

static double moment_along(const struct zr_normal_sums *s, zr_dvec3 a)
{
    return ((s->xx * a.x * a.x + s->yy * a.y * a.y) + s->zz * a.z * a.z) +
           2.0 * ((s->xy * a.x * a.y + s->xz * a.x * a.z) + s->yz * a.y * a.z);
}

bool zr_symmetry_begin(struct zr_feature_work *work, const struct zr_surface *surface, struct zr_symmetry *out)
{
    struct zr_normal_sums sums = {0};
    zr_dvec3 corners[3];
    double all = 0.0;
    *out = (struct zr_symmetry){.directions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .direction_count = 3};
    for (uint32_t t = 0; t < surface->triangle_count; t++) {
        const double area = area_of(surface, t, corners);
        if (!zr_feature_has_steps(work, 1)) return false;
        all += area;
        for (int k = 0; k < 3; k++)
            out->center = zr_dvec3_add_scaled(out->center, corners[k], area / 3.0);
    }
    if (!(all > 0.0)) return false;
    out->center = (zr_dvec3){out->center.x / all, out->center.y / all, out->center.z / all};
    for (uint32_t t = 0; t < surface->triangle_count; t++) {
        const double area = area_of(surface, t, corners);
        if (!zr_feature_has_steps(work, 1)) return false;
        add_moments(&sums, corners, out->center, area);
    }
    zr_dvec3 axes[3];
    double moments[3];
    zr_normal_sums_axes(&sums, axes);
    for (int k = 0; k < 3; k++)
        moments[k] = moment_along(&sums, axes[k]);
    const double least = SAME_MOMENT * (moments[0] + moments[1] + moments[2]);
    for (int k = 0; k < 3; k++)
        if (fabs(moments[k] - moments[(k + 1) % 3]) > least && fabs(moments[k] - moments[(k + 2) % 3]) > least)
            add_direction(out, axes[k]);
    return true;
}

/* ---- samples ---- */

/* Takes samples by area: the sequence R2 within triangles, at equal steps of their summed areas. */
static uint32_t sample_area(struct zr_feature_work *work, const struct zr_surface *surface, zr_dvec3 center,
                            zr_dvec3 *out)
{
    zr_dvec3 c[3];
    double all = 0.0, sum = 0.0;
    uint32_t count = 0;
    for (uint32_t t = 0; t < surface->triangle_count && zr_feature_has_steps(work, 1); t++)
        all += area_of(surface, t, c);
    for (uint32_t t = 0; t < surface->triangle_count && zr_feature_has_steps(work, 1); t++) {
        sum += area_of(surface, t, c);
        for (; count < BY_AREA && (count + 0.5) * (all / BY_AREA) <= sum; count++) {
            double u = 0.7548776662466927 * count, v = 0.5698402909980532 * count;
            u -= floor(u);
            v -= floor(v);
            if (u + v > 1.0) {
                u = 1.0 - u;
                v = 1.0 - v;
            }
            zr_dvec3 p = zr_dvec3_add_scaled(c[0], zr_dvec3_sub(c[1], c[0]), u);
            p = zr_dvec3_add_scaled(p, zr_dvec3_sub(c[2], c[0]), v);
            out[count] = zr_dvec3_sub(p, center);
        }
    }
    return count;
}

static uint32_t sample(struct zr_feature_work *work, const struct zr_surface *surface, zr_dvec3 center, zr_dvec3 *out)
{
    uint32_t count = sample_area(work, surface, center, out);
    const uint32_t step = surface->triangle_count / OTHERS + 1, hop = surface->place_count / OTHERS + 1;
    zr_dvec3 c[3];
    for (uint32_t t = 0; t < surface->triangle_count; t += step) {
        area_of(surface, t, c);
        const zr_dvec3 middle = {(c[0].x + c[1].x + c[2].x) / 3.0, (c[0].y + c[1].y + c[2].y) / 3.0,
                                 (c[0].z + c[1].z + c[2].z) / 3.0};
        out[count++] = zr_dvec3_sub(middle, center);
    }
    for (uint32_t i = 0; i < surface->place_count; i += hop)
        out[count++] = zr_dvec3_sub(surface->places[i], center);
    return count;
}

/* ---- tries ---- */

static bool is_mirror(const struct trying *t, zr_dvec3 normal)
{
    for (uint32_t i = 0; i < t->count; i++) {
        const zr_dvec3 p = t->samples[i];
        const zr_dvec3 image = zr_dvec3_add_scaled(p, normal, -2.0 * zr_dvec3_dot(p, normal));
        if (!zr_near_grid_has(t->work, t->grid, zr_dvec3_add_scaled(t->center, image, 1.0))) return false;
    }
    return true;
}

static bool is_turn(const struct trying *t, zr_dvec3 axis, double degrees)
{
    struct zr_cylinder_frame frame;
    double sine, cosine;
    zr_cylinder_frame_turn(&frame, axis);
    zr_sine_cosine(degrees, &sine, &cosine);
    for (uint32_t i = 0; i < t->count; i++) {
        const zr_dvec3 p = t->samples[i];
        const double x = zr_dvec3_dot(p, frame.u), y = zr_dvec3_dot(p, frame.v), z = zr_dvec3_dot(p, frame.axis);
        zr_dvec3 image = zr_dvec3_add_scaled(t->center, frame.u, cosine * x - sine * y);
        image = zr_dvec3_add_scaled(image, frame.v, sine * x + cosine * y);
        image = zr_dvec3_add_scaled(image, frame.axis, z);
        if (!zr_near_grid_has(t->work, t->grid, image)) return false;
    }
    return true;
}

static bool is_round(const struct trying *t, zr_dvec3 axis)
{
    for (size_t i = 0; i < sizeof ODD_TURNS / sizeof *ODD_TURNS; i++)
        if (!is_turn(t, axis, ODD_TURNS[i])) return false;
    return true;
}

/* Returns the largest number of equal turns in a circle; 1: none, 0: round. */
static uint32_t order_of(const struct trying *t, zr_dvec3 axis)
{
    if (is_round(t, axis)) return 0;
    uint32_t order = ZR_TURNS_MOST;
    while (order > 1 && !is_turn(t, axis, 360.0 / order))
        order--;
    return order;
}

bool zr_symmetry_find(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_surface *surface,
                      struct zr_symmetry *out)
{
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    struct zr_near_grid grid;
    zr_dvec3 *samples = zr_arena_alloc(&scratch, SAMPLES_MOST, sizeof *samples);
    const bool ok = samples && zr_near_grid_make(&scratch, work, surface, REACH * surface->size, &grid);
    if (ok) {
        const struct trying t = {work, &grid, out->center, samples, sample(work, surface, out->center, samples)};
        for (uint32_t i = 0; i < out->direction_count && !work->is_stopped; i++) {
            const zr_dvec3 axis = out->directions[i];
            if (is_mirror(&t, axis)) out->mirrors[out->mirror_count++] = axis;
            const uint32_t order = order_of(&t, axis);
            if (order != 1) out->turns[out->turn_count++] = (struct zr_turn){axis, order};
        }
    }
    zr_arena_close_scratch(&scratch, arena);
    return ok && !work->is_stopped;
}
