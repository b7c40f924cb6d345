/* Points: what they cover, what is counted and predicted of them, and how scenes give them. */
#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

#include "json_check.h"
#include "raster/binned_scene.h"
#include "raster/oddeven.h"
#include "raster/point.h"
#include "support/cmocka_all.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/test_arena.h"

TEST_ARENA(1 << 26)

/* ---- what they cover ---- */

static void sizes_are_whole_pixels_half_down_and_one_at_least(void **state)
{
    (void)state;
    static const struct {
        float size, scale;
        int32_t width;
    } cases[] = {{1, 1, 1},    {1.25f, 1, 1}, {1.5f, 1, 1}, {1.501953125f, 1, 1}, {1.50390625f, 1, 2},
                 {1.6f, 1, 2}, {2.5f, 1, 2},  {2.6f, 1, 3}, {64, 1, 64},          {0, 1, 1},
                 {9, 0, 1},    {1.5f, 2, 3},  {1.3f, 4, 5}, {2.6f, 8, 21},        {64, 8, 512}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(zr_point_width(cases[i].size, cases[i].scale), cases[i].width);
}

/* One point of a mesh, in the window at x, y. */
struct one {
    struct zr_mesh mesh;
    struct zr_draw draw;
    struct zr_window_vertex vertex;
    struct zr_geometry geometry;
};

static void one_make(struct one *one, float x, float y, float z, float size)
{
    static const uint32_t corners[3] = {0, 0, 0};
    static const struct zr_material opaque = {.alpha_mode = ZR_ALPHA_OPAQUE};
    one->mesh = (struct zr_mesh){.point_size = size};
    one->vertex = (struct zr_window_vertex){.x = x, .y = y, .z = z, .oow = 1};
    one->draw = (struct zr_draw){.count = 1, .kind = ZR_DRAW_POINTS, .counted = true, .corners = corners};
    one->draw.mesh = &one->mesh;
    one->draw.material = &opaque;
    one->geometry = (struct zr_geometry){.window = {.line_width = 1, .point_scale = 1},
                                         .vertices = &one->vertex,
                                         .vertex_count = 1,
                                         .primitive_count = 1,
                                         .draw_count = 1,
                                         .draws = &one->draw};
}

/* Odd ones are around the pixel that they lie in, even ones around the corner that is nearest; borders belong to what
 * is on the right and above. */
static void squares_are_around_a_pixel_or_a_corner(void **state)
{
    (void)state;
    static const struct {
        float x, size;
        int32_t first;
    } cases[] = {{5.5f, 1, 5},   {5.0f, 1, 5},   {5.996f, 1, 5}, {5.9985f, 1, 6}, {0.0f, 1, 0},  {5.5f, 3, 4},
                 {5.0f, 3, 4},   {4.996f, 3, 3}, {5.0f, 2, 4},   {5.496f, 2, 4},  {5.5f, 2, 5},  {4.5f, 2, 4},
                 {4.496f, 2, 3}, {1.0f, 4, -1},  {2.0f, 5, 0},   {10.0f, 8, 6},   {9.49f, 8, 5}, {9.5f, 8, 6}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct one one;
        int32_t box[4];
        one_make(&one, cases[i].x, 3.5f, 0.5f, cases[i].size);
        zr_point_box(&one.geometry, &one.draw, 0, box);
        assert_int_equal(box[0], cases[i].first);
        assert_int_equal(box[2], cases[i].first + (int32_t)cases[i].size - 1);
        assert_int_equal(box[3] - box[1], (int32_t)cases[i].size - 1);
    }
}

static int assert_same_tile(const struct zr_tile *got, const struct zr_tile *want)
{
    int owned = 0;
    for (int y = 0; y < want->height; y++)
        for (int x = 0; x < want->width; x++) {
            const int i = y * ZR_TILE_STRIDE + x;
            const uint32_t of_want = want->is_empty ? 0 : want->owner[i];
            assert_int_equal(got->is_empty ? 0 : got->owner[i], of_want);
            if (of_want == 0) continue;
            assert_true(got->depth[i] == want->depth[i]);
            owned++;
        }
    return owned;
}

/* In a window of three by two tiles, of all sizes: also over many tiles, and beyond the window. */
static void points_have_the_pixels_of_their_edges_in_the_tiles_that_list_them(void **state)
{
    (void)state;
    enum { WIDTH = 150, HEIGHT = 100, TILES = 6, ROUNDS = 1000 };
    static struct zr_tile by_edges, by_pixels;
    struct random random = random_seeded(23);
    int owned = 0;
    for (int round = 0; round < ROUNDS; round++) {
        const double step = round % 3 == 0 ? 0.5 : 1.0 / 512;
        const float x = (float)(floor(random_range(&random, -3, WIDTH + 3) / step) * step);
        const float y = (float)(floor(random_range(&random, -3, HEIGHT + 3) / step) * step);
        const float z = (float)random_range(&random, 0, 1), size = (float)random_range(&random, 1, round % 9 ? 9 : 300);
        struct one one;
        struct zr_binned_scene visible;
        struct zr_primitive primitive;
        one_make(&one, x, y, z, size);
        zr_arena_reset(&arena, 1 << 20);
        assert_int_equal(zr_binned_scene_make(&arena, NULL, &one.geometry, NULL, WIDTH, HEIGHT, NULL, NULL, &visible),
                         ZR_OK);
        zr_primitive_make(&one.geometry, &one.draw, 0, WIDTH, HEIGHT, &primitive);
        for (uint32_t number = 0; number < TILES; number++) {
            zr_tile_place(&by_edges, number, WIDTH, HEIGHT);
            zr_tile_begin(&by_edges, NULL, WIDTH, HEIGHT);
            zr_oddeven_draw(&one.geometry, &primitive, &by_edges);
            assert_true(zr_visibility_tile(&visible.visibility, number, NULL, &by_pixels));
            if (!by_pixels.is_empty) visible.halfspace->flush(&by_pixels);
            owned += assert_same_tile(&by_pixels, &by_edges);
        }
    }
    assert_true(owned > 100000);
}

/* ---- what is counted, listed and predicted ---- */

/* Of the test's own mesh: a triangle and four points, of which two are in view. */
static struct zr_mesh *scene_of_points(struct test_scene *test, float size)
{
    static const uint32_t points[4] = {0, 3, 4, 5};
    static const zr_vec4 p[] = {{-0.5f, -0.5f, 0, 1},  {0, -0.5f, 0, 1},    {-0.5f, 0, 0, 1},
                                {0.5f, 0.5f, 0.5f, 1}, {0.5f, 0.5f, 0, -1}, {1.5f, 0, 0, 1}};
    scene_of_triangles(test, 64, 64, p, 1);
    test->mesh.position_count = 6;
    test->mesh.point_count = 4;
    test->mesh.points = points;
    test->mesh.point_size = size;
    return &test->mesh;
}

static void points_behind_the_eye_or_beside_the_window_are_outside(void **state)
{
    (void)state;
    static struct test_scene test;
    scene_of_points(&test, 64);
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    assert_int_equal(frame->counts.points, 4);
    assert_int_equal(frame->counts.outside_points, 2);
    test.mesh.face_count = 0;
    test.mesh.points += 2;
    test.mesh.point_count = 2;
    struct zr_answer answer = scene_encode(&arena, NULL, &test.scene);
    assert_string_equal(answer.warnings, "nothing is seen: all geometry is outside the view");
}

static double number_in(const cJSON *object, const char *key)
{
    const cJSON *item = cJSON_GetObjectItem(object, key);
    assert_non_null(item);
    return item->valuedouble;
}

static void info_lists_points_behind_faces(void **state)
{
    (void)state;
    static const struct zr_output output = {.channel = ZR_CHANNEL_INFO, .encoding = ZR_ENCODING_JSON};
    static struct test_scene test;
    scene_of_points(&test, 3);
    test.scene.views[0].outputs = &output;
    test.scene.views[0].output_count = 1;
    struct zr_answer answer = scene_encode(&arena, NULL, &test.scene);
    cJSON *info = cJSON_ParseWithLength(answer.bytes, answer.size);
    assert_non_null(info);
    const cJSON *counts = cJSON_GetObjectItem(info, "counts");
    assert_true(number_in(counts, "points") == 4 && number_in(counts, "outsidePoints") == 2);
    assert_true(number_in(cJSON_GetArrayItem(cJSON_GetObjectItem(info, "meshes"), 0), "points") == 4);
    const cJSON *faces = cJSON_GetObjectItem(info, "faces"), *second = cJSON_GetArrayItem(faces, 2);
    assert_int_equal(cJSON_GetArraySize(faces), 3);
    assert_true(number_in(second, "id") == 3 && number_in(second, "pixels") == 9);
    cJSON_Delete(info);
}

static double fragments_of(struct test_scene *test, uint32_t side)
{
    test->scene.picture.side = side;
    return scene_cost(&test->scene, UINT32_MAX).fragments;
}

static void points_cost_the_pixels_that_they_have_in_the_window(void **state)
{
    (void)state;
    static struct test_scene test;
    struct zr_mesh *mesh = scene_of_points(&test, 10);
    const double small = fragments_of(&test, 1), sampled = fragments_of(&test, 4);
    assert_true(sampled > small + 2 * 2 * 40 * 40); /* two points in view */
    mesh->point_size = 20;
    const double larger = fragments_of(&test, 1);
    assert_true(larger > small + 2 * 300);
    mesh->point_size = 60;
    assert_true(fragments_of(&test, 1) < small + 2 * 2 * 64 * 64); /* no more than there is in the window */
    mesh->point_count = 2;
    mesh->points += 2;
    assert_true(fragments_of(&test, 1) < small);
}

/* ---- how scenes give them ---- */

static void points_are_indices_of_positions(void **state)
{
    (void)state;
    static const uint32_t points[3] = {2, 0, 2};
    struct reading *reading = read_scene("{\"meshes\": [{\"points\": [2, 0, 2], \"pointSize\": 2.5, " POSITIONS
                                         "}, {" POSITIONS ", \"points\": [3]}]}");
    assert_read(reading);
    const struct zr_mesh *meshes = reading->scene->meshes;
    assert_int_equal(meshes[0].point_count, 3);
    assert_memory_equal(meshes[0].points, points, sizeof points);
    assert_true(meshes[0].point_size == 2.5f && meshes[1].point_size == 1.0f);
    assert_int_equal(meshes[0].face_count + meshes[0].line_count, 0);
    reading_free(reading);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_are_whole_pixels_half_down_and_one_at_least),
        cmocka_unit_test(squares_are_around_a_pixel_or_a_corner),
        cmocka_unit_test_setup_teardown(points_have_the_pixels_of_their_edges_in_the_tiles_that_list_them, open_arena,
                                        close_arena),
        cmocka_unit_test_setup_teardown(points_behind_the_eye_or_beside_the_window_are_outside, open_arena,
                                        close_arena),
        cmocka_unit_test_setup_teardown(info_lists_points_behind_faces, open_arena, close_arena),
        cmocka_unit_test(points_cost_the_pixels_that_they_have_in_the_window),
        cmocka_unit_test(points_are_indices_of_positions),
    };
    return cmocka_run_group_tests_name("points", tests, NULL, NULL);
}
