#include "mesh/features/patches.h"

#include <string.h>

#include "mesh/features/smooth_ends.h"

enum { ROUNDS = 20, FACETS_LEAST = 3, FACETS_OF_FREE_FORM = 4, FACETS_OF_CYLINDER = 8, SEEDS_IN_VAIN = 1 << 15 };

static const double KEEP_RADIUS = 3e-3, KEEP_SIZE = 2e-5; /* distance of corners from the circle, of radius and size */

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

/* ---- growth ---- */

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
                    zr_dvec3_dot(facets->normals[facet], facets->normals[other]) < ZR_PATCH_SOFT)
                    continue;
                if (zr_patch_fits(g->work, facets, patch, other)) append(g, patch, other);
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
        if (!zr_radius_fits(span.first_radius, &patch->frame, tolerance) ||
            !zr_radius_fits(span.last_radius, &patch->frame, tolerance) ||
            !zr_facet_span_faces(&span, patch->is_concave))
            return false;
        patch->low = zr_least_of(patch->low, span.low);
        patch->high = zr_most_of(patch->high, span.high);
    }
    return true;
}

static void try_seed(struct growing *g, uint32_t side)
{
    const struct zr_facets *facets = g->facets;
    const uint32_t a = facets->of_triangle[side / 3], b = facets->of_triangle[facets->neighbours[side / 3][side % 3]];
    struct zr_patch patch;
    if (g->owners[a] != ZR_NO_FACET || g->owners[b] != ZR_NO_FACET) return;
    if (g->attempts[a] != 0 && g->attempts[a] == g->attempts[b]) return;
    if (!zr_seed_plant(g->work, facets, side, &patch)) return;
    patch.begin = patch.end = g->listed;
    append(g, &patch, a);
    append(g, &patch, b);
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

bool zr_patches_find(struct zr_arena *arena, struct zr_feature_work *work, const struct zr_facets *facets,
                     const struct zr_seeds *seeds, struct zr_patches *out)
{
    struct growing g = {.work = work, .facets = facets};
    g.patches = zr_arena_alloc(arena, facets->count / FACETS_LEAST, sizeof *g.patches);
    g.list = zr_arena_alloc(arena, facets->count, sizeof *g.list);
    struct zr_arena scratch = zr_arena_open_scratch(arena);
    g.owners = zr_arena_alloc(&scratch, facets->count, sizeof *g.owners);
    g.attempts = zr_arena_zero(&scratch, facets->count, sizeof *g.attempts);
    const bool ok = zr_arena_ok(arena) && zr_arena_ok(&scratch);
    if (ok) {
        memset(g.owners, 0xff, facets->count * sizeof *g.owners);
        for (uint32_t i = 0; i < seeds->count && g.since++ < SEEDS_IN_VAIN && zr_feature_has_steps(work, 1); i++)
            try_seed(&g, (uint32_t)seeds->sides[i]);
    }
    zr_arena_close_scratch(&scratch, arena);
    *out = (struct zr_patches){.count = g.count, .at = g.patches, .facets = g.list};
    return ok && !work->is_stopped;
}
