#include "measure/hole_changes.h"

#include <string.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "mesh/features/part_features.h"

enum { ITEMS_PER_CANCEL_CHECK = 1 << 13, NONE = -1, EQUAL = -2 };

/* Lengths that differ by this share are equal, and places by this share of the diagonal. */
#define ALIKE      1e-3
#define SAME_PLACE 1e-5

/* The cosine of half a degree. */
#define PARALLEL 0.9999619230641713

/* Cones whose angles differ by up to this, in degrees, are the same. */
#define SAME_ANGLE 0.5

/* Axes nearer than this share of the diameter are the same. */
#define COAXIAL 0.02

static bool is_due(const struct zr_run *run, size_t i)
{
    return i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(run->cancel);
}

/* ---- holes of a solid ---- */

/* Makes the surface of a solid: a place per vertex. */
static bool make_surface(const struct zr_run *run, struct zr_arena *arena, const struct zr_solid *solid,
                         struct zr_surface *out)
{
    zr_dvec3 *places = zr_arena_alloc(arena, solid->vertex_count, sizeof *places);
    uint32_t(*corners)[3] = zr_arena_alloc(arena, solid->count, sizeof *corners);
    const bool is_turned = solid->is_closed && solid->volume < 0.0;
    double far = 0.0;
    if (!zr_arena_ok(arena)) return false;
    for (uint32_t t = solid->count; t-- > 0 && !is_due(run, t);)
        for (int k = 0; k < 3; k++) {
            const uint32_t vertex = solid->vertices[t][k];
            const struct zr_world_place at = solid->places[solid->corners[t][k]];
            places[vertex] = (zr_dvec3){at.x, at.y, at.z};
            corners[t][is_turned ? 2 - k : k] = vertex;
        }
    const double middle[3] = {fabs(solid->middle.x), fabs(solid->middle.y), fabs(solid->middle.z)};
    for (int k = 0; k < 3; k++)
        far = zr_most_of(far, middle[k] + zr_most_of(fabs(solid->min[k]), fabs(solid->max[k])));
    *out = (struct zr_surface){.places = places,
                               .corners = (const uint32_t(*)[3])corners,
                               .place_count = solid->vertex_count,
                               .triangle_count = solid->count,
                               .size = solid->diagonal,
                               .noise = zr_most_of(1e-7 * solid->diagonal, (double)FLT_EPSILON * far)};
    return true;
}

/* Finds the holes of a solid, in the arena. False: too much work or memory. */
static bool find_holes(const struct zr_run *run, const struct zr_solid *solid, struct zr_hole **out, uint32_t *count)
{
    struct zr_arena scratch = zr_arena_open_scratch(run->arena);
    struct zr_feature_work work = {.cancel = run->cancel,
                                   .steps_most = ZR_FEATURE_STEPS_MIN + ZR_FEATURE_STEPS * (uint64_t)solid->count};
    struct zr_surface surface;
    struct zr_facets facets;
    struct zr_seeds seeds;
    struct zr_holes holes = {.hole_count = 0};
    bool is_found = make_surface(run, &scratch, solid, &surface) &&
                    zr_facets_make(&scratch, &work, &surface, &facets) &&
                    zr_seeds_find(&scratch, run->team, &work, &facets, &seeds) &&
                    zr_holes_find(&scratch, &work, &facets, &seeds, &holes);
    if (holes.hole_count > ZR_HOLE_CHANGES_HOLES) is_found = false;
    *count = is_found ? holes.hole_count : 0;
    *out = zr_arena_alloc_beside(run->arena, &scratch, *count, sizeof **out);
    if (*out && *count > 0) memcpy(*out, holes.holes, *count * sizeof **out);
    zr_arena_close_scratch(&scratch, run->arena);
    return is_found && *out;
}

/* ---- comparing ---- */

struct comparing {
    const struct zr_run *run;
    struct zr_hole *holes[2];
    uint32_t counts[2];
    int32_t *partners[2]; /* number of a hole of the other solid, NONE or EQUAL */
    double tolerance;
};

static bool is_alike(double a, double b, double tolerance)
{
    return fabs(a - b) <= tolerance + ALIKE * zr_most_of(a, b);
}

