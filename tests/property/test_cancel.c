/* A render that is cancelled while it works ends soon, in every step. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "cancel_check.h"
#include "render/trace.h"
#include "scene/looks.h"
#include "support/geometries.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/tests.h"

enum { SIDE = 4096 };

static struct zr_arena arena;

/* The scene must be one that takes far longer than RAISED_MS. */
static void assert_ends_soon(const struct zr_scene *scene)
{
    struct later later;
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    begin(&later, RAISED_MS);
    assert_ended_soon(&later, zr_render(&(struct zr_run){.arena = &arena, .cancel = &later.cancel, .error = &error},
                                        scene, NULL, &frame));
}

static uint32_t *counting(uint32_t count)
{
    uint32_t *numbers = zr_arena_alloc(&arena, count, sizeof *numbers);
    assert_non_null(numbers);
    for (uint32_t i = 0; i < count; i++)
        numbers[i] = i;
    return numbers;
}

static zr_vec4 *scattered(uint32_t count)
{
    struct random random = random_seeded(51);
    zr_vec4 *points = zr_arena_alloc(&arena, count, sizeof *points);
    assert_non_null(points);
    for (uint32_t i = 0; i < count; i++) {
        double x = random_range(&random, -3, 3), y = random_range(&random, -3, 3), z = random_range(&random, -1, 1);
        points[i] = (zr_vec4){(float)x, (float)y, (float)z, 1};
    }
    return points;
}

static struct test_scene test;

static void make(uint32_t points)
{
    zr_arena_init(&arena, (size_t)3 << 30);
    scene_of_triangles(&test, SIDE, SIDE, scattered(points), 1);
    test.mesh.position_count = points;
    test.scene.views[0].output_count = 1;
}

TEST(cutting_of_many_large_faces_stops)
{
    enum { FACES = 20000, CORNERS = 1024 };
    make(CORNERS);
    uint32_t *offsets = zr_arena_alloc(&arena, FACES + 1, sizeof *offsets);
    uint32_t *indices = zr_arena_alloc(&arena, (size_t)FACES * CORNERS, sizeof *indices);
    assert_non_null(indices);
    for (uint32_t i = 0; i < FACES * (uint32_t)CORNERS; i++)
        indices[i] = i % CORNERS;
    for (uint32_t f = 0; f <= FACES; f++)
        offsets[f] = f * CORNERS;
    test.mesh.face_count = FACES;
    test.mesh.face_offsets = offsets;
    test.mesh.indices = indices;
    assert_ends_soon(&test.scene);
    zr_arena_free(&arena);
}

TEST(drawing_of_many_lines_and_points_and_walking_over_many_points_stop)
{
    enum { POINTS = 1 << 16, LINES = 1 << 20, INSTANCES = 5000 };
    make(POINTS);
    uint32_t *lines = zr_arena_alloc(&arena, 2 * LINES, sizeof *lines);
    struct zr_instance *instances = zr_arena_alloc(&arena, INSTANCES, sizeof *instances);
    assert_true(zr_arena_ok(&arena));
    for (uint32_t i = 0; i < 2 * LINES; i++)
        lines[i] = i * 40503u % POINTS;
    for (uint32_t i = 0; i < INSTANCES; i++)
        instances[i] = (struct zr_instance){.object_to_world = zr_mat4_identity()};
    test.mesh.lines = lines;
    test.mesh.line_count = LINES;
    assert_ends_soon(&test.scene);
    test.mesh.line_count = 0;
    test.mesh.points = lines;
    test.mesh.point_count = 2 * LINES;
    test.mesh.point_size = 3.0f;
    assert_ends_soon(&test.scene);
    test.mesh.point_count = 0;
    test.scene.instances = instances;
    test.scene.instance_count = INSTANCES;
    test.scene.views[0].pose = ZR_POSE_PRESET; /* fitted, for which all points are walked over */
    assert_ends_soon(&test.scene);
    zr_arena_free(&arena);
}

