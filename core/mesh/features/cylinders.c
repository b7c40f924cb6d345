#include "mesh/features/cylinders.h"

#include <string.h>

#include "base/sort.h"
#include "mesh/features/angles.h"

enum { FACETS_LEAST = 4 /* of a hole, boss or fillet */ };

static const double PARALLEL = 0.9998;                  /* cosine of 1.1 degrees */
static const double SAME_RADIUS = 5e-3;                 /* relative */
static const double OFF_AXIS = 1e-2;                    /* of the radius */
static const double OFF_AXIS_SIZE = 2e-5;               /* of the size */
static const double TOUCH = 1e-4;                       /* of the size: gap between ranges along the axis */
static const double FIT_RADIUS = 4e-3, FIT_SIZE = 2e-5; /* of a joined cylinder */
static const double SEGMENT = 0.1;                      /* degrees on both sides of a facet's direction */

struct joining {
    struct zr_feature_work *work;
    const struct zr_facets *facets;
    const struct zr_patches *patches;
    uint32_t *parents; /* per patch */
    uint64_t *order;   /* patches by radius, or by the first patch of their cylinder */
    uint32_t *list;    /* facets of a cylinder */
};

static zr_dvec3 middle_of(const struct zr_cylinder_frame *frame, double low, double high)
{
    return zr_dvec3_add_scaled(frame->center, frame->axis, 0.5 * (low + high));
}

static bool is_on_axis(const struct zr_cylinder_frame *a, const struct zr_cylinder_frame *b, zr_dvec3 place,
                       double tolerance)
{
    const zr_dvec3 p = zr_dvec3_sub(place, a->center);
    const double x = zr_dvec3_dot(p, a->u), y = zr_dvec3_dot(p, a->v);
    return fabs(zr_dvec3_dot(a->axis, b->axis)) >= PARALLEL && x * x + y * y <= tolerance * tolerance;
}

bool zr_cylinders_share_axis(const struct zr_cylinder *a, const struct zr_cylinder *b, double tolerance)
{
    return is_on_axis(&a->frame, &b->frame, middle_of(&b->frame, b->low, b->high), tolerance);
}

static void range_along(const struct zr_cylinder_frame *a, const struct zr_cylinder_frame *b, double low, double high,
                        double range[2])
{
    const double middle = zr_dvec3_dot(zr_dvec3_sub(b->center, a->center), a->axis);
    const bool turns = zr_dvec3_dot(a->axis, b->axis) < 0.0;
    range[0] = middle + (turns ? 0.0 - high : low);
    range[1] = middle + (turns ? 0.0 - low : high);
}

void zr_cylinder_range_along(const struct zr_cylinder *a, const struct zr_cylinder *b, double range[2])
{
    range_along(&a->frame, &b->frame, b->low, b->high, range);
}

/* ---- joining ---- */

static uint32_t root_of(uint32_t *parents, uint32_t p)
{
    while (parents[p] != p)
        p = parents[p] = parents[parents[p]];
    return p;
}

static bool belong_together(const struct joining *j, const struct zr_patch *a, const struct zr_patch *b)
{
    const double size = j->facets->surface->size;
    double range[2];
    if (a->is_concave != b->is_concave) return false;
    if (!is_on_axis(&a->frame, &b->frame, middle_of(&b->frame, b->low, b->high),
                    zr_most_of(OFF_AXIS * a->frame.radius, OFF_AXIS_SIZE * size)))
        return false;
    range_along(&a->frame, &b->frame, b->low, b->high, range);
    return range[0] <= a->high + TOUCH * size && range[1] >= a->low - TOUCH * size;
}

/* Sorts numbers of patches by a key below 2^32 each. */
static void sort_by(const struct joining *j, uint32_t (*key)(const struct joining *j, uint32_t patch))
{
    for (uint32_t p = 0; p < j->patches->count; p++)
        j->order[p] = (uint64_t)key(j, p) << 32 | p;
    zr_sort_u64(j->order, j->patches->count);
}

static uint32_t key_of_radius(const struct joining *j, uint32_t patch)
{
    const float radius = (float)j->patches->at[patch].frame.radius;
    uint32_t bits;
    memcpy(&bits, &radius, sizeof bits);
    return bits;
}

static uint32_t key_of_root(const struct joining *j, uint32_t patch)
{
    return root_of(j->parents, patch);
}

static void join_patches(const struct joining *j)
{
    const struct zr_patch *patches = j->patches->at;
    for (uint32_t p = 0; p < j->patches->count; p++)
        j->parents[p] = p;
    sort_by(j, key_of_radius);
    for (uint32_t i = 0; i < j->patches->count; i++) {
        const uint32_t a = (uint32_t)j->order[i];
        const double most = patches[a].frame.radius * (1.0 + SAME_RADIUS) + OFF_AXIS_SIZE * j->facets->surface->size;
        for (uint32_t k = i + 1; k < j->patches->count; k++) {
            const uint32_t b = (uint32_t)j->order[k];
            if (patches[b].frame.radius > most || !zr_feature_has_steps(j->work, 1)) break;
            if (!belong_together(j, &patches[a], &patches[b])) continue;
            const uint32_t x = root_of(j->parents, a), y = root_of(j->parents, b);
            j->parents[x < y ? y : x] = x < y ? x : y;
        }
    }
}

/* ---- measuring ---- */

