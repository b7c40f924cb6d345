/* Clouds of points: order, threads and sizes leave the picture as it is, and their memory is bounded. */
#include <string.h>

#include "geometry/build.h"
#include "raster/cloud_bins.h"
#include "scene/camera/resolved_view.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 28)

enum { WIDTH = 400, HEIGHT = 300, POINTS_MOST = 40000 };

static struct test_scene test;
static zr_vec4 positions[POINTS_MOST], colors[POINTS_MOST];
static uint32_t points[POINTS_MOST];

/* Makes points of distinct depths and of any colours, a few of which are outside the view. */
static struct zr_mesh *scene_of_cloud(uint32_t count, float size, bool is_round)
{
    struct random random = random_seeded(1);
    for (uint32_t i = 0; i < count; i++) {
        const float depth = (float)i / (float)count * 1.8f - 0.9f;
        positions[i] =
            (zr_vec4){(float)random_range(&random, -1.05, 1.05), (float)random_range(&random, -1.05, 1.05), depth, 1};
        colors[i] = (zr_vec4){(float)random_range(&random, 0, 1), (float)random_range(&random, 0, 1),
                              (float)random_range(&random, 0, 1), 1};
        points[i] = i;
    }
    scene_of_triangles(&test, WIDTH, HEIGHT, positions, 0);
    test.material.base_color = (zr_vec4){0.5f, 1, 0.75f, 1};
    test.mesh.position_count = test.mesh.point_count = count;
    test.mesh.colors = colors;
    test.mesh.points = points;
    test.mesh.point_size = size;
    test.mesh.points_are_round = is_round;
    return &test.mesh;
}

static void shuffle(uint32_t count)
{
    struct random random = random_seeded(2);
    for (uint32_t i = count - 1; i > 0; i--) {
        const uint32_t k = random_below(&random, i + 1), kept = points[i];
        points[i] = points[k];
        points[k] = kept;
    }
}

static void assert_same_pixels(const struct zr_frame *a, const struct zr_frame *b)
{
    const size_t pixels = (size_t)WIDTH * HEIGHT;
    assert_memory_equal(a->depth, b->depth, pixels * sizeof *a->depth);
    assert_memory_equal(a->window_depth, b->window_depth, pixels * sizeof *a->window_depth);
    assert_memory_equal(a->color, b->color, 4 * pixels);
    assert_int_equal(a->covered_pixels, b->covered_pixels);
    assert_int_equal(a->counts.points, b->counts.points);
    assert_int_equal(a->counts.outside_points, b->counts.outside_points);
    assert_int_equal(a->counts.unplaced, b->counts.unplaced);
}

/* Draws the cloud by other algorithms, which place points one by one. */
static void assert_same_by(int first, int end)
{
    const struct zr_frame *cloud = scene_render(&arena, NULL, &test.scene);
    for (int other = first; other < end; other++) {
        test.scene.algorithm = (enum zr_algorithm)other;
        const struct zr_frame *placed = scene_render(&arena, NULL, &test.scene);
        assert_same_pixels(cloud, placed);
        assert_memory_equal(cloud->face_id, placed->face_id, (size_t)WIDTH * HEIGHT * sizeof *cloud->face_id);
    }
    zr_arena_reset(&arena, SIZE_MAX);
}

/* ---- pictures ---- */

TEST_AROUND(the_order_of_points_has_no_effect_on_distinct_depths, open_arena, close_arena)
{
    static const int threads[] = {1, 3};
    for (size_t i = 0; i < sizeof threads / sizeof *threads; i++) {
        struct zr_team *team = zr_team_create(threads[i]);
        assert_non_null(team);
        scene_of_cloud(POINTS_MOST, 3, i > 0);
        const struct zr_frame *in_order = scene_render(&arena, team, &test.scene);
        assert_true(in_order->counts.outside_points > 0);
        assert_int_equal(in_order->counts.points, POINTS_MOST);
        shuffle(POINTS_MOST);
        assert_same_pixels(in_order, scene_render(&arena, team, &test.scene));
        zr_team_destroy(team);
    }
}

TEST_AROUND(of_points_with_one_depth_the_first_is_seen, open_arena, close_arena)
{
    static const uint32_t order[] = {2, 0, 1};
    scene_of_cloud(3, 9, false);
    for (int i = 0; i < 3; i++)
        positions[i] = (zr_vec4){0, 0, 0, 1};
    test.mesh.points = order;
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    const size_t middle = (size_t)HEIGHT / 2 * WIDTH + WIDTH / 2;
    assert_int_equal(frame->face_id[middle], 1);
    assert_int_equal(frame->covered_pixels, 81);
    assert_int_equal(frame->color[4 * middle], (int)(0.5f * colors[2].x * 255.0f + 0.5f));
}

/* Up to, and beyond, the side of a tile and of the squares of tiles in which larger points are listed. */
TEST_AROUND(points_of_any_size_are_those_of_every_algorithm, open_arena, close_arena)
{
    static const float sizes[] = {1, 2, 7, 63, 64, 65, 128, 255, 256, 257, 700, 1100, 4100, 5000};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int is_round = 0; is_round < 2; is_round++) {
            scene_of_cloud(60, sizes[i], is_round);
            assert_same_by(1, ZR_ALGORITHM_COUNT);
        }
}

