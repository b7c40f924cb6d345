#include <math.h>
#include <string.h>

#include "raster/binned_scene.h"
#include "raster/halfspace.h"
#include "raster/oddeven.h"
#include "raster/whole_window.h"
#include "support/cmocka_all.h"
#include "support/geometries.h"
#include "support/random.h"
#include "support/scenes.h"

/* A vertex at window position x, y (pixels) and depth z. */
static struct zr_window_vertex at(float x, float y, float z)
{
    return (struct zr_window_vertex){.x = x, .y = y, .z = z, .oow = 1};
}

/* Draws clockwise (y up) vertices into a tile; owner 1. */
static void draw_with(const struct zr_halfspace *halfspace, struct zr_tile *tile, const struct zr_window_vertex v[3])
{
    struct zr_triangle triangle = {.v = {0, 1, 2}};
    struct zr_setup setup = zr_setup_make(v, &triangle);
    halfspace->draw(tile, &setup, 1);
}

static void draw(struct zr_tile *tile, const struct zr_window_vertex v[3])
{
    draw_with(zr_halfspace_of(zr_isa_best()), tile, v);
}

/* With all samples written. */
static void draw_tile(const struct zr_binned_scene *visible, uint32_t number, struct zr_tile *tile)
{
    assert_true(zr_visibility_tile(&visible->visibility, number, NULL, tile));
    if (!tile->is_empty) visible->halfspace->flush(tile);
}

/* At the origin. */
static struct zr_tile *cleared_tile(void)
{
    static struct zr_tile tile;
    tile = (struct zr_tile){.width = ZR_TILE_SIZE, .height = ZR_TILE_SIZE};
    zr_tile_begin(&tile, NULL, ZR_TILE_SIZE, ZR_TILE_SIZE);
    return &tile;
}

static uint32_t owner_at(const struct zr_tile *tile, int x, int y)
{
    return tile->is_empty ? 0 : tile->owner[y * ZR_TILE_STRIDE + x];
}

static float depth_at(const struct zr_tile *tile, int x, int y)
{
    return tile->is_empty ? 1.0f : tile->depth[y * ZR_TILE_STRIDE + x];
}

static int owned(const struct zr_tile *tile)
{
    int count = 0;
    for (int y = 0; y < tile->height; y++)
        for (int x = 0; x < tile->width; x++)
            count += owner_at(tile, x, y) != 0;
    return count;
}

/* What lies behind the ends of rows is anything. */
static void assert_tiles_equal(const struct zr_tile *a, const struct zr_tile *b)
{
    for (int y = 0; y < a->height; y++)
        for (int x = 0; x < a->width; x++) {
            assert_int_equal(owner_at(a, x, y), owner_at(b, x, y));
            assert_true(depth_at(a, x, y) == depth_at(b, x, y));
        }
}

/* Corners on a coarse grid, so that many samples lie exactly on edges and corners. */
static void odd_even_rule_covers_the_triangle_that_the_kernel_covers(void **state)
{
    (void)state;
    struct random random = random_seeded(21);
    static struct zr_tile by_edges;
    for (int round = 0; round < 3000; round++) {
        struct zr_window_vertex v[3];
        double step = round % 3 ? 0.5 : 1.0 / 256, reach = round % 2 ? 64.0 : 12.0;
        for (int k = 0; k < 3; k++) {
            double x = floor(random_range(&random, -2, reach) / step) * step;
            double y = floor(random_range(&random, -2, reach) / step) * step;
            v[k] = at((float)x, (float)y, (float)random_range(&random, 0, 1));
        }
        int64_t area = zr_window_area(&v[0], &v[1], &v[2]);
        if (area == 0) continue;
        struct zr_triangle triangle = {.v = {area < 0 ? 1 : 0, area < 0 ? 0 : 1, 2}};
        const struct zr_draw drawn = draw_of(ZR_DRAW_TRIANGLES, (const uint32_t[3]){0, 1, 2}, 1);
        const struct zr_geometry geometry = {
            .window.line_width = 1, .vertices = v, .vertex_count = 3, .primitive_count = 1};
        struct zr_tile *tile = cleared_tile();
        by_edges = *tile;
        struct zr_setup setup = zr_setup_make(v, &triangle);
        zr_halfspace_of(zr_isa_best())->draw(tile, &setup, 1);
        struct zr_primitive primitive;
        zr_primitive_make(&geometry, &drawn, 0, ZR_TILE_SIZE, ZR_TILE_SIZE, &primitive);
        zr_oddeven_draw(&geometry, &primitive, &by_edges);
        assert_tiles_equal(tile, &by_edges);
    }
}

