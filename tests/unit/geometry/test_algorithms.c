/* The independent algorithms in small cases made by hand. */
#include "raster/textbook/algorithms.h"

#include <string.h>

#include "base/run.h"
#include "raster/textbook/piece.h"
#include "support/geometries.h"
#include "support/tests.h"

static struct zr_arena arena;
static struct test_geometry test;

static int open_arena(void **state)
{
    (void)state;
    zr_arena_init(&arena, 1 << 26);
    geometry_clear(&test);
    return 0;
}

static int close_arena(void **state)
{
    (void)state;
    zr_arena_free(&arena);
    return 0;
}

/* In pixels. */
static struct test_corner at(double x, double y, double z)
{
    return (struct test_corner){(int32_t)(x * 256), (int32_t)(y * 256), (float)z};
}

static void add(struct test_corner a, struct test_corner b, struct test_corner c)
{
    assert_true(geometry_add_triangle(&test, (const struct test_corner[3]){a, b, c}));
}

/* Draws by all five, compares them with production, and returns what they agree on. */
static struct zr_samples draw_by_all(uint32_t width, uint32_t height)
{
    struct zr_samples expected = geometry_draw(&arena, &test, ZR_ALGORITHM_HALFSPACE, width, height);
    for (int a = ZR_ALGORITHM_EDGELIST; a < ZR_ALGORITHM_COUNT; a++) {
        struct zr_samples samples = geometry_draw(&arena, &test, (enum zr_algorithm)a, width, height);
        size_t i = samples_differ_at(&expected, &samples);
        if (i < (size_t)width * height)
            fail_msg("%s at %zu, %zu: owner %u at %a, not %u at %a", algorithm_words[a], i % width, i / width,
                     samples.owner[i], (double)samples.depth[i], expected.owner[i], (double)expected.depth[i]);
    }
    return expected;
}

TEST(every_name_but_production_has_a_way_of_its_own)
{
    assert_null(zr_visibility_of(ZR_ALGORITHM_HALFSPACE));
    for (int a = ZR_ALGORITHM_EDGELIST; a < ZR_ALGORITHM_COUNT; a++) {
        assert_non_null(zr_visibility_of((enum zr_algorithm)a));
        for (int b = a + 1; b < ZR_ALGORITHM_COUNT; b++)
            assert_ptr_not_equal(zr_visibility_of((enum zr_algorithm)a), zr_visibility_of((enum zr_algorithm)b));
    }
}

TEST_AROUND(an_empty_picture_stays_empty, open_arena, close_arena)
{
    struct zr_samples samples = draw_by_all(5, 3);
    for (int i = 0; i < 15; i++)
        assert_int_equal(samples.owner[i], 0);
}

/* Two sheets that cut each other in the middle. */
TEST_AROUND(of_two_that_cut_each_other_each_is_seen_on_its_side, open_arena, close_arena)
{
    add(at(-40, -40, 0.0), at(120, -40, 1.0), at(-40, 120, 0.0));
    add(at(-40, -40, 0.5), at(120, -40, 0.5), at(-40, 120, 0.5));
    struct zr_samples samples = draw_by_all(70, 30);
    assert_int_equal(samples.owner[5 * 70 + 5], 1);
    assert_int_equal(samples.owner[5 * 70 + 65], 2);
}

/* Ten sheets that cut one another. */
TEST_AROUND(the_painter_ends_beyond_its_limit_of_work, open_arena, close_arena)
{
    enum { SIDE = 40, SHEETS = 10, FEW = 2000, PLENTY = 10000000 };
    for (int i = 0; i < SHEETS; i++)
        add(at(-40, -40, 0.05 * i), at(120, -40, 1.0 - 0.09 * i), at(-40, 120, 0.1 + 0.07 * (i * 7 % SHEETS)));
    for (int plenty = 0; plenty < 2; plenty++) {
        struct zr_samples samples = {.width = SIDE,
                                     .height = SIDE,
                                     .depth = zr_arena_alloc(&arena, SIDE * SIDE, sizeof *samples.depth),
                                     .owner = zr_arena_zero(&arena, SIDE * SIDE, sizeof *samples.owner)};
        assert_true(zr_arena_ok(&arena));
        for (int k = 0; k < SIDE * SIDE; k++)
            samples.depth[k] = 1.0f;
        assert_int_equal(zr_painter_within(&arena, &test.geometry, plenty ? PLENTY : FEW, NULL, &samples),
                         plenty ? ZR_OK : ZR_BAD_SCENE);
    }
}