/* Each far below what one look at the flag is worth. */
TEST(many_small_instances_stop)
{
    enum { INSTANCES = 1000000, CORNERS = 8 };
    make(CORNERS);
    struct zr_instance *instances = zr_arena_alloc(&arena, INSTANCES, sizeof *instances);
    assert_true(zr_arena_ok(&arena));
    for (uint32_t i = 0; i < INSTANCES; i++)
        instances[i] = (struct zr_instance){.object_to_world = zr_mat4_identity()};
    test.scene.instances = instances;
    test.scene.instance_count = INSTANCES;
    assert_ends_soon(&test.scene);
    zr_arena_free(&arena);
}

/* In drawing, joining and writing them. */
TEST(masks_of_large_instances_stop)
{
    enum { INSTANCES = 400, WINDOW = 1024 };
    static const struct zr_output outputs[] = {{.channel = ZR_CHANNEL_MASKS, .encoding = ZR_ENCODING_JSON},
                                               {.channel = ZR_CHANNEL_MASKS, .encoding = ZR_ENCODING_ZIP}};
    static const zr_vec4 corners[] = {{-3, -3, 0.5f, 1}, {3, -3, 0.4f, 1}, {0, 3, 0.3f, 1}};
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    struct zr_answer answer;
    int cancelled = 0;
    double took_ms = HUGE_VAL; /* least of two: the first one also asks the system for its memory */
    for (double share = -0.06; share < 0.75; share += 0.08) {
        zr_arena_init(&arena, (size_t)1 << 31);
        scene_of_triangles(&test, WINDOW, WINDOW, corners, 1);
        struct zr_instance *instances = zr_arena_alloc(&arena, INSTANCES, sizeof *instances);
        for (uint32_t i = 0; i < INSTANCES; i++)
            instances[i] = (struct zr_instance){.object_to_world = zr_mat4_identity()};
        test.scene.instances = instances;
        test.scene.instance_count = INSTANCES;
        test.scene.views[0].outputs = outputs;
        test.scene.views[0].output_count = 2;
        if (share < 0.1) {
            const double before = now_ms(CLOCK_THREAD_CPUTIME_ID);
            assert_int_equal(zr_render(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, NULL, &frame),
                             ZR_OK);
            assert_int_equal(zr_encode(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, frame, &answer),
                             ZR_OK);
            took_ms = fmin(took_ms, now_ms(CLOCK_THREAD_CPUTIME_ID) - before);
            print_message("%d masks of %d pixels: %.0f ms\n", INSTANCES, WINDOW * WINDOW, took_ms);
            zr_arena_free(&arena);
            continue;
        }
        struct later later;
        begin(&later, share * took_ms);
        enum zr_status status = zr_render(&(struct zr_run){.arena = &arena, .cancel = &later.cancel, .error = &error},
                                          &test.scene, NULL, &frame);
        if (status == ZR_OK)
            status = zr_encode(&(struct zr_run){.arena = &arena, .cancel = &later.cancel, .error = &error}, &test.scene,
                               frame, &answer);
        if (status == ZR_OK) /* done before, on a machine that is less busy now */
            end(&later);
        else
            assert_ended_soon(&later, status);
        cancelled += status != ZR_OK;
        zr_arena_free(&arena);
    }
    assert_true(cancelled >= 4);
}

/* The trace of one polygon whose edges cross one another in all rows. */
TEST(traces_stop)
{
    enum { CORNERS = 5000, WINDOW = 64 };
    static const struct zr_output outputs[] = {{.channel = ZR_CHANNEL_FACE_ID, .encoding = ZR_ENCODING_NPY},
                                               {.channel = ZR_CHANNEL_TRACE, .encoding = ZR_ENCODING_JSON}};
    static zr_vec4 corners[CORNERS];
    struct random random = random_seeded(5);
    for (uint32_t i = 0; i < CORNERS; i++) {
        const float x = (float)random_range(&random, -0.95, 0.95), y = (float)random_range(&random, -0.95, 0.95);
        corners[i] = (zr_vec4){x, y, 0.5f, 1};
    }
    scene_of_polygon(&test, WINDOW, WINDOW, corners, CORNERS);
    test.scene.views[0].outputs = outputs;
    for (int a = 0; a < ZR_ALGORITHM_COUNT; a++) {
        struct zr_error error = {.count = 0};
        const struct zr_frame *drawn;
        zr_arena_init(&arena, (size_t)1 << 30);
        test.scene.algorithm = (enum zr_algorithm)a;
        test.scene.views[0].output_count = 1;
        assert_int_equal(zr_render(&(struct zr_run){.arena = &arena, .error = &error}, &test.scene, NULL, &drawn),
                         ZR_OK);
        test.scene.views[0].output_count = 2;
        struct zr_frame frame = *drawn;
        const double before = now_ms(CLOCK_THREAD_CPUTIME_ID);
        assert_int_equal(
            zr_trace_make(&(struct zr_run){.arena = &arena, .scratch = &arena, .error = &error}, &test.scene, &frame),
            ZR_OK);
        const double took_ms = now_ms(CLOCK_THREAD_CPUTIME_ID) - before;
        print_message("%s: %.0f ms\n", algorithm_words[a], took_ms);
        for (double share = 0.1; share < 0.6; share += 0.2) {
            struct later later;
            begin(&later, share * took_ms);
            assert_ended_soon(
                &later,
                zr_trace_make(
                    &(struct zr_run){.arena = &arena, .scratch = &arena, .cancel = &later.cancel, .error = &error},
                    &test.scene, &frame));
        }
        zr_arena_free(&arena);
    }
}

