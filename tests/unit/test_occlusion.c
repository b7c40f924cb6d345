/* Ambient occlusion is that of a plain reference, the same by every instruction set and any number of threads, and
 * looks as it should. OCCLUSION_SPEED=1 prints times. */
#include <time.h>

#include "effects/occlusion.h"
#include "occlusion_reference.h"
#include "occlusion_scenes.h"
#include "support/isas.h"
#include "support/test_arena.h"

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
    const float *light = zr_occlusion_make(&arena, team, NULL, &b->g, &usual, &scale, diagonal);
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

static void assert_same_rows(const float *got, const float *want, const struct zr_gbuffer *g)
{
    for (int y = 0; y < g->height; y++)
        assert_memory_equal(got + y * g->stride, want + y * g->stride, (size_t)g->width * sizeof *got);
}

/* Planes that blur and rounded distances decide upon may, rarely, be decided otherwise in double. */
static void assert_near(const float *got, const double *want, const struct zr_gbuffer *g)
{
    int far_off = 0;
    for (int y = 0; y < g->height; y++)
        for (int x = 0; x < g->width; x++) {
            const double off = fabs((double)got[y * g->stride + x] - want[y * g->stride + x]);
            if (!(off <= 0.2)) fail_msg("pixel %d, %d: off by %g", x, y, off);
            far_off += off > 2e-5;
        }
    assert_in_range(far_off, 0, g->width * g->height / 1000);
}

static void light_is_that_of_the_reference(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    double darkest = 1.0;
    for (int i = 0; i < SIGHTS * SURFACES; i++) {
        const struct sight *sight = &sights[i % SIGHTS];
        struct buffer b = buffer_make(sight->width, sight->height);
        buffer_draw(&b, sight, 1, 0, 0, surfaces[i / SIGHTS]);
        if (i % 3) buffer_spoil(&b, &numbers);
        const float diagonal = i % 2 ? 1.0f : 0.6f, *got = find_with(isa, 1, &b, sight, diagonal);
        const struct reference reference = {&b.g, usual, scale_of(sight), (double)diagonal};
        double *want = reference_light(&reference);
        assert_near(got, want, &b.g);
        for (int x = 0; x < b.g.width; x++)
            if (want[x] < darkest) darkest = want[x];
        free(want);
        buffer_free(&b);
    }
    assert_true(darkest < 0.7); /* else all of this compared is ones */
}

static void every_instruction_set_and_team_gives_the_same_bytes(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    for (int i = 0; i < SIGHTS * SURFACES; i++) {
        const struct sight *sight = &sights[i % SIGHTS];
        struct buffer b = buffer_make(sight->width, sight->height);
        buffer_draw(&b, sight, 1, 0, 0, surfaces[i / SIGHTS]);
        buffer_spoil(&b, &numbers);
        const float *want = find_with(ZR_ISA_SCALAR, 1, &b, sight, 1.0f);
        for (int threads = 1; threads <= 4; threads++)
            assert_same_rows(find_with(isa, threads, &b, sight, 1.0f), want, &b.g);
        buffer_free(&b);
    }
}

/* ---- samples ---- */

enum { TILE = 64 };

/* Tiles of odd sizes and the last ones of a window, too. */
static void check_samples(enum zr_isa isa, const struct sight *sight, surface_fn *surface, int side)
{
    struct buffer pixels = buffer_make(sight->width, sight->height);
    buffer_draw(&pixels, sight, 1, 0, 0, surface);
    buffer_spoil(&pixels, &numbers);
    const struct zr_occlusion_map map = {&pixels.g, find_by(NULL, &pixels, sight, 1.0f), 100.0f};
    for (int y0 = 0; y0 < sight->height * side; y0 += TILE)
        for (int x0 = 0; x0 < sight->width * side; x0 += TILE) {
            const int width = sight->width * side - x0, height = sight->height * side - y0;
            struct buffer b = buffer_make(width < TILE ? width : TILE, height < TILE ? height : TILE);
            buffer_draw(&b, sight, side, x0, y0, surface);
            buffer_spoil(&b, &numbers);
            struct guarded out = guarded_copy(b.planes[1].bytes, b.planes[1].size),
                           plain = guarded_copy(b.planes[1].bytes, b.planes[1].size);
            float *got = (float *)(void *)out.bytes, *want = (float *)(void *)plain.bytes;
            zr_occlusion_samples_of(isa)(&map, &b.g, (uint32_t)side, x0, y0, got);
            zr_occlusion_samples_of(ZR_ISA_SCALAR)(&map, &b.g, (uint32_t)side, x0, y0, want);
            assert_same_rows(got, want, &b.g);
            for (int y = 0; y < b.g.height; y++)
                for (int x = 0; x < b.g.width; x++) {
                    const ptrdiff_t at = y * b.g.stride + x;
                    double light = 1.0;
                    if (reference_has_plane(&b.g, x, y))
                        light = reference_sample(&map, 1.0, &b.g, at, side, x0 + x, y0 + y);
                    if (!(fabs((double)got[at] - light) <= 2e-4))
                        fail_msg("sample %d, %d: %g, not %g", x0 + x, y0 + y, (double)got[at], light);
                }
            guarded_free(&out);
            guarded_free(&plain);
            buffer_free(&b);
        }
    buffer_free(&pixels);
}