static void add_facet(const struct joining *j, uint32_t facet, const struct zr_facet_span *span,
                      struct zr_angle_set *covered, struct zr_angle_set *directions, struct zr_cylinder *out)
{
    const zr_dvec3 normal = j->facets->normals[facet];
    const double x = zr_dvec3_dot(normal, out->frame.u), y = zr_dvec3_dot(normal, out->frame.v);
    const double first = zr_angle_of(span->first[0], span->first[1]), last = zr_angle_of(span->last[0], span->last[1]),
                 direction = zr_angle_of(x, y);
    const double before = direction - SEGMENT, after = direction + SEGMENT;
    if (out->is_concave)
        zr_angle_set_add(covered, last, first);
    else
        zr_angle_set_add(covered, first, last);
    zr_angle_set_add(directions, before < 0.0 ? before + 360.0 : before, after >= 360.0 ? after - 360.0 : after);
    out->flat = zr_least_of(out->flat, fabs(x * span->first[0] + y * span->first[1]));
    out->low = zr_least_of(out->low, span->low);
    out->high = zr_most_of(out->high, span->high);
}

/* Measures a cylinder of facets. False if they are not on it. */
static bool measure(const struct joining *j, const uint32_t *list, uint32_t count, struct zr_cylinder *out)
{
    const double tolerance = FIT_RADIUS * out->frame.radius + FIT_SIZE * j->facets->surface->size;
    struct zr_angle_set covered = {{0}}, directions = {{0}};
    struct zr_facet_span span;
    out->low = HUGE_VAL;
    out->high = -HUGE_VAL;
    out->flat = out->frame.radius;
    for (uint32_t i = 0; i < count; i++) {
        if (!zr_facet_span_of(j->work, j->facets, list[i], &out->frame, HUGE_VAL, &span)) return false;
        if (fabs(span.first_radius - out->frame.radius) > tolerance ||
            fabs(span.last_radius - out->frame.radius) > tolerance || !zr_facet_span_faces(&span, out->is_concave))
            return false;
        out->error = zr_most_of(out->error, zr_most_of(fabs(span.first_radius - out->frame.radius),
                                                       fabs(span.last_radius - out->frame.radius)));
        add_facet(j, list[i], &span, &covered, &directions, out);
    }
    out->coverage = zr_angle_set_degrees(&covered);
    out->facets = zr_angle_set_arcs(&directions);
    if (out->coverage > 180.0 &&
        !zr_cone_ends_find(j->work, j->facets, list, count, &out->frame, out->low, out->high, out->cones))
        return false;
    out->segments = out->coverage > 0.0 ? (uint32_t)(out->facets * (360.0 / out->coverage) + 0.5) : 0;
    return true;
}

static bool add_patch(const struct joining *j, const struct zr_patch *patch, struct zr_cylinder *out)
{
    *out = (struct zr_cylinder){.frame = patch->frame, .is_concave = patch->is_concave};
    return measure(j, j->patches->facets + patch->begin, patch->end - patch->begin, out);
}

/* Makes the cylinder of a group of patches, or those of each of them. Returns their number. */
static uint32_t add_group(const struct joining *j, const uint64_t *group, uint32_t count, struct zr_cylinder *out)
{
    const struct zr_patch *first = &j->patches->at[(uint32_t)group[0]];
    uint32_t made = 0, facets = 0, all = 0;
    for (uint32_t i = 0; i < count && count > 1; i++) {
        const struct zr_patch *patch = &j->patches->at[(uint32_t)group[i]];
        memcpy(j->list + facets, j->patches->facets + patch->begin, (patch->end - patch->begin) * sizeof *j->list);
        facets += patch->end - patch->begin;
    }
    for (uint32_t i = 0; i < count; i++)
        all += j->patches->at[(uint32_t)group[i]].end - j->patches->at[(uint32_t)group[i]].begin;
    if (all < FACETS_LEAST) return 0;
    *out = (struct zr_cylinder){.frame = first->frame, .is_concave = first->is_concave};
    if (count > 1 && zr_patch_fit(j->work, j->facets, j->list, facets, &out->frame) && measure(j, j->list, facets, out))
        return 1;
    for (uint32_t i = 0; i < count; i++)
        made += add_patch(j, &j->patches->at[(uint32_t)group[i]], &out[made]);
    return made;
}

bool zr_cylinders_find(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_facets *facets,
                       const struct zr_seeds *seeds, struct zr_cylinders *out)
{
    struct zr_patches patches;
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    bool ok = zr_patches_find(&scratch, work, facets, seeds, &patches);
    struct joining j = {.work = work, .facets = facets, .patches = &patches};
    struct zr_cylinder *cylinders = NULL;
    *out = (struct zr_cylinders){.count = 0};
    if (ok) {
        j.parents = zr_arena_alloc(&scratch, patches.count, sizeof *j.parents);
        j.order = zr_arena_alloc(&scratch, patches.count, sizeof *j.order);
        j.list = zr_arena_alloc(&scratch, facets->count, sizeof *j.list);
        cylinders = zr_arena_alloc_beside(arena, &scratch, patches.count, sizeof *cylinders);
        ok = zr_arena_ok(&scratch) && cylinders;
    }
    if (ok) {
        join_patches(&j);
        sort_by(&j, key_of_root);
        for (uint32_t i = 0, next; i < patches.count && !work->is_stopped; i = next) {
            for (next = i + 1; next < patches.count && j.order[next] >> 32 == j.order[i] >> 32; next++) {
            }
            out->count += add_group(&j, j.order + i, next - i, cylinders + out->count);
        }
    }
    zr_arena_close_scratch(&scratch, arena);
    out->at = cylinders;
    return ok && !work->is_stopped;
}