/* Lines in all directions, on centres and corners too, in a window of three by two tiles. */
static void lines_have_the_pixels_of_their_parallelogram_in_the_tiles_that_list_them(void **state)
{
    (void)state;
    enum { WIDTH = 150, HEIGHT = 100, TILES = 6 };
    struct random random = random_seeded(23);
    static struct zr_tile by_edges, by_pixels;
    struct zr_arena arena;
    zr_arena_init(&arena, 1 << 20);
    int drawn = 0;
    for (int round = 0; round < 4000; round++) {
        struct zr_window_vertex v[2];
        double step = round % 3 == 0 ? 0.5 : 1.0 / 512;
        for (int k = 0; k < 2; k++) {
            double x = floor(random_range(&random, 0, WIDTH) / step) * step;
            double y = floor(random_range(&random, 0, HEIGHT) / step) * step;
            if (k == 1 && round % 5 == 0) x = (double)v[0].x;
            if (k == 1 && round % 7 == 0) y = (double)v[0].y;
            v[k] = at((float)x, (float)y, (float)random_range(&random, 0, 1));
        }
        static const uint32_t corners[3] = {0, 1, 1};
        struct zr_draw draw = draw_of(ZR_DRAW_LINES, corners, 1);
        const struct zr_geometry geometry = {.window.line_width = 1,
                                             .vertices = v,
                                             .vertex_count = 2,
                                             .primitive_count = 1,
                                             .draw_count = 1,
                                             .draws = &draw};
        struct zr_binned_scene visible;
        struct zr_primitive primitive;
        zr_arena_reset(&arena, 1 << 20);
        assert_int_equal(zr_binned_scene_make(&arena, NULL, &geometry, NULL, WIDTH, HEIGHT, NULL, NULL, &visible),
                         ZR_OK);
        zr_primitive_make(&geometry, &draw, 0, WIDTH, HEIGHT, &primitive);
        for (uint32_t number = 0; number < TILES; number++) {
            zr_tile_place(&by_edges, number, WIDTH, HEIGHT);
            zr_tile_begin(&by_edges, NULL, WIDTH, HEIGHT);
            zr_oddeven_draw(&geometry, &primitive, &by_edges);
            draw_tile(&visible, number, &by_pixels);
            assert_tiles_equal(&by_pixels, &by_edges);
            drawn += owned(&by_edges);
        }
    }
    assert_true(drawn > 100000);
    zr_arena_free(&arena);
}

/* Kernels look at whole blocks: a block that the window ends in must not be bounded by what memory held. */
static void tile_begins_with_its_base_and_nothing_else(void **state)
{
    (void)state;
    enum { WIDTH = 61, HEIGHT = 70 };
    static float near[WIDTH * HEIGHT];
    static struct zr_tile tile;
    const struct zr_base base = {.window_depth = near};
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        near[i] = 0.25f;
    for (uint32_t number = 0; number < 2; number++) {
        memset(&tile, 0xff, sizeof tile);
        zr_tile_place(&tile, number, WIDTH, HEIGHT);
        zr_tile_begin(&tile, &base, WIDTH, HEIGHT);
        for (int y = 0; y < ZR_TILE_SIZE; y++)
            for (int x = 0; x < ZR_TILE_STRIDE; x++) {
                assert_true(tile.depth[y * ZR_TILE_STRIDE + x] == (x < WIDTH && y < tile.height ? 0.25f : 1.0f));
                assert_int_equal(tile.owner[y * ZR_TILE_STRIDE + x], 0);
            }
    }
}