static void samples_are_those_of_the_reference(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    /* Each instruction set has a quarter of them, since the reference takes long. */
    for (int i = (int)isa % 4; i < SIGHTS * SURFACES; i += 4)
        check_samples(isa, &sights[i % SIGHTS], surfaces[i / SIGHTS], 2 << (i + i / SIGHTS) % 3);
}

static void one_sample_a_pixel_has_the_pixels_own_light(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    const struct sight sight = {100, 70, 0.3, 0.0};
    struct buffer b = buffer_make(sight.width, sight.height), tile = buffer_make(36, 6);
    buffer_draw(&b, &sight, 1, 0, 0, bumps);
    buffer_draw(&tile, &sight, 1, 64, 64, bumps);
    const struct zr_occlusion_map map = {&b.g, find_by(NULL, &b, &sight, 1.0f), 100.0f};
    struct guarded out = guarded_copy(tile.planes[1].bytes, tile.planes[1].size);
    const float *got = (const float *)(const void *)out.bytes;
    zr_occlusion_samples_of(isa)(&map, &tile.g, 1, 64, 64, (float *)(void *)out.bytes);
    for (int y = 0; y < 6; y++)
        assert_memory_equal(got + y * tile.g.stride, map.light + (64 + y) * b.g.stride + 64, 36 * sizeof *got);
    guarded_free(&out);
    buffer_free(&tile);
    buffer_free(&b);
}

/* A plane that passes by ZR_FAR_POINT itself, and a diagonal so large that a distance to it has a square. */
static void pixels_of_nobody_weigh_nothing(void **state)
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

static void a_corner_is_dark_at_the_joint_and_light_far_from_it(void **state)
{
    (void)state;
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

static void a_lone_plane_is_light_everywhere(void **state)
{
    (void)state;
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

/* Neither the 4 x 4 pattern nor vectors nor rows of threads are seen. */
static void a_bowl_is_smooth(void **state)
{
    (void)state;
    const struct sight sight = {200, 200, 0.3, 0.0};
    struct buffer b = buffer_make(sight.width, sight.height);
    buffer_draw(&b, &sight, 1, 0, 0, bowl);
    const float *light = find_by(NULL, &b, &sight, 1.0f);
    const struct reference reference = {&b.g, usual, scale_of(&sight), 1.0};
    double most = 0.0, unblurred = 0.0;
    for (int y = 50; y < 150; y++)
        for (int x = 50; x < 150; x++) {
            const float *at = light + y * b.g.stride + x;
            most = fmax(most, fmax(fabs((double)(at[1] - at[0])), fabs((double)(at[b.g.stride] - at[0]))));
            unblurred =
                fmax(unblurred, fabs(reference_found(&reference, x + 1, y) - reference_found(&reference, x, y)));
            assert_true(*at < 0.95f && *at > 0.3f);
        }
    assert_true(unblurred > 0.05); /* there is a pattern to be removed */
    if (!(most < 0.01)) fail_msg("neighbours differ by %g", most);
    buffer_free(&b);
}

static void lines_and_nobody_are_light(void **state)
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
            if (!reference_has_plane(&b.g, x, y)) assert_true(v == 1.0f);
            dark += v < 0.9f;
        }
    assert_true(dark > 100);
    buffer_free(&b);
}