/* Also of clouds whose points differ in size and shape. */
TEST_AROUND(clouds_beside_one_another_are_those_of_every_algorithm, open_arena, close_arena)
{
    enum { CLOUDS = 4, OF_EACH = 200 };
    static const float sizes[CLOUDS] = {3, 30, 3, 100};
    static struct zr_mesh meshes[CLOUDS];
    static struct zr_instance instances[CLOUDS];
    scene_of_cloud(CLOUDS * OF_EACH, 1, false);
    shuffle(CLOUDS * OF_EACH);
    for (uint32_t i = 0; i < CLOUDS; i++) {
        meshes[i] = test.mesh;
        meshes[i].points += i * OF_EACH;
        meshes[i].point_count = OF_EACH;
        meshes[i].point_size = sizes[i];
        meshes[i].points_are_round = i > 1;
        instances[i] = test.instance;
        instances[i].mesh = i;
    }
    test.scene.mesh_count = test.scene.instance_count = CLOUDS;
    test.scene.meshes = meshes;
    test.scene.instances = instances;
    assert_same_by(1, ZR_ALGORITHM_COUNT);
}

/* Masked and blended points are lists of fragments. */
TEST_AROUND(points_that_are_seen_through_are_those_of_every_algorithm, open_arena, close_arena)
{
    static const enum zr_alpha_mode modes[] = {ZR_ALPHA_MASK, ZR_ALPHA_BLEND};
    for (int i = 0; i < 4; i++) {
        scene_of_cloud(300, i % 2 ? 90 : 20, i % 2);
        for (int k = 0; k < 300; k++)
            colors[k].w = colors[k].x;
        test.material.alpha_mode = modes[i / 2];
        test.material.alpha_cutoff = 0.5f;
        assert_same_by(ZR_ALGORITHM_SCANLINE, ZR_ALGORITHM_SCANLINE + 1);
    }
}

/* ---- memory and cancellation ---- */

static enum zr_status bin_cloud(const struct zr_cancel *cancel, struct zr_geometry *geometry,
                                struct zr_cloud_bins *bins)
{
    static const struct zr_window window = {WIDTH, HEIGHT, 1, 1.0f};
    struct zr_camera camera;
    struct zr_error error = {.count = 0};
    const struct zr_run run = {.arena = &arena, .error = &error};
    assert_int_equal(zr_camera_resolve(&run, &test.scene, &test.scene.views[0], NULL, &camera), ZR_OK);
    assert_int_equal(zr_geometry_build(&run, &test.scene, &camera, &window, false, geometry), ZR_OK);
    return zr_cloud_bins_build(&(struct zr_run){.arena = &arena, .cancel = cancel}, geometry, ZR_ALPHA_OPAQUE, WIDTH,
                               HEIGHT, bins);
}

/* A point of the largest size is listed four times at most. */
TEST_AROUND(a_point_takes_few_bytes, open_arena, close_arena)
{
    static const struct {
        float size;
        double bytes;
    } cases[] = {{1, 20}, {4, 20}, {64, 80}, {300, 80}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct zr_geometry geometry;
        struct zr_cloud_bins bins;
        size_t used[2];
        for (int k = 0; k < 2; k++) {
            scene_of_cloud(k == 0 ? POINTS_MOST / 2 : POINTS_MOST, cases[i].size, false);
            zr_arena_reset(&arena, SIZE_MAX);
            assert_int_equal(bin_cloud(NULL, &geometry, &bins), ZR_OK);
            assert_int_equal(geometry.vertex_count, 0);
            used[k] = arena.used;
        }
        const double bytes = (double)(used[1] - used[0]) / (POINTS_MOST / 2);
        if (bytes > cases[i].bytes) fail_msg("size %g: %g bytes per point", (double)cases[i].size, bytes);
    }
}

TEST_AROUND(binning_and_drawing_end_when_they_are_cancelled, open_arena, close_arena)
{
    static struct zr_tile tile;
    const struct zr_cancel cancel = {.raised = true};
    struct zr_geometry geometry;
    struct zr_cloud_bins bins;
    scene_of_cloud(POINTS_MOST, 30, false);
    assert_int_equal(bin_cloud(&cancel, &geometry, &bins), ZR_CANCELLED);
    assert_int_equal(bins.counts.points, 0);
    assert_int_equal(bin_cloud(NULL, &geometry, &bins), ZR_OK);
    assert_int_equal(bins.counts.points, POINTS_MOST);
    zr_tile_place(&tile, 1, WIDTH, HEIGHT);
    zr_tile_begin(&tile, NULL, WIDTH, HEIGHT);
    assert_true(zr_cloud_bins_any(&bins, 1));
    assert_false(zr_cloud_bins_draw(&bins, 1, &cancel, &tile));
    assert_true(zr_cloud_bins_draw(&bins, 1, NULL, &tile));
}

TEST(without_memory_binning_fails)
{
    struct zr_geometry geometry;
    struct zr_cloud_bins bins;
    zr_arena_init(&arena, 1 << 19);
    scene_of_cloud(POINTS_MOST, 64, false);
    assert_int_equal(bin_cloud(NULL, &geometry, &bins), ZR_NO_MEMORY);
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