/* The tile is a thread's, and another's picture was in it before. */
static void tile_of_decided_samples_is_all_of_them(void **state)
{
    (void)state;
    enum { WIDTH = 70, HEIGHT = 66 };
    static float depth[WIDTH * HEIGHT];
    static uint32_t owner[WIDTH * HEIGHT];
    static struct zr_tile tile;
    const struct zr_samples samples = {.width = WIDTH, .height = HEIGHT, .depth = depth, .owner = owner};
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        depth[i] = (float)i / (WIDTH * HEIGHT);
        owner[i] = i + 1;
    }
    for (uint32_t number = 0; number < 4; number++) {
        memset(&tile, 0xff, sizeof tile);
        zr_visibility_load(&samples, number, &tile);
        assert_int_equal(tile.unwritten, 0);
        assert_false(tile.knows_owners);
        for (int y = 0; y < tile.height; y++)
            for (int x = 0; x < tile.width; x++) {
                const int i = (tile.y + y) * WIDTH + tile.x + x;
                assert_true(depth_at(&tile, x, y) == depth[i]);
                assert_int_equal(owner_at(&tile, x, y), owner[i]);
            }
    }
}

static void depth_beyond_the_range_is_clamped_and_nan_is_the_far_plane(void **state)
{
    (void)state;
    struct zr_tile *tile = cleared_tile();
    const struct zr_window_vertex v[3] = {at(0, 0, -1), at(0, 60, -1), at(60, 0, -1)};
    draw(tile, v);
    assert_true(owned(tile) > 0 && tile->depth[0] == 0.0f);
    tile = cleared_tile();
    const struct zr_window_vertex n[3] = {at(0, 0, NAN), at(0, 60, 0), at(60, 0, 0)};
    draw(tile, n);
    assert_int_equal(owned(tile), 0);
}

/* Each triangle that has pixels in a tile, and no other, leaves them there: the bins' four ways (fragments, small,
 * wide, large) against the edge functions of each triangle, for every instruction set, with one thread and with three.
 */
