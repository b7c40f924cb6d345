/* A render that is cancelled while it works ends soon, in every step. */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "input/image_read.h"
#include "output/png.h"
#include "scene/looks.h"
#include "support/jpeg.h"
#include "support/random.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "support/tests.h"

/* RAISED_MS: well within the work of each case. LATE_MS: of this thread's processor time, so that other processes do
 * not count. */
#if IS_SANITIZED
enum { LATE_MS = 1000 };
#else
enum { LATE_MS = 50 };
#endif
enum { RAISED_MS = 30, SIDE = 4096 };

static struct zr_arena arena;

/* Raised by a thread of its own once the test's has worked for so long. */
struct later {
    struct zr_cancel cancel;
    atomic_bool given_up; /* the work ended before */
    clockid_t clock;      /* of the test's thread */
    double after_ms, raised_ms;
    pthread_t thread;
};

static double now_ms(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static void *raise_later(void *argument)
{
    struct later *later = argument;
    const double begin_ms = now_ms(later->clock);
    while (now_ms(later->clock) < begin_ms + later->after_ms && !atomic_load(&later->given_up))
        nanosleep(&(struct timespec){.tv_nsec = 100000}, NULL);
    atomic_store(&later->cancel.raised, true);
    later->raised_ms = now_ms(later->clock);
    return NULL;
}

static void begin(struct later *later, double after_ms)
{
    *later = (struct later){.after_ms = after_ms};
    assert_int_equal(pthread_getcpuclockid(pthread_self(), &later->clock), 0);
    assert_int_equal(pthread_create(&later->thread, NULL, raise_later, later), 0);
}

static void end(struct later *later)
{
    atomic_store(&later->given_up, true);
    pthread_join(later->thread, NULL);
}

static void assert_ended_soon(struct later *later, enum zr_status status)
{
    const double ended_ms = now_ms(later->clock);
    end(later);
    assert_int_equal(status, ZR_CANCELLED);
    if (ended_ms - later->raised_ms > LATE_MS)
        fail_msg("told to stop after %.0f ms, it took %.0f ms more", later->after_ms, ended_ms - later->raised_ms);
}

/* The scene must be one that takes far longer than RAISED_MS. */
static void assert_ends_soon(const struct zr_scene *scene)
{
    struct later later;
    struct zr_error error = {.count = 0};
    const struct zr_frame *frame;
    begin(&later, RAISED_MS);
    assert_ended_soon(&later, zr_render(&arena, NULL, scene, NULL, &later.cancel, &frame, &error));
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
    for (double share = 0.1; share < 0.7; share += 0.15) {
        static double took_ms;
        zr_arena_init(&arena, (size_t)1 << 31);
        scene_of_triangles(&test, WINDOW, WINDOW, corners, 1);
        struct zr_instance *instances = zr_arena_alloc(&arena, INSTANCES, sizeof *instances);
        for (uint32_t i = 0; i < INSTANCES; i++)
            instances[i] = (struct zr_instance){.object_to_world = zr_mat4_identity()};
        test.scene.instances = instances;
        test.scene.instance_count = INSTANCES;
        test.scene.views[0].outputs = outputs;
        test.scene.views[0].output_count = 2;
        if (took_ms == 0.0) {
            const double before = now_ms(CLOCK_THREAD_CPUTIME_ID);
            assert_int_equal(zr_render(&arena, NULL, &test.scene, NULL, NULL, &frame, &error), ZR_OK);
            assert_int_equal(zr_encode(&arena, NULL, &test.scene, frame, NULL, &answer, &error), ZR_OK);
            took_ms = now_ms(CLOCK_THREAD_CPUTIME_ID) - before;
            print_message("%d masks of %d pixels: %.0f ms\n", INSTANCES, WINDOW * WINDOW, took_ms);
        }
        struct later later;
        begin(&later, share * took_ms);
        enum zr_status status = zr_render(&arena, NULL, &test.scene, NULL, &later.cancel, &frame, &error);
        if (status == ZR_OK) status = zr_encode(&arena, NULL, &test.scene, frame, &later.cancel, &answer, &error);
        assert_ended_soon(&later, status);
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
    test.scene.picture = look->picture;
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
    const enum zr_status status = zr_render(&arena, NULL, &test.scene, NULL, &later.cancel, &frame, &error);
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
        test.scene.picture.side = cases[i].side;
        if (cases[i].edge_width > 0) test.scene.picture.edges.width = cases[i].edge_width;
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

/* `begin`, and then `unit` again and again, up to the size that a body may have. */
static void reading_stops(const char *begin_text, const char *unit)
{
    enum { SIZE = 60 << 20 };
    char *text = malloc(SIZE);
    const size_t length = strlen(unit), begin_length = strlen(begin_text);
    assert_non_null(text);
    memcpy(text, begin_text, begin_length);
    for (size_t i = begin_length; i < SIZE; i++)
        text[i] = unit[(i - begin_length) % length];
    const struct zr_limits limits = zr_limits_default();
    zr_arena_init(&arena, (size_t)3 << 30);
    for (int after_ms = 2; after_ms < 60; after_ms *= 5) {
        struct later later;
        const struct zr_scene *scene;
        struct zr_error error = {.count = 0};
        begin(&later, after_ms);
        const struct zr_request request = {
            .format = ZR_FORMAT_JSON, .bytes = text, .size = SIZE, .cancel = &later.cancel};
        assert_ended_soon(&later, zr_scene_read(&arena, NULL, &request, &limits, &scene, &error));
        zr_arena_reset(&arena, SIZE_MAX);
    }
    zr_arena_free(&arena);
    free(text);
}

TEST(reading_of_brackets_and_of_what_is_odd_stops)
{
    reading_stops("[", "[[]],");
    reading_stops("{\"x\":[", "[],");
    reading_stops("{\"polygons\":[", "[],");
    reading_stops("{\"polygons\":[", "{},");
    reading_stops("{\"polygons\":[{\"vertices\":[", "[],");
    reading_stops("{\"meshes\":[{\"faces\":[", "[{\"a\":[1]}],");
    reading_stops("{\"x\":\"", "\\u00e4");
    reading_stops("{\"polygons\":[", "{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]],\"material\":{\"x\":[[]]}},");
}

/* Each name matches the pattern except for its end, from many positions. */
TEST(comparison_of_patterns_with_names_stops)
{
    enum { NODES = 3000, NAME = 1000, ROOM = NODES * (NAME + 40) };
    static const char begin_text[] =
        "{\"meshes\":[{\"positions\":[[0,0,0],[1,0,0],[0,1,0]],\"faces\":[[0,1,2]]}],\"hide\":";
    char *text = malloc(ROOM), *at = text, name[NAME + 1];
    struct later later;
    struct zr_error error = {.count = 0};
    const struct zr_scene *scene;
    const struct zr_limits limits = zr_limits_default();
    assert_non_null(text);
    memset(name, 'a', NAME);
    name[NAME] = '\0';
    at += sprintf(at, "%s\"*%sb\",\"nodes\":[", begin_text, name + NAME / 2);
    for (int i = 0; i < NODES; i++)
        at += sprintf(at, "%s{\"mesh\":0,\"name\":\"%s\"}", i > 0 ? "," : "", name);
    at += sprintf(at, "]}");
    zr_arena_init(&arena, (size_t)1 << 30);
    begin(&later, 2 * RAISED_MS);
    const struct zr_request request = {
        .format = ZR_FORMAT_JSON, .bytes = text, .size = (size_t)(at - text), .cancel = &later.cancel};
    assert_ended_soon(&later, zr_scene_read(&arena, NULL, &request, &limits, &scene, &error));
    assert_int_equal(error.count, 1); /* there is no fault that no part has the name */
    zr_arena_free(&arena);
    free(text);
}

/* Indices of ten million triangles, before and behind their positions, which decides when they are checked. */
TEST(reading_of_large_arrays_stops)
{
    enum { ROWS = 10000000 };
    static const char *const texts[] = {
        "{\"meshes\":[{\"positions\":[[0,0,0],[1,0,0],[0,1,0]],\"faces\":{\"asset\":\"a\"}}]}",
        "{\"meshes\":[{\"faces\":{\"asset\":\"a\"},\"positions\":[[0,0,0],[1,0,0],[0,1,0]]}]}",
        "{\"meshes\":[{\"positions\":{\"asset\":\"a\"},\"faces\":[[0,1,2]],\"colors\":{\"asset\":\"a\"}}]}"};
    void *zeros = calloc(3 * (size_t)ROWS, 8);
    const struct zr_asset asset = {.name = "a", .array = {zeros, ZR_U8, 2, {ROWS, 3}}};
    const struct zr_limits limits = zr_limits_default();
    assert_non_null(zeros);
    zr_arena_init(&arena, (size_t)3 << 30);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        for (int after_ms = 2; after_ms <= 50; after_ms *= 5) {
            struct later later;
            const struct zr_scene *scene;
            struct zr_error error = {.count = 0};
            begin(&later, after_ms);
            const struct zr_request request = {.format = ZR_FORMAT_JSON,
                                               .bytes = texts[i],
                                               .size = strlen(texts[i]),
                                               .assets = &asset,
                                               .asset_count = 1,
                                               .cancel = &later.cancel};
            assert_ended_soon(&later, zr_scene_read(&arena, NULL, &request, &limits, &scene, &error));
            zr_arena_reset(&arena, 0);
        }
    zr_arena_free(&arena);
    free(zeros);
}

/* 3 GB of zeros; 1 GB where a sanitizer writes its notes on them first. */
TEST(touching_large_memory_stops)
{
    struct later later;
    zr_arena_init(&arena, (size_t)8 << 30);
    begin(&later, RAISED_MS);
    arena.cancel = &later.cancel;
    const void *zeros = zr_arena_zero(&arena, IS_SANITIZED ? 1 : 3, (size_t)1 << 30);
    assert_ended_soon(&later, zeros ? ZR_OK : ZR_CANCELLED);
    zr_arena_free(&arena);
}

static void decoding_stops(const void *bytes, size_t size, double after_ms)
{
    struct zr_arena images;
    struct zr_image image;
    struct zr_reason reason;
    struct later later;
    zr_arena_init(&images, (size_t)1 << 30);
    begin(&later, after_ms);
    images.cancel = &later.cancel;
    assert_ended_soon(&later, zr_image_read(&images, bytes, size, UINT64_MAX, &image, &reason));
    zr_arena_free(&images);
}

/* Of one colour: so small that a few bytes of them are many rows. */
TEST(decoding_of_large_pictures_stops)
{
    enum { WIDTH = 16384, HEIGHT = 4096 };
    static const struct jpeg_kind kinds[] = {
        {.colors = JPEG_GREY, .across = 1, .down = 1, .quality = 75},
        {.colors = JPEG_GREY, .across = 1, .down = 1, .is_progressive = true, .quality = 75}};
    zr_arena_init(&arena, (size_t)1 << 30);
    uint8_t *pixels = zr_arena_zero(&arena, (size_t)WIDTH * HEIGHT, 4);
    struct zr_buffer png = {.arena = &arena};
    assert_non_null(pixels);
    const struct zr_png picture = {.kind = ZR_PNG_RGBA, .width = WIDTH, .height = HEIGHT, .pixels = pixels};
    assert_int_equal(zr_png_write(&picture, NULL, NULL, &png), ZR_OK);
    decoding_stops(png.bytes, png.size, RAISED_MS);
    decoding_stops(png.bytes, png.size, 3 * RAISED_MS); /* amid rows, of which a few bytes are hundreds */
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        size_t size;
        uint8_t *jpeg = jpeg_memory_write(&kinds[i], pixels, WIDTH, HEIGHT, &size);
        assert_non_null(jpeg);
        decoding_stops(jpeg, size, RAISED_MS);
        free(jpeg);
    }
    zr_arena_free(&arena);
}

RUN_TESTS(NULL, NULL)