/* Three long triangles around a centre, each over the next. */
static void make_cycle(void)
{
    const double corners[3][6] = {{2, 6, 38, 6, 38, 12}, {36, 2, 12, 38, 18, 38}, {18, 38, 4, 2, 10, 2}};
    for (int t = 0; t < 3; t++)
        add(at(corners[t][0], corners[t][1], 0.2), at(corners[t][2], corners[t][3], 0.8),
            at(corners[t][4], corners[t][5], 0.8));
}

static void paint_whole(const int order[3], uint32_t width, uint32_t height, uint32_t *owners)
{
    memset(owners, 0, (size_t)width * height * sizeof *owners);
    for (int k = 0; k < 3; k++) {
        struct zr_primitive primitive;
        zr_primitive_make(&test.geometry, &test.draws[0], (uint32_t)order[k], width, height, &primitive);
        for (int32_t y = 0; y < (int32_t)height; y++)
            for (int32_t x = 0; x < (int32_t)width; x++)
                if (edges_hold(zr_primitive_edges(&primitive), primitive.edge_count, x, y))
                    owners[(uint32_t)y * width + (uint32_t)x] = (uint32_t)order[k] + 1;
    }
}

TEST_AROUND(three_in_a_cycle_that_no_order_can_paint_are_cut, open_arena, close_arena)
{
    enum { SIZE = 40 };
    static uint32_t whole[SIZE * SIZE];
    const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    make_cycle();
    struct zr_samples samples = draw_by_all(SIZE, SIZE);
    for (int k = 0; k < 6; k++) {
        paint_whole(orders[k], SIZE, SIZE, whole);
        assert_memory_not_equal(whole, samples.owner, sizeof whole);
    }
}

/* Tiles of a roof around a tower: each over the next and the last over the first, all through the
 * same depths; and a chain that does not come round. */
TEST_AROUND(a_long_chain_is_painted_in_its_order, open_arena, close_arena)
{
    enum { TILES = 300, WIDTH = 330, HEIGHT = 20 };
    for (int k = 0; k < TILES; k++)
        add(at(k + 0.5, 1, 0.1), at(k + 12.5, 1, 0.9), at(k + 0.5, 17 + k % 3, 0.1));
    struct zr_samples samples = draw_by_all(WIDTH, HEIGHT);
    assert_int_equal(samples.owner[2 * WIDTH + 250], 250);
    add(at(0, 0, 0.05), at(WIDTH, 0, 0.95), at(0, HEIGHT, 0.5)); /* through all of them */
    draw_by_all(WIDTH, HEIGHT);
}

/* A picture that is there already: depth 0.5 on its left half. */
TEST_AROUND(what_is_not_nearer_than_the_start_is_not_seen, open_arena, close_arena)
{
    add(at(-1, -1, 0.6), at(30, -1, 0.6), at(-1, 30, 0.6));
    add(at(-1, -1, 0.5), at(30, -1, 0.5), at(-1, 30, 0.5));
    for (int a = ZR_ALGORITHM_EDGELIST; a < ZR_ALGORITHM_COUNT; a++) {
        float depth[64];
        uint32_t owner[64] = {0};
        struct zr_samples samples = {.width = 8, .height = 8, .depth = depth, .owner = owner};
        for (int i = 0; i < 64; i++)
            depth[i] = i % 8 < 4 ? 0.5f : 1.0f;
        assert_int_equal(
            zr_visibility_of((enum zr_algorithm)a)(&(struct zr_run){.arena = &arena}, &test.geometry, &samples), ZR_OK);
        for (int i = 0; i < 64; i++) {
            assert_int_equal(owner[i], i % 8 < 4 ? 0 : 2);
            assert_true(depth[i] == 0.5f);
        }
    }
}

TEST_AROUND(a_request_that_is_cancelled_ends, open_arena, close_arena)
{
    struct zr_cancel cancel = {.raised = true};
    make_cycle();
    for (int a = ZR_ALGORITHM_EDGELIST; a < ZR_ALGORITHM_COUNT; a++) {
        struct zr_samples samples;
        assert_int_equal(zr_visibility_window(&(struct zr_run){.arena = &arena, .cancel = &cancel}, &test.geometry,
                                              zr_visibility_of((enum zr_algorithm)a), 40, 40, NULL, &samples),
                         ZR_CANCELLED);
    }
}

