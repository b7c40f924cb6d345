/* A render that is told to stop while it works does so soon, whatever it is about. */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "support/cmocka_all.h"
#include "support/random.h"
#include "support/scenes.h"

/* RAISED_MS: well within the work of each case. SLACK_S: for sanitizers and busy machines; what does not look at the
 * flag takes far longer. */
enum { RAISED_MS = 30, SLACK_S = 5, SIDE = 4096 };

static struct zr_arena arena;

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void *raise_later(void *argument)
{
    struct zr_cancel *cancel = argument;
    nanosleep(&(struct timespec){.tv_nsec = RAISED_MS * 1000000L}, NULL);
    atomic_store(&cancel->raised, true);
    return NULL;
}

/* The scene must be one that takes minutes. */
static void assert_ends_soon(const struct zr_scene *scene)
{
    struct zr_cancel cancel = {false};
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    pthread_t thread;
    double begin = seconds();
    assert_int_equal(pthread_create(&thread, NULL, raise_later, &cancel), 0);
    enum zr_status status = zr_render(&arena, NULL, scene, NULL, &cancel, &frame, &error);
    pthread_join(thread, NULL);
    assert_int_equal(status, ZR_CANCELLED);
    assert_true(seconds() - begin < SLACK_S);
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
    test.scene.output_count = 1;
}

static void cutting_of_many_large_faces_stops(void **state)
{
    enum { FACES = 20000, CORNERS = 1024 };
    (void)state;
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

static void drawing_of_many_lines_and_walking_over_many_points_stop(void **state)
{
    enum { POINTS = 1 << 16, LINES = 1 << 20, INSTANCES = 5000 };
    (void)state;
    make(POINTS);
    uint32_t *lines = zr_arena_alloc(&arena, 2 * LINES, sizeof *lines);
    struct zr_instance *instances = zr_arena_alloc(&arena, INSTANCES, sizeof *instances);
    assert_true(zr_arena_ok(&arena));
    for (uint32_t i = 0; i < 2 * LINES; i++)
        lines[i] = i * 40503u % POINTS;
    for (uint32_t i = 0; i < INSTANCES; i++)
        instances[i] = (struct zr_instance){0, zr_mat4_identity()};
    test.mesh.lines = lines;
    test.mesh.line_count = LINES;
    assert_ends_soon(&test.scene);
    test.mesh.line_count = 0;
    test.scene.instances = instances;
    test.scene.instance_count = INSTANCES;
    test.scene.view.pose = ZR_POSE_PRESET; /* fitted, for which all points are walked over */
    assert_ends_soon(&test.scene);
    zr_arena_free(&arena);
}

static void every_algorithm_stops_amid_large_triangles(void **state)
{
    enum { TRIANGLES = 20000 };
    (void)state;
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cutting_of_many_large_faces_stops),
        cmocka_unit_test(drawing_of_many_lines_and_walking_over_many_points_stop),
        cmocka_unit_test(every_algorithm_stops_amid_large_triangles),
    };
    return cmocka_run_group_tests_name("cancel", tests, NULL, NULL);
}
