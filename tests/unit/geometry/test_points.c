/* Points: what they cover, what is counted and predicted of them, and how scenes give them. */
#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

#include "raster/binned_scene.h"
#include "raster/oddeven.h"
#include "raster/point.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

TEST_ARENA(1 << 26)

/* ---- what they cover ---- */

TEST(sizes_are_whole_pixels_half_down_and_one_at_least)
{
    static const struct {
        float size, scale;
        int32_t width;
    } cases[] = {{1, 1, 1},    {1.25f, 1, 1}, {1.5f, 1, 1}, {1.501953125f, 1, 1}, {1.50390625f, 1, 2},
                 {1.6f, 1, 2}, {2.5f, 1, 2},  {2.6f, 1, 3}, {64, 1, 64},          {0, 1, 1},
                 {9, 0, 1},    {1.5f, 2, 3},  {1.3f, 4, 5}, {2.6f, 8, 21},        {64, 8, 512}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(zr_point_width(cases[i].size, cases[i].scale), cases[i].width);
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

TEST_AROUND(points_behind_the_eye_or_beside_the_window_are_outside, open_arena, close_arena)
{
    static struct test_scene test;
    scene_of_points(&test, 64);
    const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
    assert_int_equal(frame->counts.points, 4);
    assert_int_equal(frame->counts.outside_points, 2);
    test.mesh.face_count = 0;
    test.mesh.points += 2;
    test.mesh.point_count = 2;
    struct zr_answer answer = scene_encode(&arena, NULL, &test.scene);
    assert_string_equal(answer.warnings, "nothing is visible: all geometry is outside the view");
}

static double number_in(const cJSON *object, const char *key)
{
    const cJSON *item = cJSON_GetObjectItem(object, key);
    assert_non_null(item);
    return item->valuedouble;
}

TEST_AROUND(info_lists_points_behind_faces, open_arena, close_arena)
{
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

/* ---- how scenes give them ---- */

/* Rows of a point from its lower end on: pixels that are missing at either side. */
TEST(round_points_are_octagons)
{
    static const struct {
        int32_t width, cut;
    } cases[] = {{1, 0}, {2, 0}, {3, 0}, {4, 1}, {7, 2}, {10, 3}, {16, 4}, {64, 19}, {512, 153}};
    const struct zr_mesh square = {.points_are_round = false}, round = {.points_are_round = true};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(zr_point_cut(&round, cases[i].width), cases[i].cut);
        assert_int_equal(zr_point_cut(&square, cases[i].width), 0);
    }
}

/* Counts the pixels of a point in the middle of the window, which has the same picture by all algorithms. */
TEST_AROUND(round_points_lack_their_corners_by_every_algorithm, open_arena, close_arena)
{
    static const uint32_t points[] = {3};
    static const struct {
        float size;
        uint32_t pixels;
    } cases[] = {{1, 1}, {3, 9}, {4, 12}, {5, 21}, {10, 76}, {31, 781}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int algorithm = 0; algorithm < ZR_ALGORITHM_COUNT; algorithm++) {
            static struct test_scene test;
            struct zr_mesh *mesh = scene_of_points(&test, cases[i].size);
            uint32_t covered = 0;
            mesh->face_count = 0;
            mesh->points = points;
            mesh->point_count = 1;
            mesh->points_are_round = true;
            test.scene.algorithm = (enum zr_algorithm)algorithm;
            const struct zr_frame *frame = scene_render(&arena, NULL, &test.scene);
            for (size_t at = 0; at < 64 * 64; at++)
                covered += frame->face_id[at] != 0;
            assert_int_equal(covered, cases[i].pixels);
        }
}

TEST(points_have_a_shape)
{
    struct reading *reading =
        read_scene("{\"meshes\": [{" POSITIONS ", \"points\": [0], \"pointShape\": \"round\"}, {" POSITIONS
                   ", \"points\": [0], \"pointShape\": \"square\"}, {" POSITIONS ", \"points\": [3]}]}");
    assert_read(reading);
    for (int i = 0; i < 3; i++)
        assert_true(reading->scene->meshes[i].points_are_round == (i == 0));
    reading_free(reading);
}

TEST(points_are_indices_of_positions)
{
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

RUN_TESTS(NULL, NULL)
