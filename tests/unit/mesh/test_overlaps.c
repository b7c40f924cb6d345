/* Volumes of parts whose shells overlap or are turned against one another. */
#include <math.h>

#include "support/random.h"
#include "support/test_arena.h"
#include "unit/common/placed_parts.h"

TEST_ARENA(1 << 27)

/* Boxes low .. high in one mesh; a negative first size turns a box inside out. */
struct solid {
    double low[3], size[3];
};

static struct zr_mesh boxes(const struct solid *solids, uint32_t count)
{
    struct zr_mesh mesh = {.name = "boxes", .position_count = 8 * count, .face_count = 6 * count};
    zr_vec4 *positions = zr_arena_alloc(&arena, mesh.position_count, sizeof *positions);
    uint32_t *offsets = zr_arena_alloc(&arena, mesh.face_count + 1, sizeof *offsets);
    uint32_t *indices = zr_arena_alloc(&arena, 4 * mesh.face_count, sizeof *indices);
    assert_non_null(indices);
    for (uint32_t i = 0; i < 8 * count; i++) {
        const struct solid *s = &solids[i / 8];
        const zr_vec4 *at = &cube_positions[i % 8];
        positions[i] =
            (zr_vec4){(float)(s->low[0] + s->size[0] * (double)at->x), (float)(s->low[1] + s->size[1] * (double)at->y),
                      (float)(s->low[2] + s->size[2] * (double)at->z), 1};
    }
    for (uint32_t i = 0; i <= 6 * count; i++)
        offsets[i] = 4 * i;
    for (uint32_t i = 0; i < 24 * count; i++)
        indices[i] = 8 * (i / 24) + cube_indices[i % 24];
    mesh.positions = positions;
    mesh.face_offsets = offsets;
    mesh.indices = indices;
    return mesh;
}

TEST_AROUND(what_is_inside_counts_once, open_arena, close_arena)
{
    static const struct {
        struct solid solids[3];
        uint32_t count;
        bool has_overlap;
        double volume, x;
    } cases[] = {{{{{0, 0, 0}, {1, 1, 1}}, {{0.5, 0, 0}, {1, 1, 1}}}, 2, true, 1.5, 0.75},
                 {{{{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {1, 1, 1}}}, 2, false, 2, 1.5},
                 {{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {1, 1, 1}}}, 2, false, 2, 1},          /* touch */
                 {{{{0, 0, 0}, {1, 1, 1}}, {{3, 0, 0}, {-1, 1, 1}}}, 2, true, 2, 1.5},        /* one inside out */
                 {{{{1, 0, 0}, {-1, 1, 1}}, {{3, 0, 0}, {-1, 1, 1}}}, 2, false, -2, 1.5},     /* all inside out */
                 {{{{1, 0, 0}, {-1, 1, 1}}, {{1.5, 0, 0}, {-1, 1, 1}}}, 2, true, -1.5, 0.75}, /* and overlapping */
                 {{{{0, 0, 0}, {1, 1, 1}}, {{0.75, 0.25, 0.25}, {-0.5, 0.5, 0.5}}}, 2, false, 0.875, 0.5}, /* a void */
                 {{{{0, 0, 0}, {1, 1, 1}}, {{0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}}}, 2, true, 1, 0.5},       /* nested */
                 {{{{0, 0, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}}, 3, true, 1, 0.5},
                 {{{{0, 0, 0}, {9, 1, 0.01}}, {{8.5, 0, 0}, {1, 1, 0.01}}}, 2, true, 0.095, 4.75}}; /* plates */
    enum { CASES = sizeof cases / sizeof *cases };
    for (size_t i = 0; i < CASES; i++)
        for (int far = 0; far < 2; far++) {
            placed_begin(1, 1);
            placed.meshes[0] = boxes(cases[i].solids, cases[i].count);
            placed.instances[0].object_to_world.m[12] = far ? 16384 : 0;
            const struct zr_part_facts *facts = placed_facts(&arena, NULL);
            const double error = fabs(facts->volume - cases[i].volume), size = fabs(cases[i].volume);
            assert_true(facts->is_closed && facts->has_center);
            if (facts->has_overlap != cases[i].has_overlap || error > 1e-4 * size ||
                error > facts->volume_error + 1e-6 * size)
                fail_msg("case %zu: %d, volume %.9g for %g, stated error %g", i, facts->has_overlap, facts->volume,
                         cases[i].volume, facts->volume_error);
            if (fabs(facts->center[0] - (far ? 16384 : 0) - cases[i].x) > 1e-3)
                fail_msg("case %zu: centre %.9g for %g", i, facts->center[0], cases[i].x);
        }
}

/* Random pairs of boxes against the formula: the error is within the stated one. */
TEST_AROUND(volumes_of_random_overlaps_are_within_their_error, open_arena, close_arena)
{
    enum { PAIRS = 48 };
    struct random random = random_seeded(55);
    for (int i = 0; i < PAIRS; i++) {
        struct solid solids[2];
        double volumes[2] = {1, 1}, common = 1;
        for (int k = 0; k < 3; k++) {
            for (int s = 0; s < 2; s++) {
                solids[s].low[k] = random_below(&random, 1000) / 1024.0;
                solids[s].size[k] = (random_below(&random, 1000) + 50) / 1024.0;
                volumes[s] *= solids[s].size[k];
            }
            const double from = fmax(solids[0].low[k], solids[1].low[k]),
                         to = fmin(solids[0].low[k] + solids[0].size[k], solids[1].low[k] + solids[1].size[k]);
            common *= fmax(0, to - from);
        }
        placed_begin(1, 1);
        placed.meshes[0] = boxes(solids, 2);
        const struct zr_part_facts *facts = placed_facts(&arena, NULL);
        const double volume = volumes[0] + volumes[1] - common;
        if (fabs(facts->volume - volume) > facts->volume_error + 1e-5 * volume)
            fail_msg("pair %d: %.9g for %.9g, stated error %g", i, facts->volume, volume, facts->volume_error);
    }
}

RUN_TESTS(NULL, NULL)
