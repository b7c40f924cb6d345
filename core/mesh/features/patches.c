#include "mesh/features/patches.h"

#include <string.h>

#include "base/sort.h"
#include "mesh/features/smooth_ends.h"

enum {
    SMALL = 2 /* triangles of a facet */,
    ROUNDS = 20,
    FACETS_LEAST = 3,
    FACETS_OF_FREE_FORM = 4,
    FACETS_OF_CYLINDER = 6,
    SEEDS_IN_VAIN = 1 << 18
};

static const double COS_SOFT = 0.469;                     /* 62 degrees */
static const double WIDTHS_MOST = 2.5;                    /* of neighbours in a seed */
static const double WIDTH_MOST = 1.1;                     /* of a facet, of the radius */
static const double ACROSS = 5e-3;                        /* sine of the tilt of a facet against the axis */
static const double ACROSS_ON_CIRCLE = 0.1;               /* the same if all its corners lie on the cylinder */
static const double GROW_RADIUS = 2e-3, GROW_SIZE = 1e-5; /* distance from the circle, of radius and size */
static const double KEEP_RADIUS = 3e-3, KEEP_SIZE = 2e-5;

struct growing {
    struct zr_feature_work *work;
    const struct zr_facets *facets;
    uint32_t *owners;   /* per facet: number of its patch; ZR_NO_FACET */
    uint32_t *attempts; /* per facet: number of the last free form it was in; 0: none */
    uint32_t attempt;
    struct zr_patch *patches;
    uint32_t *list; /* facets of patches */
    uint32_t count, listed;
    uint32_t since; /* seeds since a patch like a cylinder */
};

static zr_dvec3 place_of(const struct zr_facets *facets, uint32_t triangle, int corner)
{
    return facets->surface->places[facets->surface->corners[triangle][corner]];
}

/* ---- growth ---- */

static bool is_on_circle(double radius, const struct zr_cylinder_frame *frame, double tolerance)
{
    return fabs(radius - frame->radius) <= tolerance;
}

static bool fits(const struct growing *g, const struct zr_patch *patch, uint32_t facet)
{
    const struct zr_cylinder_frame *frame = &patch->frame;
    const zr_dvec3 normal = g->facets->normals[facet];
    const double tolerance = zr_most_of(GROW_RADIUS * frame->radius, GROW_SIZE * g->facets->surface->size);
    const double tilt = fabs(zr_dvec3_dot(normal, frame->axis));
    struct zr_facet_span span;
    if (tilt > ACROSS_ON_CIRCLE) return false;
    if (!zr_facet_span_of(g->work, g->facets, facet, frame, frame->radius + tolerance, &span)) return false;
    if (!is_on_circle(span.first_radius, frame, tolerance) || !is_on_circle(span.last_radius, frame, tolerance) ||
        span.width > WIDTH_MOST * frame->radius)
        return false;
    if (tilt > ACROSS && span.least < frame->radius - tolerance) return false;
    return zr_facet_span_faces(&span, patch->is_concave);
}

static void append(struct growing *g, struct zr_patch *patch, uint32_t facet)
{
    g->owners[facet] = g->count;
    g->list[patch->end++] = facet;
}

/* Adds neighbours of the patch's facets until it has `most`. */
static void add_neighbours(struct growing *g, struct zr_patch *patch, uint32_t most)
{
    const struct zr_facets *facets = g->facets;
    for (uint32_t i = patch->begin; i < patch->end && patch->end - patch->begin < most; i++) {
        const uint32_t facet = g->list[i];
        for (uint32_t j = facets->begins[facet]; j < facets->begins[facet + 1]; j++)
            for (int k = 0; k < 3; k++) {
                const uint32_t next = facets->neighbours[facets->triangles[j]][k];
                const uint32_t other = next == ZR_NO_FACET ? facet : facets->of_triangle[next];
                if (!zr_feature_has_steps(g->work, 1)) return;
                if (g->owners[other] != ZR_NO_FACET ||
                    zr_dvec3_dot(facets->normals[facet], facets->normals[other]) < COS_SOFT)
                    continue;
                if (fits(g, patch, other)) append(g, patch, other);
            }
    }
}

static bool grow(struct growing *g, struct zr_patch *patch)
{
    for (int round = 0; round < ROUNDS; round++) {
        const uint32_t before = patch->end - patch->begin;
        add_neighbours(g, patch, 2 * before);
        if (g->work->is_stopped || patch->end - patch->begin < FACETS_LEAST) return false;
        if (round > 0 && patch->end - patch->begin == before) return true;
        if (!zr_patch_fit(g->work, g->facets, g->list + patch->begin, patch->end - patch->begin, &patch->frame))
            return false;
    }
    return true;
}

