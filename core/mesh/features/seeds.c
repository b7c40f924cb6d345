#include "mesh/features/seeds.h"

#include <string.h>

enum { DIGIT = 8, DIGITS = 1 << DIGIT, SEEDS_PER_LOOK = 1 << 12, SEEDS_PER_RANGE = 1 << 9, STEPS_OF_EDGE = 8 };

static const double WIDTHS_MOST = 2.5; /* of neighbours */

struct listing {
    const struct zr_cancel *cancel;
    const struct zr_facets *facets;
    uint64_t *seeds; /* 0: passed over */
};

static zr_dvec3 place_of(const struct zr_facets *facets, uint32_t triangle, int corner)
{
    return facets->surface->places[facets->surface->corners[triangle][corner]];
}

/* ---- patches of two facets ---- */

/* Returns how far a facet reaches from an edge; 0: it reaches behind the edge, or farther than `most`. */
static double width_of(struct zr_feature_work *work, const struct zr_facets *facets, uint32_t facet, zr_dvec3 edge,
                       zr_dvec3 inwards, double most)
{
    double low = 0.0, high = 0.0;
    for (uint32_t i = facets->begins[facet]; i < facets->begins[facet + 1]; i++) {
        if (!zr_feature_has_steps(work, 1)) return 0.0;
        for (int k = 0; k < 3; k++) {
            const double at = zr_dvec3_dot(zr_dvec3_sub(place_of(facets, facets->triangles[i], k), edge), inwards);
            low = zr_least_of(low, at);
            high = zr_most_of(high, at);
        }
        if (high > most) return 0.0;
    }
    return low < -0.02 * high - 2.0 * facets->surface->noise ? 0.0 : high;
}

bool zr_seed_plant(struct zr_feature_work *work, const struct zr_facets *facets, uint32_t side, struct zr_patch *patch)
{
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
        wide_a = width_of(work, facets, a, from, in_a, size);
        wide_b = wide_a > 0.0 ? width_of(work, facets, b, from, in_b, WIDTHS_MOST * wide_a) : 0.0;
    } else {
        wide_b = width_of(work, facets, b, from, in_b, size);
        wide_a = wide_b > 0.0 ? width_of(work, facets, a, from, in_a, WIDTHS_MOST * wide_b) : 0.0;
    }
    if (!(wide_a > 0.0 && wide_b > 0.0) || wide_a > WIDTHS_MOST * wide_b || wide_b > WIDTHS_MOST * wide_a) return false;
    struct zr_circle_sums circle = {0};
    double x, y;
    *patch = (struct zr_patch){.begin = 0};
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
    return true;
}

/* ---- third facets ---- */

/* Returns true if a neighbour of a facet fits. */
static bool has_third(struct zr_feature_work *work, const struct zr_facets *facets, const struct zr_patch *patch,
                      uint32_t facet, uint32_t other)
{
    for (uint32_t i = facets->begins[facet]; i < facets->begins[facet + 1]; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t next = facets->neighbours[facets->triangles[i]][k];
            const uint32_t third = next == ZR_NO_FACET ? facet : facets->of_triangle[next];
            if (third == facet || third == other) continue;
            if (!zr_feature_has_steps(work, 1)) return false;
            if (zr_dvec3_dot(facets->normals[facet], facets->normals[third]) >= ZR_PATCH_SOFT &&
                zr_patch_fits(work, facets, patch, third))
                return true;
        }
    return false;
}

static void try_range(void *context, size_t begin, size_t end)
{
    const struct listing *l = context;
    const struct zr_facets *facets = l->facets;
    for (size_t i = begin; i < end && !zr_is_cancelled(l->cancel); i++) {
        const uint32_t side = (uint32_t)l->seeds[i], a = facets->of_triangle[side / 3],
                       b = facets->of_triangle[facets->neighbours[side / 3][side % 3]];
        struct zr_feature_work own = {.steps_most = ZR_SEED_STEPS};
        struct zr_patch patch;
        const bool is_seed = zr_seed_plant(&own, facets, side, &patch) &&
                             (has_third(&own, facets, &patch, a, b) || has_third(&own, facets, &patch, b, a));
        if (!is_seed) l->seeds[i] = 0;
    }
}