/* ---- what may happen ---- */

static void nothing_to_see_and_no_size_are_no_failure(void **state)
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

static void without_memory_there_is_no_map(void **state)
{
    (void)state;
    const struct sight sight = {20, 20, 0.5, 0.0};
    const struct zr_pixel_scale scale = scale_of(&sight);
    struct buffer b = buffer_make(20, 20);
    buffer_draw(&b, &sight, 1, 0, 0, bumps);
    struct zr_arena small;
    zr_arena_init(&small, 32 * 20 * 6);
    assert_null(zr_occlusion_make(&small, NULL, NULL, &b.g, &usual, &scale, 1.0f));
    zr_arena_free(&small);
    buffer_free(&b);
}

static void cancelled_it_returns_early(void **state)
{
    (void)state;
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
    const float *light = zr_occlusion_make(&own, NULL, &cancel, &b.g, &usual, &scale, 1.0f);
    assert_ptr_equal(light, before);
    for (int i = 0; i < 32 * 20; i++)
        assert_true(light[i] == -7.0f);
    zr_arena_free(&own);
    buffer_free(&b);
}

/* ---- speed ---- */

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void time_samples(enum zr_isa isa, const struct buffer *pixels, const struct sight *sight, const float *light)
{
    const struct zr_occlusion_map map = {&pixels->g, light, 100.0f};
    struct buffer b = buffer_make(TILE, TILE);
    buffer_draw(&b, sight, 4, 1024, 1024, bumps);
    float *out = zr_arena_alloc(&arena, TILE * TILE, sizeof *out);
    double best = 1.0;
    for (int round = 0; round < 200; round++) {
        const double begin = seconds();
        zr_occlusion_samples_of(isa)(&map, &b.g, 4, 1024, 1024, out);
        best = fmin(best, seconds() - begin);
    }
    print_message("%s: %.2f ns a sample, %g\n", zr_isa_name(isa), 1e9 * best / (TILE * TILE), (double)out[5]);
    buffer_free(&b);
}

static void speed(void **state)
{
    const enum zr_isa isa = isa_under_test(state);
    for (int eye = 0; eye <= 2; eye += 2) {
        const struct sight sight = {512, 512, 0.48, eye};
        struct buffer b = buffer_make(512, 512);
        buffer_draw(&b, &sight, 1, 0, 0, bumps);
        int seen = 0;
        for (int i = 0; i < 512 * 512; i++)
            seen += b.g.owner[i] != 0;
        struct zr_team *team = zr_team_create_for(1, isa);
        double best = 1.0;
        const float *light = NULL;
        for (int round = 0; round < 30; round++) {
            zr_arena_reset(&arena, SIZE_MAX);
            const double begin = seconds();
            light = find_by(team, &b, &sight, 1.0f);
            best = fmin(best, seconds() - begin);
        }
        print_message("%s: %d pixels, eye %d: %.2f ms\n", zr_isa_name(isa), seen, eye, 1e3 * best);
        time_samples(isa, &b, &sight, light);
        zr_team_destroy(team);
        buffer_free(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST_EACH_ISA(light_is_that_of_the_reference),
        TEST_EACH_ISA(every_instruction_set_and_team_gives_the_same_bytes),
        TEST_EACH_ISA(samples_are_those_of_the_reference),
        TEST_EACH_ISA(one_sample_a_pixel_has_the_pixels_own_light),
        TEST_EACH_ISA(pixels_of_nobody_weigh_nothing),
        TEST_EACH_ISA(lines_and_nobody_are_light),
        TEST_EACH_ISA(nothing_to_see_and_no_size_are_no_failure),
        cmocka_unit_test(a_corner_is_dark_at_the_joint_and_light_far_from_it),
        cmocka_unit_test(a_lone_plane_is_light_everywhere),
        cmocka_unit_test(a_bowl_is_smooth),
        cmocka_unit_test(without_memory_there_is_no_map),
        cmocka_unit_test(cancelled_it_returns_early),
    };
    const struct CMUnitTest timed[] = {TEST_EACH_ISA(speed)};
    if (getenv("OCCLUSION_SPEED"))
        return cmocka_run_group_tests_name("occlusion, times", timed, open_arena, close_arena);
    return cmocka_run_group_tests_name("occlusion", tests, open_arena, close_arena);
}
