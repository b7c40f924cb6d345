/* Ambient occlusion: dark joints, light planes, and what may happen. */
#include "base/run.h"
#include "effects/occlusion.h"
#include "support/isas.h"
#include "support/test_arena.h"
#include "unit/common/occlusion_scenes.h"

TEST_ARENA(1 << 27)

static struct random numbers = {{RANDOM_STATE_1}};

static const struct zr_occlusion usual = {true, 0.2f, 2.0f};

static struct zr_pixel_scale scale_of(const struct sight *sight)
{
    const float pixels = (float)(1.0 / sight_pixel(sight, 1));
    if (sight->eye > 0.0) return (struct zr_pixel_scale){pixels * (float)sight->eye, {0.0f, 0.0f, -1.0f}, 0.0f};
    return (struct zr_pixel_scale){pixels, {0.0f, 0.0f, 0.0f}, 1.0f};
}

static const float *find_by(struct zr_team *team, const struct buffer *b, const struct sight *sight, float diagonal)
{
    const struct zr_pixel_scale scale = scale_of(sight);
    const float *light =
        zr_occlusion_make(&(struct zr_run){.arena = &arena, .team = team}, &b->g, &usual, &scale, diagonal);
    assert_non_null(light);
    return light;
}

static const float *find_with(enum zr_isa isa, int threads, const struct buffer *b, const struct sight *sight,
                              float diagonal)
{
    struct zr_team *team = zr_team_create_for(threads, isa);
    assert_non_null(team);
    const float *light = find_by(team, b, sight, diagonal);
    zr_team_destroy(team);
    return light;
}

/* A plane that passes by ZR_FAR_POINT itself, and a diagonal so large that a distance to it has a square. */
TEST_EACH_ISA(pixels_of_nobody_weigh_nothing)
{
    const enum zr_isa isa = isa_under_test(state);
    const double point[3] = {0.0, 0.0, 0.0}, normal[3] = {0.5, 0.5, -1.0};
    const struct sight sight = {4, 4, 0.5, 0.0};
    struct buffer b = buffer_make(4, 4), tile = buffer_make(16, 16);
    for (int i = 0; i < 4 * 16; i++)
        buffer_set(&b.g, i, i == 17, point, normal);
    for (int i = 0; i < 16 * 16; i++)
        buffer_set(&tile.g, i, true, point, normal);
    float light[4 * 16], out[16 * 16];
    for (int i = 0; i < 4 * 16; i++)
        light[i] = i == 17 ? 0.25f : 1.0f;
    assert_true(find_with(isa, 1, &b, &sight, 1.0f)[17] == 1.0f);
    for (int scale = 0; scale < 2; scale++) {
        const struct zr_occlusion_map map = {&b.g, light, scale ? 100.0f : 1e-6f};
        zr_occlusion_samples_of(isa)(&map, &tile.g, 4, 0, 0, out);
        assert_true(out[6 * 16 + 6] == 0.25f);
        assert_true(out[2 * 16 + 2] == 0.25f);
        assert_true(out[14 * 16 + 14] == 1.0f);
    }
    buffer_free(&tile);
    buffer_free(&b);
}

/* ---- what it looks like ---- */

TEST(a_corner_is_dark_at_the_joint_and_light_far_from_it)
{
    const struct sight sight = {200, 60, 0.5, 0.0};
    struct buffer b = buffer_make(sight.width, sight.height);
    buffer_draw(&b, &sight, 1, 0, 0, corner);
    const float *row = find_by(NULL, &b, &sight, 1.0f) + 30 * b.g.stride;
    assert_true(row[100] < 0.6f && row[99] < 0.6f);
    for (int x = 101; x < 120; x += 6)
        assert_true(row[x + 6] > row[x]);
    for (int x = 145; x < 200; x++)
        assert_true(row[x] == 1.0f && row[199 - x] == 1.0f);
    buffer_free(&b);
}