/* ---- lists ---- */

/* Lists the edges between facets that turn softly; the lowest key is the longest edge. */
static uint32_t list(struct zr_feature_work *work, const struct zr_facets *facets, uint64_t *seeds)
{
    uint32_t count = 0;
    for (uint32_t t = 0; t < facets->surface->triangle_count && zr_feature_has_steps(work, 1 + STEPS_OF_EDGE); t++)
        for (int k = 0; k < 3; k++) {
            const uint32_t u = facets->neighbours[t][k];
            if (u == ZR_NO_FACET || u < t || facets->of_triangle[t] == facets->of_triangle[u]) continue;
            if (zr_dvec3_dot(facets->normals[facets->of_triangle[t]], facets->normals[facets->of_triangle[u]]) <
                ZR_PATCH_SOFT)
                continue;
            const zr_dvec3 edge = zr_dvec3_sub(place_of(facets, t, (k + 1) % 3), place_of(facets, t, k));
            const float length = (float)zr_dvec3_dot(edge, edge);
            uint32_t bits;
            memcpy(&bits, &length, sizeof bits);
            seeds[count++] = (uint64_t)(~bits | 1u) << 32 | (3 * t + (uint32_t)k);
        }
    return count;
}

/* Sorts the seeds by their upper halves; equal ones keep their order. `spare` has room for as many. */
static void sort(struct zr_feature_work *work, uint64_t *seeds, uint64_t *spare, uint32_t count)
{
    uint64_t *from = seeds, *to = spare;
    for (int shift = 32; shift < 64; shift += DIGIT) {
        uint32_t begins[DIGITS + 1] = {0};
        for (uint32_t i = 0; i < count; i++) {
            if (i % SEEDS_PER_LOOK == 0 && !zr_feature_has_steps(work, SEEDS_PER_LOOK / 16)) return;
            begins[(from[i] >> shift) % DIGITS + 1]++;
        }
        for (int d = 0; d < DIGITS; d++)
            begins[d + 1] += begins[d];
        for (uint32_t i = 0; i < count; i++) {
            if (i % SEEDS_PER_LOOK == 0 && !zr_feature_has_steps(work, SEEDS_PER_LOOK / 16)) return;
            to[begins[(from[i] >> shift) % DIGITS]++] = from[i];
        }
        uint64_t *other = from;
        from = to;
        to = other;
    }
}

static uint32_t keep(uint64_t *seeds, uint32_t count)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++)
        if (seeds[i] != 0) seeds[kept++] = seeds[i];
    return kept;
}

bool zr_seeds_find(struct zr_arena *arena, struct zr_team *team, struct zr_feature_work *work,
                   const struct zr_facets *facets, struct zr_seeds *out)
{
    const size_t most = 3 * (size_t)facets->surface->triangle_count / 2;
    uint64_t *seeds = zr_arena_alloc(arena, most, sizeof *seeds);
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    uint64_t *spare = zr_arena_alloc(&scratch, most, sizeof *spare);
    *out = (struct zr_seeds){.sides = seeds};
    if (seeds && spare) {
        const struct listing listing = {work->cancel, facets, seeds};
        out->count = list(work, facets, seeds);
        if (!work->is_stopped)
            zr_team_ranges(team, out->count, SEEDS_PER_RANGE, try_range, (void *)(uintptr_t)&listing);
        out->count = keep(seeds, out->count);
        sort(work, seeds, spare, out->count);
    }
    zr_arena_close_scratch(&scratch, arena);
    return seeds && spare && !work->is_stopped && !zr_is_cancelled(work->cancel);
}
