#include <math.h>
#include <string.h>

#include "base/run.h"
#include "raster/binned_scene.h"
#include "raster/halfspace.h"
#include "raster/oddeven.h"
#include "raster/textbook/whole_window.h"
#include "support/geometries.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/tests.h"

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

/* Kernels look at whole blocks: a block that the window ends in must not be bounded by what memory held. */
TEST(tile_begins_with_its_base_and_nothing_else)
{
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
TEST(tile_of_decided_samples_is_all_of_them)
{
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
        assert_false(tile.has_block_owners);
        for (int y = 0; y < tile.height; y++)
            for (int x = 0; x < tile.width; x++) {
                const int i = (tile.y + y) * WIDTH + tile.x + x;
                assert_true(depth_at(&tile, x, y) == depth[i]);
                assert_int_equal(owner_at(&tile, x, y), owner[i]);
            }
    }
}

TEST(depth_beyond_the_range_is_clamped_and_nan_is_the_far_plane)
{
    struct zr_tile *tile = cleared_tile();
    const struct zr_window_vertex v[3] = {at(0, 0, -1), at(0, 60, -1), at(60, 0, -1)};
    draw(tile, v);
    assert_true(owned(tile) > 0 && tile->depth[0] == 0.0f);
    tile = cleared_tile();
    const struct zr_window_vertex n[3] = {at(0, 0, NAN), at(0, 60, 0), at(60, 0, 0)};
    draw(tile, n);
    assert_int_equal(owned(tile), 0);
}

/* Fragments tell their owners from the first of their block, in fewer bits than an owner has: here a tile has a few of
 * the first triangles and a few of the last, and the other tile has more between them than these bits count. */
TEST(fragments_of_far_apart_owners_keep_them)
{
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
        assert_int_equal(zr_binned_scene_make(&(struct zr_run){.arena = &arena, .team = team}, &geometry, NULL,
                                              2 * ZR_TILE_SIZE, ZR_TILE_SIZE, NULL, &visible),
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

RUN_TESTS(NULL, NULL)