TEST(a_lone_plane_is_light_everywhere)
{
    static const double tilts[][2] = {{0, 0}, {0.7, -0.4}, {-3, 2}, {0.1, 20}, {60, -60}, {0, 300}};
    for (size_t i = 0; i < sizeof tilts / sizeof tilts[0]; i++) {
        const struct sight sight = {90, 90, 0.02, i % 2 ? 2.0 : 0.0};
        tilt_x = tilts[i][0];
        tilt_y = tilts[i][1];
        struct buffer b = buffer_make(sight.width, sight.height);
        buffer_draw(&b, &(struct sight){sight.width, sight.height, sight.extent, 0.0}, 1, 0, 0, plane);
        if (sight.eye > 0.0) buffer_see_from(&b, (float)sight.eye);
        const float *light = find_by(NULL, &b, &sight, 1.0f);
        for (int y = 0; y < b.g.height; y++)
            for (int x = 0; x < b.g.width; x++)
                assert_true(light[y * b.g.stride + x] == 1.0f);
        buffer_free(&b);
    }
}

static bool has_plane(const struct zr_gbuffer *g, ptrdiff_t at)
{
    return g->owner[at] != 0 && (g->normal[0][at] != 0.0f || g->normal[1][at] != 0.0f || g->normal[2][at] != 0.0f);
}

TEST_EACH_ISA(lines_and_nobody_are_light)
{
    const enum zr_isa isa = isa_under_test(state);
    const struct sight sight = {70, 50, 0.3, 0.0};
    struct buffer b = buffer_make(sight.width, sight.height);
    buffer_draw(&b, &sight, 1, 0, 0, bumps);
    buffer_spoil(&b, &numbers);
    const float *light = find_with(isa, 1, &b, &sight, 1.0f);
    int dark = 0;
    for (int y = 0; y < b.g.height; y++)
        for (int x = 0; x < b.g.width; x++) {
            const float v = light[y * b.g.stride + x];
            if (!has_plane(&b.g, y * b.g.stride + x)) assert_true(v == 1.0f);
            dark += v < 0.9f;
        }
    assert_true(dark > 100);
    buffer_free(&b);
}

/* ---- what may happen ---- */

TEST_EACH_ISA(nothing_to_see_and_no_size_are_no_failure)
{
    const enum zr_isa isa = isa_under_test(state);
    const struct sight sight = {20, 20, 0.5, 0.0};
    for (int size = 0; size <= 20; size += 20) {
        struct buffer b = buffer_make(size, size);
        for (int i = 0; i < size * (int)b.g.stride; i++)
            buffer_set(&b.g, i, false, NULL, NULL);
        const float *light = find_with(isa, 2, &b, &sight, 0.0f);
        for (int i = 0; i < size * size; i++)
            assert_true(light[i / size * b.g.stride + i % size] == 1.0f);
        buffer_free(&b);
    }
}

TEST(without_memory_there_is_no_map)
{
    const struct sight sight = {20, 20, 0.5, 0.0};
    const struct zr_pixel_scale scale = scale_of(&sight);
    struct buffer b = buffer_make(20, 20);
    buffer_draw(&b, &sight, 1, 0, 0, bumps);
    struct zr_arena small;
    zr_arena_init(&small, 32 * 20 * 6);
    assert_null(zr_occlusion_make(&(struct zr_run){.arena = &small}, &b.g, &usual, &scale, 1.0f));
    zr_arena_free(&small);
    buffer_free(&b);
}

TEST(cancelled_it_returns_early)
{
    const struct sight sight = {20, 20, 0.5, 0.0};
    const struct zr_pixel_scale scale = scale_of(&sight);
    struct buffer b = buffer_make(20, 20);
    struct zr_cancel cancel = {.raised = true};
    struct zr_arena own;
    zr_arena_init(&own, 1 << 24);
    buffer_draw(&b, &sight, 1, 0, 0, bumps);
    float *before = zr_arena_alloc(&own, 32 * 20, sizeof *before);
    for (int i = 0; i < 32 * 20; i++)
        before[i] = -7.0f;
    zr_arena_reset(&own, SIZE_MAX);
    const float *light =
        zr_occlusion_make(&(struct zr_run){.arena = &own, .cancel = &cancel}, &b.g, &usual, &scale, 1.0f);
    assert_ptr_equal(light, before);
    for (int i = 0; i < 32 * 20; i++)
        assert_true(light[i] == -7.0f);
    zr_arena_free(&own);
    buffer_free(&b);
}

RUN_TESTS(open_arena, close_arena)
