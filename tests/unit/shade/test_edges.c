/* Edges of pictures whose edges are known. */
#include <math.h>
#include <string.h>

#include "base/run.h"
#include "effects/edges.h"
#include "raster/tile.h"
#include "support/isas.h"
#include "support/test_arena.h"
#include "unit/common/edges_reference.h"
#include "unit/common/guarded.h"

TEST_ARENA(1 << 28)

/* A tile in pages of its own, with no more room than a G-buffer must have, and full of anything beyond its samples. */
struct guarded_tile {
    struct zr_gbuffer buffer;
    struct guarded arrays[7];
    bool is_empty;
};

static uint32_t word_of_sample(const struct sample *sample, int array)
{
    const float values[6] = {sample->normal.x, sample->normal.y, sample->normal.z,
                             sample->point.x,  sample->point.y,  sample->point.z};
    uint32_t word;
    if (array == 0) return sample->owner;
    memcpy(&word, &values[array - 1], sizeof word);
    return word;
}

static struct guarded_tile make_tile(int number)
{
    static uint32_t words[ZR_TILE_SIZE * ZR_TILE_SIZE];
    const int across = (int)zr_tile_across((uint32_t)picture.columns);
    const int left = number % across * ZR_TILE_SIZE, bottom = number / across * ZR_TILE_SIZE;
    const int width = picture.columns - left < ZR_TILE_SIZE ? picture.columns - left : ZR_TILE_SIZE;
    const int height = picture.rows - bottom < ZR_TILE_SIZE ? picture.rows - bottom : ZR_TILE_SIZE;
    const int stride = (width + 15) / 16 * 16;
    struct guarded_tile tile = {.buffer = {.width = width, .height = height, .stride = stride}, .is_empty = true};
    for (int k = 0; k < 7; k++) {
        for (int i = 0; i < stride * height; i++)
            words[i] = k == 0 ? 99u : 0x7fc00000u; /* not a number */
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                const struct sample *sample = &picture.samples[(bottom + y) * MOST + left + x];
                words[y * stride + x] = word_of_sample(sample, k);
                if (sample->owner) tile.is_empty = false;
            }
        tile.arrays[k] = guarded_copy(words, (size_t)(stride * height) * sizeof *words);
    }
    tile.buffer.owner = (uint32_t *)(uintptr_t)tile.arrays[0].bytes;
    for (int k = 0; k < 3; k++) {
        tile.buffer.normal[k] = (float *)(uintptr_t)tile.arrays[1 + k].bytes;
        tile.buffer.point[k] = (float *)(uintptr_t)tile.arrays[4 + k].bytes;
    }
    return tile;
}

static void mark_tile(struct zr_edge_marks *marks, enum zr_isa isa, int number, bool skips_empty)
{
    struct guarded_tile tile = make_tile(number);
    if (tile.is_empty && skips_empty)
        zr_edges_mark_empty(marks, (uint32_t)number);
    else
        zr_edges_mark_tile(marks, isa, (uint32_t)number, &tile.buffer, NULL);
    for (int k = 0; k < 7; k++)
        guarded_free(&tile.arrays[k]);
}

/* From the first tile to the last, or the other way round. */
static const float *find_edges(enum zr_isa isa, int threads, bool backwards)
{
    struct zr_edge_marks *marks =
        zr_edge_marks_make(&arena, picture.width, picture.height, picture.side, &picture.edges, &picture.scale);
    assert_non_null(marks);
    const int count = (int)zr_tile_count((uint32_t)picture.columns, (uint32_t)picture.rows);
    for (int i = 0; i < count; i++)
        mark_tile(marks, isa, backwards ? count - 1 - i : i, !backwards);
    struct zr_team *team = zr_team_create_for(threads, isa);
    const float *opacity = zr_edges_finish(&(struct zr_run){.arena = &arena, .team = team}, marks);
    zr_team_destroy(team);
    assert_non_null(opacity);
    return opacity;
}

static double mean_of(const float *opacity)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < picture.width * picture.height; i++)
        sum += (double)opacity[i];
    return sum / (picture.width * picture.height);
}

static void fill(int left, int bottom, int right, int top, zr_vec3 normal, float depth)
{
    draw_patch(&(struct patch){PLANE, 1, left, bottom, right, top, normal, depth});
}