static double distance_of(const struct zr_hole *a, const struct zr_hole *b)
{
    const zr_dvec3 way = zr_dvec3_sub(a->at, b->at);
    return sqrt(zr_dvec3_dot(way, way));
}

static bool is_parallel(const struct zr_hole *a, const struct zr_hole *b)
{
    return fabs(zr_dvec3_dot(a->axis, b->axis)) >= PARALLEL;
}

static bool is_same_step(const struct comparing *c, const struct zr_hole_step *a, const struct zr_hole_step *b)
{
    return is_alike(a->diameter, b->diameter, c->tolerance) && is_alike(a->depth, b->depth, c->tolerance) &&
           fabs(a->angle - b->angle) <= SAME_ANGLE;
}

static bool has_same_size(const struct comparing *c, const struct zr_hole *a, const struct zr_hole *b)
{
    if (!is_parallel(a, b) || a->step_count != b->step_count || a->reach != b->reach) return false;
    for (uint32_t i = 0; i < a->step_count; i++)
        if (!is_same_step(c, &a->steps[i], &b->steps[i])) return false;
    return is_alike(a->diameter, b->diameter, c->tolerance) && is_alike(a->depth, b->depth, c->tolerance);
}

/* A hole that goes through may be entered from either side. */
static bool is_at_same_place(const struct comparing *c, const struct zr_hole *a, const struct zr_hole *b)
{
    if (distance_of(a, b) <= c->tolerance) return true;
    struct zr_hole turned = *b;
    turned.at = zr_dvec3_add_scaled(b->at, b->axis, b->depth);
    return b->reach == ZR_REACH_THROUGH && b->step_count == 0 && distance_of(a, &turned) <= c->tolerance;
}

static bool is_coaxial(const struct comparing *c, const struct zr_hole *a, const struct zr_hole *b)
{
    const zr_dvec3 way = zr_dvec3_sub(b->at, a->at), across = zr_dvec3_cross(way, a->axis);
    const double along = fabs(zr_dvec3_dot(way, a->axis)), reach = zr_most_of(a->depth, b->depth);
    return is_parallel(a, b) && along <= 1.001 * reach + c->tolerance &&
           sqrt(zr_dvec3_dot(across, across)) <= c->tolerance + COAXIAL * zr_most_of(a->diameter, b->diameter);
}

/* Pairs the first holes that fit. */
static void pair_equal(struct comparing *c)
{
    for (uint32_t i = 0; i < c->counts[0] && !zr_is_cancelled(c->run->cancel); i++)
        for (uint32_t k = 0; k < c->counts[1] && c->partners[0][i] == NONE; k++)
            if (c->partners[1][k] == NONE && has_same_size(c, &c->holes[0][i], &c->holes[1][k]) &&
                is_at_same_place(c, &c->holes[0][i], &c->holes[1][k]))
                c->partners[0][i] = c->partners[1][k] = EQUAL;
}

static void pair_coaxial(struct comparing *c)
{
    for (uint32_t i = 0; i < c->counts[0] && !zr_is_cancelled(c->run->cancel); i++)
        for (uint32_t k = 0; k < c->counts[1] && c->partners[0][i] == NONE; k++)
            if (c->partners[1][k] == NONE && !has_same_size(c, &c->holes[0][i], &c->holes[1][k]) &&
                is_coaxial(c, &c->holes[0][i], &c->holes[1][k])) {
                c->partners[0][i] = (int32_t)k;
                c->partners[1][k] = (int32_t)i;
            }
}

/* Pairs the two nearest holes of one size. False: there are none. */
static bool pair_nearest(struct comparing *c)
{
    double least = HUGE_VAL;
    uint32_t best[2] = {0, 0};
    for (uint32_t i = 0; i < c->counts[0] && !zr_is_cancelled(c->run->cancel); i++)
        for (uint32_t k = 0; k < c->counts[1] && c->partners[0][i] == NONE; k++) {
            if (c->partners[1][k] != NONE || !has_same_size(c, &c->holes[0][i], &c->holes[1][k])) continue;
            const double distance = distance_of(&c->holes[0][i], &c->holes[1][k]);
            if (!(distance < least)) continue;
            least = distance;
            best[0] = i;
            best[1] = k;
        }
    if (!(least < HUGE_VAL)) return false;
    c->partners[0][best[0]] = (int32_t)best[1];
    c->partners[1][best[1]] = (int32_t)best[0];
    return true;
}