static void bins_lose_no_triangle_and_invent_none(enum zr_isa isa, int threads)
{
    struct random random = random_seeded(9);
    enum { ALL_SIZES = 500, COUNT = 5000, WIDTH = 700, HEIGHT = 400 }; /* enough for several threads */
    static const double reach[] = {1, 2, 5, 20, 60, 150, 700};
    static struct zr_window_vertex vertices[COUNT * 3];
    static uint32_t corners[3 * COUNT];
    static struct zr_tile tile;
    static uint32_t want[HEIGHT][WIDTH];
    static float depth[HEIGHT][WIDTH];
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            want[y][x] = 0;
            depth[y][x] = 1.0f;
        }
    for (uint32_t i = 0; i < COUNT; i++) {
        double x = random_range(&random, 0, WIDTH), y = random_range(&random, 0, HEIGHT),
               r = reach[i % (i < ALL_SIZES ? 7 : 3)];
        for (uint32_t k = 0; k < 3; k++) {
            float vx = (float)fmin(fmax(x + random_range(&random, -r, r), 0), WIDTH);
            float vy = (float)fmin(fmax(y + random_range(&random, -r, r), 0), HEIGHT);
            vertices[3 * i + k] = at(vx, vy, (float)random_range(&random, 0, 1));
            corners[3 * i + k] = 3 * i + k;
        }
        struct zr_triangle triangle = {.v = {3 * i, 3 * i + 1, 3 * i + 2}};
        if (zr_window_area(&vertices[3 * i], &vertices[3 * i + 1], &vertices[3 * i + 2]) < 0) {
            triangle.v[0] = 3 * i + 1;
            triangle.v[1] = 3 * i;
        }
        struct zr_setup setup = zr_setup_make(vertices, &triangle);
        for (int32_t py = setup.min_y > 0 ? setup.min_y : 0; py <= setup.max_y && py < HEIGHT; py++)
            for (int32_t px = setup.min_x > 0 ? setup.min_x : 0; px <= setup.max_x && px < WIDTH; px++) {
                float z = zr_depth_at(&setup.depth, px, py);
                if (!zr_setup_covers(&setup, px, py) || !(z < depth[py][px])) continue;
                depth[py][px] = z;
                want[py][px] = i + 1;
            }
    }
    struct zr_draw draw = draw_of(ZR_DRAW_TRIANGLES, corners, COUNT);
    const struct zr_geometry geometry = {.window.line_width = 1,
                                         .vertices = vertices,
                                         .vertex_count = 3 * COUNT,
                                         .primitive_count = COUNT,
                                         .draw_count = 1,
                                         .draws = &draw};
    struct zr_arena arena;
    struct zr_binned_scene visible;
    struct zr_team *team = zr_team_create_for(threads, isa);
    zr_arena_init(&arena, 1 << 24);
    assert_int_equal(zr_binned_scene_make(&arena, team, &geometry, NULL, WIDTH, HEIGHT, NULL, NULL, &visible), ZR_OK);
    assert_in_range(visible.sorted[ZR_ALPHA_OPAQUE].bins.large_count, 1, COUNT - 1);
    assert_int_equal(visible.sorted[ZR_ALPHA_OPAQUE].bins.worker_count, threads > 1 ? 2 : 1);
    for (uint32_t number = 0; number < zr_tile_count(WIDTH, HEIGHT); number++) {
        draw_tile(&visible, number, &tile);
        for (int y = 0; y < tile.height; y++)
            for (int x = 0; x < tile.width; x++) {
                assert_int_equal(owner_at(&tile, x, y), want[tile.y + y][tile.x + x]);
                assert_true(depth_at(&tile, x, y) == depth[tile.y + y][tile.x + x]);
            }
    }
    zr_arena_free(&arena);
    zr_team_destroy(team);
}

static void bins_lose_nothing_with_any_instruction_set(void **state)
{
    (void)state;
    for (int isa = 0; isa < ZR_ISA_COUNT; isa++)
        for (int threads = 1; threads <= 3 && zr_isa_is_available((enum zr_isa)isa); threads += 2)
            bins_lose_no_triangle_and_invent_none((enum zr_isa)isa, threads);
}

/* Fragments tell their owners from the first of their block, in fewer bits than an owner has: here a tile has a few of
 * the first triangles and a few of the last, and the other tile has more between them than these bits count. */
static void fragments_of_far_apart_owners_keep_them(void **state)
{
    (void)state;
    enum { PIXELS = ZR_TILE_SIZE * ZR_TILE_SIZE, FEW = 20, COUNT = (1 << ZR_BIN_OWNER_BITS) + 2 * FEW + 100 };
    static struct zr_window_vertex
        vertices[2 * 3 * PIXELS]; /* a triangle a pixel, of the one tile, then of the other */
    static uint32_t corners[3 * COUNT];
    static struct zr_tile tile;
    for (uint32_t i = 0; i < 2 * PIXELS; i++) {
        const float x = (float)(i % ZR_TILE_SIZE + i / PIXELS * ZR_TILE_SIZE), y = (float)(i % PIXELS / ZR_TILE_SIZE);
        vertices[3 * i] = at(x + 0.125f, y + 0.125f, 0.5f);
        vertices[3 * i + 1] = at(x + 0.875f, y + 0.125f, 0.5f);
        vertices[3 * i + 2] = at(x + 0.5f, y + 0.875f, 0.5f);
    }
    for (uint32_t i = 0; i < COUNT; i++)
        for (uint32_t k = 0; k < 3; k++)
            corners[3 * i + k] = 3 * (i < FEW || i >= COUNT - FEW ? i % PIXELS : PIXELS + i % PIXELS) + k;
    struct zr_draw draw = draw_of(ZR_DRAW_TRIANGLES, corners, COUNT);
    const struct zr_geometry geometry = {.window.line_width = 1,
                                         .vertices = vertices,
                                         .vertex_count = 2 * 3 * PIXELS,
                                         .primitive_count = COUNT,
                                         .draw_count = 1,
                                         .draws = &draw};
    for (int threads = 1; threads <= 3; threads += 2) {
        struct zr_arena arena;
        struct zr_binned_scene visible;
        struct zr_team *team = zr_team_create(threads);
        zr_arena_init(&arena, 1 << 27);
        assert_int_equal(
            zr_binned_scene_make(&arena, team, &geometry, NULL, 2 * ZR_TILE_SIZE, ZR_TILE_SIZE, NULL, NULL, &visible),
            ZR_OK);
        draw_tile(&visible, 0, &tile);
        for (uint32_t p = 0; p < PIXELS; p++) {
            const uint32_t last = p - (COUNT - FEW) % PIXELS;
            const uint32_t want = p < FEW ? p + 1 : last < FEW ? COUNT - FEW + last + 1 : 0;
            assert_int_equal(owner_at(&tile, (int32_t)(p % ZR_TILE_SIZE), (int32_t)(p / ZR_TILE_SIZE)), want);
        }
        zr_arena_free(&arena);
        zr_team_destroy(team);
    }
}