static const zr_vec3 front = {0, 0, 1}, bent = {0.6f, 0, 0.8f};

TEST_EACH_ISA(creases_are_dropped_up_to_5_pixels)
{
    const enum zr_isa isa = isa_under_test(state);
    /* Creases are a sample wider at both ends than what is bent, which begins in the second sample of a pixel: 9
     * samples more fill 6 pixels, 8 fill 5. */
    static const struct {
        int width, height;
        bool is_drawn;
    } cases[] = {{8, 8, false}, {9, 3, true}, {3, 9, true}, {8, 2, false}, {1, 1, false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        begin_picture(80, 80, 2, true);
        fill(0, 0, 160, 160, front, 4.0f);
        for (int y = 0; y < 9; y++) /* across the corner of four tiles */
            for (int x = 0; x < 9; x++)
                if (x < cases[i].width && y < cases[i].height) picture.samples[(59 + y) * MOST + 59 + x].normal = bent;
        const float *opacity = find_edges(isa, 2, false);
        assert_true((mean_of(opacity) > 0.0) == cases[i].is_drawn);
    }
}

/* Of two creases, 3 and 4 pixels wide, the corners of one touch the other, or are a pixel away. */
TEST_EACH_ISA(corners_that_touch_connect)
{
    const enum zr_isa isa = isa_under_test(state);
    for (int gap = 0; gap < 2; gap++) {
        begin_picture(70, 70, 1, true);
        fill(0, 0, 70, 70, front, 4.0f);
        picture.samples[61 * MOST + 59].normal = bent;
        for (int i = 0; i < 2; i++)
            picture.samples[63 * MOST + 61 + gap + i].normal = bent;
        const float *opacity = find_edges(isa, 1, false);
        assert_true((mean_of(opacity) > 0.0) == (gap == 0));
    }
}

/* Of each pixel in a row one sample is bent, so that marks of no two pixels touch: 6 pixels, and 5. */
TEST_EACH_ISA(creases_connect_by_pixels)
{
    const enum zr_isa isa = isa_under_test(state);
    for (uint32_t side = 4; side <= 8; side *= 2)
        for (int pixels = 5; pixels <= 6; pixels++) {
            begin_picture(40, 20, side, true);
            fill(0, 0, picture.columns, picture.rows, front, 4.0f);
            for (int i = 0; i < pixels; i++)
                picture.samples[(9 * (int)side + 1) * MOST + (5 + i) * (int)side + 1].normal = bent;
            const float *opacity = find_edges(isa, 2, false);
            assert_true((mean_of(opacity) > 0.0) == (pixels == 6));
        }
}

/* Two creases of 5 pixels, and between them 8 more where what is bent is also nearer: a silhouette alone. */
TEST_EACH_ISA(silhouettes_connect_no_creases)
{
    const enum zr_isa isa = isa_under_test(state);
    for (int step = 0; step < 2; step++) {
        begin_picture(60, 40, 1, true);
        fill(0, 0, 60, 40, front, 4.0f);
        for (int x = 13; x < 31; x++)
            picture.samples[20 * MOST + x] = (struct sample){1, bent, point_on(x, 20, front, 4.0f)};
        for (int x = 17; x < 27; x++)
            if (step) picture.samples[20 * MOST + x].point.z = -3.0f;
        const float *opacity = find_edges(isa, 1, false);
        assert_true(opacity[20 * 60 + 22] == (step ? 1.0f : 0.85f));
        assert_true((opacity[20 * 60 + 12] > 0.0f) == !step);
    }
}

TEST_EACH_ISA(steps_are_silhouettes_and_lines_are_not)
{
    const enum zr_isa isa = isa_under_test(state);
    begin_picture(40, 40, 4, true); /* samples are 1/80 apart: a step of 1/50 is one, of 1/60 is none */
    fill(0, 0, 160, 160, front, 4.0f);
    fill(80, 0, 160, 160, front, 4.0f + 1.0f / 50);
    fill(0, 120, 160, 160, front, 4.0f + 1.0f / 120);
    draw_patch(&(struct patch){LINE, 2, 0, 40, 160, 42, front, 3.0f});
    const float *opacity = find_edges(isa, 1, false);
    for (uint32_t y = 0; y < 40; y++)
        for (uint32_t x = 0; x < 40; x++) {
            const float got = opacity[y * 40 + x];
            if (x < 18 || x > 21) assert_true(got == 0.0f);
            /* marks at 79 and 80, and 2 samples to both sides, except where the line is, and where both are one plane
             */
            if ((x == 19 || x == 20) && ((y < 9) || (y > 11 && y < 28))) assert_true(got == 0.75f);
            if (y > 31) assert_true(got == 0.0f);
        }
}

TEST_EACH_ISA(nothing_has_no_edges)
{
    const enum zr_isa isa = isa_under_test(state);
    begin_picture(50, 33, 4, false);
    const float *opacity = find_edges(isa, 1, false);
    assert_true(mean_of(opacity) == 0.0);
    fill(0, 0, 200, 132, front, 4.0f); /* nor has what fills the window */
    assert_true(mean_of(find_edges(isa, 1, false)) == 0.0);
}

/* ---- failures ---- */

TEST(widths_grow_with_the_window)
{
    const struct zr_edges fixed = {.width = 1.5f, .keeps_width = true}, growing = {.width = 1.5f};
    static const struct {
        uint32_t width, height;
        double pixels;
    } cases[] = {{600, 900, 1.5},         {128, 128, 0.9},   {1, 600, 0.9},
                 {480, 640, 1.341640786}, {2400, 2400, 3.0}, {8192, 8192, 3.75}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_true(zr_edges_width_in(&fixed, cases[i].width, cases[i].height) == 1.5f);
        const float width = zr_edges_width_in(&growing, cases[i].width, cases[i].height);
        assert_true(fabs((double)width - cases[i].pixels) < 1e-6);
    }
}

TEST(specks_grow_with_the_window)
{
    static const struct {
        uint32_t side;
        int pixels;
    } cases[] = {{80, 5}, {400, 8}, {512, 10}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int size = 4; size < 13; size++) {
            begin_picture(cases[i].side, cases[i].side, 1, true);
            fill(0, 0, picture.columns, picture.rows, front, 4.0f);
            for (int y = 0; y < size - 2; y++) /* creases are a sample wider at both ends */
                picture.samples[(30 + y) * MOST + 30].normal = bent;
            assert_true((mean_of(find_edges(ZR_ISA_SCALAR, 1, false)) > 0.0) == (size > cases[i].pixels));
        }
}

TEST(silhouettes_and_creases_have_their_opacities)
{
    begin_picture(60, 60, 1, true);
    picture.edges.silhouette_opacity = 0.25f;
    picture.edges.crease_opacity = 0.5f;
    picture.edges.width = 1.0f;
    fill(10, 0, 30, 60, front, 4.0f);
    fill(30, 0, 50, 60, bent, 4.0f);
    const float *opacity = find_edges(ZR_ISA_SCALAR, 1, false) + 30 * 60;
    assert_true(opacity[10] == 0.25f && opacity[29] == 0.5f && opacity[20] == 0.0f);
}

TEST(a_failed_arena_gives_no_edges)
{
    begin_picture(60, 60, 4, true);
    draw_patches(20);
    bool has_succeeded = false;
    for (size_t ceiling = 1000; !has_succeeded; ceiling += 4000) {
        struct zr_arena small;
        zr_arena_init(&small, ceiling);
        struct zr_edge_marks *marks = zr_edge_marks_make(&small, 60, 60, 4, &picture.edges, &picture.scale);
        assert_true((marks != NULL) == zr_arena_ok(&small));
        if (marks) {
            for (int i = 0; i < 16; i++)
                mark_tile(marks, ZR_ISA_SCALAR, i, true);
            const float *opacity = zr_edges_finish(&(struct zr_run){.arena = &small}, marks);
            assert_true((opacity != NULL) == zr_arena_ok(&small));
            has_succeeded = opacity != NULL;
        }
        zr_arena_free(&small);
    }
}

TEST(cancelled_it_returns)
{
    begin_picture(60, 60, 4, true);
    struct zr_edge_marks *marks = zr_edge_marks_make(&arena, 60, 60, 4, &picture.edges, &picture.scale);
    assert_non_null(marks);
    struct zr_cancel cancel = {.parent = NULL};
    atomic_init(&cancel.raised, true);
    assert_non_null(
        zr_edges_finish(&(struct zr_run){.arena = &arena, .cancel = &cancel}, marks)); /* no tile was marked */
}

RUN_TESTS(open_arena, close_arena)