/* ---- results ---- */

static void include(const struct zr_hole *hole, struct zr_hole_change *change)
{
    double radius = 0.5 * hole->diameter, depth = hole->depth;
    for (uint32_t i = 0; i < hole->step_count; i++) {
        radius = zr_most_of(radius, 0.5 * hole->steps[i].diameter);
        depth += hole->steps[i].depth;
    }
    const double at[3] = {hole->at.x, hole->at.y, hole->at.z}, axis[3] = {hole->axis.x, hole->axis.y, hole->axis.z};
    for (int k = 0; k < 3; k++) {
        const double end = at[k] + depth * axis[k], side = radius * sqrt(zr_most_of(0.0, 1.0 - axis[k] * axis[k]));
        change->min[k] = zr_least_of(change->min[k], zr_least_of(at[k], end) - side);
        change->max[k] = zr_most_of(change->max[k], zr_most_of(at[k], end) + side);
    }
}

static struct zr_hole_change change_of(enum zr_hole_change_kind kind, const struct zr_hole *a, const struct zr_hole *b)
{
    struct zr_hole_change change = {
        .kind = kind, .min = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, .max = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    if (a) change.a = *a;
    if (b) change.b = *b;
    if (a) include(a, &change);
    if (b) include(b, &change);
    return change;
}

static void add(struct zr_hole_change *list, struct zr_hole_changes *out, struct zr_hole_change change)
{
    if (out->count < ZR_HOLE_CHANGES_MAX)
        list[out->count++] = change;
    else
        out->omitted++;
}

static enum zr_status list(const struct comparing *c, struct zr_hole_changes *out)
{
    struct zr_hole_change *changes = zr_arena_alloc(c->run->arena, ZR_HOLE_CHANGES_MAX, sizeof *changes);
    if (!changes) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < c->counts[0]; i++) {
        const struct zr_hole *hole = &c->holes[0][i];
        const int32_t partner = c->partners[0][i];
        if (partner == EQUAL) {
            out->equal++;
            continue;
        }
        const struct zr_hole *other = partner >= 0 ? &c->holes[1][partner] : NULL;
        add(changes, out,
            change_of(!other                          ? ZR_HOLE_REMOVED
                      : has_same_size(c, hole, other) ? ZR_HOLE_MOVED
                                                      : ZR_HOLE_CHANGED,
                      hole, other));
    }
    for (uint32_t k = 0; k < c->counts[1]; k++)
        if (c->partners[1][k] == NONE) add(changes, out, change_of(ZR_HOLE_ADDED, NULL, &c->holes[1][k]));
    out->at = changes;
    return ZR_OK;
}

static bool is_large(const struct zr_run *run, const struct zr_solid *solid)
{
    return solid->count > ZR_FEATURE_FACES_MOST ||
           (uint64_t)ZR_FEATURE_BYTES * solid->count + ZR_FEATURE_BYTES_LEAST > zr_arena_left(run->arena);
}

enum zr_status zr_hole_changes_find(const struct zr_run *run, const struct zr_solid *a, const struct zr_solid *b,
                                    double tolerance, struct zr_hole_changes *out)
{
    const struct zr_solid *const solids[2] = {a, b};
    struct comparing c = {.run = run, .tolerance = zr_most_of(tolerance, SAME_PLACE * a->diagonal)};
    *out = (struct zr_hole_changes){.is_omitted = is_large(run, a) || is_large(run, b)};
    for (int i = 0; i < 2 && !out->is_omitted; i++) {
        out->is_omitted = !find_holes(run, solids[i], &c.holes[i], &c.counts[i]);
        c.partners[i] = zr_arena_alloc(run->arena, c.counts[i], sizeof *c.partners[i]);
        if (!zr_arena_ok(run->arena)) return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : ZR_NO_MEMORY;
        for (uint32_t k = 0; k < c.counts[i]; k++)
            c.partners[i][k] = NONE;
    }
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    if (out->is_omitted) return ZR_OK;
    pair_equal(&c);
    pair_coaxial(&c);
    while (pair_nearest(&c) && !zr_is_cancelled(run->cancel)) {
    }
    const enum zr_status status = list(&c, out);
    return zr_is_cancelled(run->cancel) ? ZR_CANCELLED : status;
}