/* Finds the range along the axis. False if the facets are off the cylinder. */
static bool measure(const struct growing *g, struct zr_patch *patch)
{
    const double tolerance = KEEP_RADIUS * patch->frame.radius + KEEP_SIZE * g->facets->surface->size;
    struct zr_facet_span span;
    patch->low = HUGE_VAL;
    patch->high = -HUGE_VAL;
    for (uint32_t i = patch->begin; i < patch->end; i++) {
        if (!zr_facet_span_of(g->work, g->facets, g->list[i], &patch->frame, HUGE_VAL, &span)) return false;
        if (!is_on_circle(span.first_radius, &patch->frame, tolerance) ||
            !is_on_circle(span.last_radius, &patch->frame, tolerance) || !zr_facet_span_faces(&span, patch->is_concave))
            return false;
        patch->low = zr_least_of(patch->low, span.low);
        patch->high = zr_most_of(patch->high, span.high);
    }
    return true;
}

/* ---- seeds ---- */

/* Returns how far a facet reaches from an edge; 0: it reaches behind the edge, or farther than `most`. */
static double width_of(const struct growing *g, uint32_t facet, zr_dvec3 edge, zr_dvec3 inwards, double most)
{
    const struct zr_facets *facets = g->facets;
    double low = 0.0, high = 0.0;
    for (uint32_t i = facets->begins[facet]; i < facets->begins[facet + 1]; i++) {
        if (!zr_feature_has_steps(g->work, 1)) return 0.0;
        for (int k = 0; k < 3; k++) {
            const double at = zr_dvec3_dot(zr_dvec3_sub(place_of(facets, facets->triangles[i], k), edge), inwards);
            low = zr_least_of(low, at);
            high = zr_most_of(high, at);
        }
        if (high > most) return 0.0;
    }
    return low < -0.02 * high - 2.0 * facets->surface->noise ? 0.0 : high;
}

/* Makes a patch of the facets beside an edge. False if they are not alike. */
static bool plant(struct growing *g, uint32_t side, struct zr_patch *patch)
{
    const struct zr_facets *facets = g->facets;
    const uint32_t triangle = side / 3, a = facets->of_triangle[triangle],
                   b = facets->of_triangle[facets->neighbours[triangle][side % 3]];
    const zr_dvec3 from = place_of(facets, triangle, (int)(side % 3)),
                   to = place_of(facets, triangle, (int)((side % 3 + 1) % 3)), edge = zr_dvec3_sub(to, from);
    const double length = sqrt(zr_dvec3_dot(edge, edge));
    const zr_dvec3 axis = {edge.x / length, edge.y / length, edge.z / length};
    const zr_dvec3 in_a = zr_dvec3_cross(facets->normals[a], axis), in_b = zr_dvec3_cross(axis, facets->normals[b]);
    const double size = facets->surface->size;
    const double count_a = facets->begins[a + 1] - facets->begins[a],
                 count_b = facets->begins[b + 1] - facets->begins[b];
    double wide_a, wide_b;
    if (count_a <= count_b) {
        wide_a = width_of(g, a, from, in_a, size);
        wide_b = wide_a > 0.0 ? width_of(g, b, from, in_b, WIDTHS_MOST * wide_a) : 0.0;
    } else {
        wide_b = width_of(g, b, from, in_b, size);
        wide_a = wide_b > 0.0 ? width_of(g, a, from, in_a, WIDTHS_MOST * wide_b) : 0.0;
    }
    if (!(wide_a > 0.0 && wide_b > 0.0) || wide_a > WIDTHS_MOST * wide_b || wide_b > WIDTHS_MOST * wide_a) return false;
    struct zr_circle_sums circle = {0};
    double x, y;
    *patch = (struct zr_patch){.begin = g->listed, .end = g->listed};
    patch->frame.center = from;
    zr_cylinder_frame_turn(&patch->frame, axis);
    zr_circle_sums_add(&circle, 0.0, 0.0);
    zr_circle_sums_add(&circle, wide_a * zr_dvec3_dot(in_a, patch->frame.u),
                       wide_a * zr_dvec3_dot(in_a, patch->frame.v));
    zr_circle_sums_add(&circle, wide_b * zr_dvec3_dot(in_b, patch->frame.u),
                       wide_b * zr_dvec3_dot(in_b, patch->frame.v));
    if (!zr_circle_sums_fit(&circle, &x, &y, &patch->frame.radius) || patch->frame.radius > ZR_PATCH_RADIUS_MOST * size)
        return false;
    patch->frame.center = zr_dvec3_add_scaled(zr_dvec3_add_scaled(from, patch->frame.u, x), patch->frame.v, y);
    patch->is_concave = zr_dvec3_dot(in_b, facets->normals[a]) > 0.0;
    append(g, patch, a);
    append(g, patch, b);
    return true;
}

/* Returns true if a third facet beside a small one of a seed may be on the same cylinder. Most facets of free forms
 * have none. */