/* With every ceiling from nothing up to what is enough: no memory or a whole picture. */
TEST_AROUND(memory_that_ends_anywhere_is_said, open_arena, close_arena)
{
    make_cycle();
    struct zr_samples expected = geometry_draw(&arena, &test, ZR_ALGORITHM_HALFSPACE, 40, 40);
    for (int a = ZR_ALGORITHM_EDGELIST; a < ZR_ALGORITHM_COUNT; a++) {
        enum zr_status status = ZR_NO_MEMORY;
        int refused = 0;
        for (size_t ceiling = 0; status == ZR_NO_MEMORY; ceiling += 64, refused++) {
            struct zr_arena small;
            struct zr_samples samples;
            zr_arena_init(&small, ceiling);
            status = zr_visibility_window(&(struct zr_run){.arena = &small}, &test.geometry,
                                          zr_visibility_of((enum zr_algorithm)a), 40, 40, NULL, &samples);
            if (status == ZR_OK) assert_int_equal(samples_differ_at(&expected, &samples), 40 * 40);
            zr_arena_free(&small);
        }
        assert_int_equal(status, ZR_OK);
        assert_true(refused > 40 * 40 * 8 / 64);
    }
}

/* ---- pieces ---- */

static void make_pieces(struct zr_pieces *pieces, struct zr_samples *samples)
{
    *samples = geometry_draw(&arena, &test, ZR_ALGORITHM_HALFSPACE, 40, 40);
    for (int i = 0; i < 40 * 40; i++) {
        samples->depth[i] = 1.0f;
        samples->owner[i] = 0;
    }
    assert_int_equal(zr_pieces_make(&arena, &test.geometry, NULL, samples, pieces), ZR_OK);
}

TEST_AROUND(a_piece_has_the_samples_of_its_primitive_and_knows_their_depths, open_arena, close_arena)
{
    add(at(2, 2, 0.25), at(6, 2, 0.75), at(2, 6, 0.25));
    add(at(2.1, 2.1, 0.25), at(2.2, 2.1, 0.75), at(2.1, 2.2, 0.25)); /* between the samples */
    struct zr_pieces pieces;
    struct zr_samples samples;
    make_pieces(&pieces, &samples);
    assert_int_equal(pieces.count, 2);
    const struct zr_piece *piece = &pieces.items[1];
    assert_int_equal(piece->size, 4 + 3 + 2 + 1);
    assert_int_equal(piece->min_x, 2);
    assert_int_equal(piece->max_x, 5);
    assert_int_equal(piece->min_y, 2);
    assert_int_equal(piece->max_y, 5);
    assert_true(piece->near == 0.25f && piece->far == 0.625f);
}

TEST_AROUND(a_cut_leaves_every_sample_in_one_part, open_arena, close_arena)
{
    add(at(-40, -40, 0.0), at(120, -40, 1.0), at(-40, 120, 0.0));
    add(at(-40, -40, 0.3), at(120, -40, 0.3), at(-40, 120, 0.3));
    struct zr_pieces pieces;
    struct zr_samples samples;
    make_pieces(&pieces, &samples);
    struct zr_overlap overlap = zr_pieces_compare(&pieces, &pieces.items[1], &pieces.items[2]);
    assert_true(overlap.nearer > 0 && overlap.farther > 0);
    uint32_t near, rest, spans = pieces.span_count;
    assert_true(zr_pieces_split(&pieces, 1, 2, true, &near, &rest));
    assert_int_equal(pieces.items[near].size + pieces.items[rest].size, 40 * 40);
    overlap = zr_pieces_compare(&pieces, &pieces.items[near], &pieces.items[2]);
    assert_int_equal(overlap.nearer, pieces.items[near].size);
    assert_int_equal(overlap.farther, 0);
    overlap = zr_pieces_compare(&pieces, &pieces.items[rest], &pieces.items[2]);
    assert_int_equal(overlap.farther, pieces.items[rest].size);
    assert_int_equal(overlap.nearer, 0);
    zr_pieces_free(&pieces, near);
    assert_int_not_equal(pieces.free_span, 0);
    assert_true(pieces.span_count > spans);
}

RUN_TESTS(NULL, NULL)