/* Stars of as many corners as one look at the flag is worth, and of fewer. */
TEST(instances_of_shapes_that_cross_themselves_stop)
{
    enum { INSTANCES = 30000 };
    static const uint32_t sizes[] = {11, 101, 701, 1023};
    for (size_t size = 0; size < sizeof sizes / sizeof sizes[0]; size++) {
        const uint32_t corners = sizes[size];
        make(corners);
        zr_vec4 *positions = zr_arena_alloc(&arena, corners, sizeof *positions);
        struct zr_instance *instances = zr_arena_alloc(&arena, INSTANCES, sizeof *instances);
        assert_true(zr_arena_ok(&arena));
        for (uint32_t i = 0; i < corners; i++) {
            const double angle = 6.283185307179586 * (i * (corners / 2) % corners) / corners;
            positions[i] = (zr_vec4){(float)cos(angle), (float)sin(angle), 0, 1};
        }
        for (uint32_t i = 0; i < INSTANCES; i++)
            instances[i] = (struct zr_instance){.object_to_world = zr_mat4_identity()};
        test.mesh.positions = positions;
        test.face_offsets[1] = corners;
        test.mesh.indices = counting(corners);
        test.scene.instances = instances;
        test.scene.instance_count = INSTANCES;
        assert_ends_soon(&test.scene);
        zr_arena_free(&arena);
    }
}

TEST(face_of_very_many_corners_stops)
{
    enum { CORNERS = 60001 };
    make(CORNERS);
    test.face_offsets[1] = CORNERS;
    test.mesh.indices = counting(CORNERS);
    assert_ends_soon(&test.scene);
    zr_arena_free(&arena);
}

TEST(every_algorithm_stops_amid_large_triangles)
{
    enum { TRIANGLES = 20000 };
    for (int a = 0; a < ZR_ALGORITHM_COUNT; a++) {
        make(3 * TRIANGLES);
        uint32_t *offsets = counting(TRIANGLES + 1);
        for (uint32_t f = 0; f <= TRIANGLES; f++)
            offsets[f] *= 3;
        test.mesh.face_count = TRIANGLES;
        test.mesh.face_offsets = offsets;
        test.mesh.indices = counting(3 * TRIANGLES);
        test.scene.algorithm = (enum zr_algorithm)a;
        assert_ends_soon(&test.scene);
        zr_arena_free(&arena);
    }
}

/* ---- pictures of looks ---- */

#if IS_SANITIZED
enum { WINDOW = SIDE / 4, FEW = 30, MANY = 200 };
#else
enum { WINDOW = SIDE / 2, FEW = 30, MANY = 400 };
#endif