static bool may_go_on(const struct growing *g, uint32_t facet, uint32_t other, zr_dvec3 edge)
{
    const struct zr_facets *facets = g->facets;
    const double square = zr_dvec3_dot(edge, edge) * (ACROSS_ON_CIRCLE * ACROSS_ON_CIRCLE);
    if (facets->begins[facet + 1] - facets->begins[facet] > SMALL) return true;
    for (uint32_t i = facets->begins[facet]; i < facets->begins[facet + 1]; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t next = facets->neighbours[facets->triangles[i]][k];
            const uint32_t third = next == ZR_NO_FACET ? facet : facets->of_triangle[next];
            const double along = zr_dvec3_dot(facets->normals[third], edge);
            if (third != facet && third != other && g->owners[third] == ZR_NO_FACET && along * along <= square)
                return true;
        }
    return false;
}

static void try_seed(struct growing *g, uint32_t side)
{
    const struct zr_facets *facets = g->facets;
    const uint32_t a = facets->of_triangle[side / 3], b = facets->of_triangle[facets->neighbours[side / 3][side % 3]];
    struct zr_patch patch;
    if (g->owners[a] != ZR_NO_FACET || g->owners[b] != ZR_NO_FACET) return;
    if (g->attempts[a] != 0 && g->attempts[a] == g->attempts[b]) return;
    const zr_dvec3 edge = zr_dvec3_sub(place_of(facets, side / 3, (int)((side % 3 + 1) % 3)),
                                       place_of(facets, side / 3, (int)(side % 3)));
    if (!may_go_on(g, a, b, edge) && !may_go_on(g, b, a, edge)) return;
    if (!plant(g, side, &patch)) return;
    bool is_kept = grow(g, &patch) && measure(g, &patch);
    if (is_kept && zr_patch_is_free(g->work, facets, &patch, g->list, g->owners, g->count)) {
        is_kept = false;
        g->attempt++;
        for (uint32_t i = patch.begin; i < patch.end && patch.end - patch.begin >= FACETS_OF_FREE_FORM; i++)
            g->attempts[g->list[i]] = g->attempt;
    }
    if (is_kept) {
        if (patch.end - patch.begin >= FACETS_OF_CYLINDER) g->since = 0;
        g->patches[g->count++] = patch;
        g->listed = patch.end;
        return;
    }
    for (uint32_t i = patch.begin; i < patch.end; i++)
        g->owners[g->list[i]] = ZR_NO_FACET;
}

/* Lists the edges between facets that turn softly; the lowest key is the longest edge. */
static uint32_t list_seeds(const struct growing *g, uint64_t *seeds)
{
    const struct zr_facets *facets = g->facets;
    uint32_t count = 0;
    for (uint32_t t = 0; t < facets->surface->triangle_count && zr_feature_has_steps(g->work, 1); t++)
        for (int k = 0; k < 3; k++) {
            const uint32_t u = facets->neighbours[t][k];
            if (u == ZR_NO_FACET || u < t || facets->of_triangle[t] == facets->of_triangle[u]) continue;
            if (zr_dvec3_dot(facets->normals[facets->of_triangle[t]], facets->normals[facets->of_triangle[u]]) <
                COS_SOFT)
                continue;
            const zr_dvec3 edge = zr_dvec3_sub(place_of(facets, t, (k + 1) % 3), place_of(facets, t, k));
            const float length = (float)zr_dvec3_dot(edge, edge);
            uint32_t bits;
            memcpy(&bits, &length, sizeof bits);
            seeds[count++] = (uint64_t)~bits << 32 | (3 * t + (uint32_t)k);
        }
    return count;
}

bool zr_patches_find(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_facets *facets,
                     struct zr_patches *out)
{
    struct growing g = {.work = work, .facets = facets};
    g.patches = zr_arena_alloc(arena, facets->count / FACETS_LEAST, sizeof *g.patches);
    g.list = zr_arena_alloc(arena, facets->count, sizeof *g.list);
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    g.owners = zr_arena_alloc(&scratch, facets->count, sizeof *g.owners);
    g.attempts = zr_arena_zero(&scratch, facets->count, sizeof *g.attempts);
    uint64_t *seeds = zr_arena_alloc(&scratch, 3 * (size_t)facets->surface->triangle_count / 2, sizeof *seeds);
    const bool ok = zr_arena_ok(arena) && zr_arena_ok(&scratch);
    if (ok) {
        memset(g.owners, 0xff, facets->count * sizeof *g.owners);
        const uint32_t count = list_seeds(&g, seeds);
        if (zr_feature_has_steps(work, 4 * (uint64_t)count)) zr_sort_u64(seeds, count);
        for (uint32_t i = 0; i < count && g.since++ < SEEDS_IN_VAIN && zr_feature_has_steps(work, 1); i++)
            try_seed(&g, (uint32_t)seeds[i]);
    }
    zr_arena_close_scratch(&scratch, arena);
    *out = (struct zr_patches){.count = g.count, .at = g.patches, .facets = g.list};
    return ok && !work->is_stopped;
}