/* As many samples as tiny triangles can have, in as many of these as are queued at once, and more. */
static void tiny_triangles_of_four_samples_are_all_drawn(void **state)
{
    (void)state;
    enum { COUNT = TEST_TRIANGLES_MAX, SIDE = 256, APART = 4, ROW = SIDE / APART };
    static const float corners[3][2] = {{0.6f, 1.4f}, {3.4f, 1.4f}, {2.0f, 3.4f}}; /* around four pixel centres */
    static zr_vec4 positions[3 * COUNT];
    static struct test_scene test;
    struct zr_arena arena;
    zr_arena_init(&arena, (size_t)1 << 26);
    for (size_t i = 0; i < 3 * (size_t)COUNT; i++) {
        const float x = (float)(i / 3 % ROW * APART) + corners[i % 3][0];
        const float y = (float)(i / 3 / ROW * APART) + corners[i % 3][1];
        positions[i] = (zr_vec4){x / (SIDE / 2) - 1.0f, y / (SIDE / 2) - 1.0f, 0, 1};
    }
    scene_of_triangles(&test, SIDE, SIDE, positions, COUNT);
    for (int isa = 0; isa < ZR_ISA_COUNT; isa++) {
        if (!zr_isa_is_available((enum zr_isa)isa)) continue;
        struct zr_team *team = zr_team_create_for(1, (enum zr_isa)isa);
        const struct zr_frame *frame = scene_render(&arena, team, &test.scene);
        assert_int_equal(frame->covered_pixels, 4 * COUNT);
        for (uint32_t y = 0; y < SIDE; y++)
            for (uint32_t x = 0; x < SIDE; x++) {
                const uint32_t id = frame->face_id[(SIDE - 1 - y) * SIDE + x];
                const bool inside = (x % APART == 1 || x % APART == 2) && (y % APART == 1 || y % APART == 2);
                assert_int_equal(id, inside ? y / APART * ROW + x / APART + 1 : 0);
            }
        zr_team_destroy(team);
        zr_arena_reset(&arena, 0);
    }
    zr_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(odd_even_rule_covers_the_triangle_that_the_kernel_covers),
        cmocka_unit_test(lines_have_the_pixels_of_their_parallelogram_in_the_tiles_that_list_them),
        cmocka_unit_test(tile_begins_with_its_base_and_nothing_else),
        cmocka_unit_test(tile_of_decided_samples_is_all_of_them),
        cmocka_unit_test(depth_beyond_the_range_is_clamped_and_nan_is_the_far_plane),
        cmocka_unit_test(bins_lose_nothing_with_any_instruction_set),
        cmocka_unit_test(fragments_of_far_apart_owners_keep_them),
        cmocka_unit_test(tiny_triangles_of_four_samples_are_all_drawn),
    };
    return cmocka_run_group_tests_name("raster", tests, NULL, NULL);
}