/* A bumpy ground of cells x cells squares, of two triangles each. */
static void make_ground(uint32_t cells)
{
    const uint32_t row = cells + 1, triangles = 2 * cells * cells;
    zr_vec4 *points = zr_arena_alloc(&arena, row * row, sizeof *points);
    uint32_t *indices = zr_arena_alloc(&arena, 3 * triangles, sizeof *indices), *corner = indices;
    uint32_t *offsets = counting(triangles + 1);
    assert_true(zr_arena_ok(&arena));
    for (uint32_t i = 0; i < row * row; i++) {
        const float x = (float)(i % row) / (float)cells, y = (float)(i / row) / (float)cells;
        points[i] = (zr_vec4){2 * x - 1, 0.05f * (float)(i * 2654435761u >> 28) / 16.0f, 2 * y - 1, 1};
    }
    for (uint32_t i = 0; i < cells * cells; i++, corner += 6) {
        const uint32_t a = i / cells * row + i % cells;
        const uint32_t two[6] = {a, a + row, a + 1, a + 1, a + row, a + row + 1};
        memcpy(corner, two, sizeof two);
    }
    for (uint32_t f = 0; f <= triangles; f++)
        offsets[f] *= 3;
    test.mesh.positions = points;
    test.mesh.position_count = row * row;
    test.mesh.face_count = triangles;
    test.mesh.face_offsets = offsets;
    test.mesh.indices = indices;
}

/* Small faces in a small window, or large ones in a large window. */
static void make_look(const char *name, bool large_window)
{
    zr_arena_init(&arena, (size_t)3 << 30);
    scene_of_triangles(&test, WINDOW / 8, WINDOW / 8, NULL, 1);
    if (large_window) test.scene.views[0].width = test.scene.views[0].height = WINDOW;
    make_ground(large_window ? FEW : MANY);
    const struct zr_look *look = zr_look_find(name);
    test.scene.look = look;
    test.picture = *look->picture;
    test.scene.lights = look->lights;
    test.scene.light_count = look->light_count;
    test.material = look->material;
    test.material.double_sided = true;
    scene_look(&test.scene, (struct zr_view){.pose = ZR_POSE_ORBIT,
                                             .azimuth_degrees = 35,
                                             .elevation_degrees = 28,
                                             .up = {0, 1, 0},
                                             .projection = ZR_PROJECTION_PERSPECTIVE,
                                             .yfov_radians = 0.5f});
    test.scene.views[0].output_count = 1;
}

/* Told to stop after so long: whether it was before the picture was complete. The time that it took goes to taken_ms.
 */
static bool stops_amid(uint32_t cells, double after_ms, double *taken_ms)
{
    struct later later;
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    zr_arena_reset(&arena, SIZE_MAX);
    make_ground(cells);
    begin(&later, after_ms);
    const double begin_ms = now_ms(later.clock);
    const enum zr_status status = zr_render(&(struct zr_run){.arena = &arena, .cancel = &later.cancel, .error = &error},
                                            &test.scene, NULL, &frame);
    *taken_ms = now_ms(later.clock) - begin_ms;
    if (status != ZR_OK) {
        assert_ended_soon(&later, status);
        return true;
    }
    end(&later);
    return false;
}

/* At some times from the beginning to shortly before the end: so in each stage that takes long. The same picture may
 * take half the time of the turn before, where the machine is shared: then its end moves to what it took. */
TEST(pictures_of_looks_stop_in_all_stages)
{
    enum { TIMES = 5, TURNS = 10 };
    static const struct {
        const char *look;
        uint32_t side;
        bool large_window;
        float edge_width;
    } cases[] = {{"studio", 1, true, 0},
                 {"technical", 1, true, 64},
                 {"textbook", 2, true, 0},
                 {"studio", 1, false, 0},
                 {"outdoor", 1, false, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const uint32_t cells = cases[i].large_window ? FEW : MANY;
        double whole_ms = 0, taken_ms;
        make_look(cases[i].look, cases[i].large_window);
        test.picture.side = cases[i].side;
        if (cases[i].edge_width > 0) test.picture.edges.width = cases[i].edge_width;
        for (int turn = 0; turn < 2; turn++) /* the first one pays for pages */
            assert_false(stops_amid(cells, (double)INFINITY, &whole_ms));
        for (int k = 0; k < TIMES; k++) {
            int turn = 0;
            while (!stops_amid(cells, 0.85 * whole_ms * k / TIMES, &taken_ms)) {
                assert_true(++turn < TURNS);
                whole_ms = fmin(whole_ms, taken_ms);
            }
        }
        print_message("%s, %u samples: %.0f ms\n", cases[i].look, cases[i].side * cases[i].side, whole_ms);
        zr_arena_free(&arena);
    }
}

RUN_TESTS(NULL, NULL)
