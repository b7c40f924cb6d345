/* core/library: threads, forks, cancels, errors, sizes of structs, locales, and memory. */
#include <cjson/cJSON.h>
#include <locale.h>
#include <pthread.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "library/zraster.h"
#include "support/cmocka_all.h"

static const char triangle[] =
    "{\"window\": {\"width\": 200, \"height\": 150}, \"samples\": 4, \"look\": \"studio\", "
    "\"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"depth\"}, {\"channel\": \"info\"}], "
    "\"nodes\": [{\"name\": \"n\", \"mesh\": 0}], "
    "\"meshes\": [{\"positions\": [[0,0,0],[1,0.25,0],[0,1,0.5]], \"faces\": [[0,1,2]]}]}";

/* ThreadSanitizer ends a child that starts threads, unless it is asked not to. */
const char *__tsan_default_options(void);
const char *__tsan_default_options(void)
{
    return "die_after_fork=0";
}

static zraster *renderer;

static struct zraster_request request_of(const char *text)
{
    return (struct zraster_request){
        .struct_size = sizeof(struct zraster_request), .body = text, .body_size = strlen(text)};
}

static zraster_picture *draw(zraster *by, const char *text)
{
    const struct zraster_request request = request_of(text);
    zraster_picture *picture;
    zraster_error *error;
    if (zraster_draw(by, &request, &picture, &error) != ZRASTER_OK) fail_msg("%s", zraster_error_text(error));
    assert_null(error);
    return picture;
}

static struct zraster_bytes encode(zraster_picture *picture, const char *channel)
{
    struct zraster_bytes bytes;
    assert_int_equal(zraster_picture_encode(picture, channel, &bytes, NULL), ZRASTER_OK);
    return bytes;
}

static bool is_same(struct zraster_bytes a, struct zraster_bytes b)
{
    return a.size == b.size && memcmp(a.data, b.data, a.size) == 0;
}

/* ---- pictures ---- */

static void alpha_is_that_of_the_background(void **state)
{
    (void)state;
    static const char *const backgrounds[] = {"\"#ffffff80\"", "\"#fff\""};
    for (int i = 0; i < 2; i++) {
        char scene[200];
        snprintf(scene, sizeof scene, "{\"background\": %s, \"polygons\": [{\"vertices\": [[0,0,0],[1,0,0],[0,1,0]]}]}",
                 backgrounds[i]);
        zraster_picture *picture = draw(renderer, scene);
        assert_int_equal(zraster_picture_has_alpha(picture), i == 0);
        zraster_picture_free(picture);
    }
}

static void channels_lie_in_the_picture(void **state)
{
    (void)state;
    zraster_picture *picture = draw(renderer, triangle);
    struct zraster_array color, depth, none;
    assert_int_equal(zraster_picture_channel(picture, "color", &color), 1);
    assert_int_equal(zraster_picture_channel(picture, "depth", &depth), 1);
    assert_int_equal(zraster_picture_channel(picture, "info", &none), 0);
    assert_int_equal(zraster_picture_channel(picture, "faceId", &none), 0); /* drawn for info, and no output */
    assert_int_equal(zraster_picture_channel(picture, "nothing", &none), 0);
    assert_null(none.data);
    assert_true(color.type == ZRASTER_U1 && color.ndim == 3 && color.shape[0] == 150 && color.shape[1] == 200 &&
                color.shape[2] == 4);
    assert_true(depth.type == ZRASTER_F4 && depth.ndim == 2 && depth.shape[0] == 150 && depth.shape[1] == 200);
    const struct zraster_bytes npy = encode(picture, "depth");
    const size_t size = depth.shape[0] * depth.shape[1] * sizeof(float);
    assert_true(npy.size > size && memcmp((const char *)npy.data + npy.size - size, depth.data, size) == 0);
    assert_string_equal(npy.type, "application/x-npy");
    assert_ptr_equal(encode(picture, "depth.npy").data, npy.data);
    assert_string_equal(encode(picture, NULL).type, "application/zip");
    assert_string_equal(encode(picture, "color").type, "image/png");
    assert_string_equal(zraster_picture_look(picture), "studio@1");
    assert_null(zraster_picture_warning(picture, 0));
    zraster_error *error;
    struct zraster_bytes bytes;
    assert_int_equal(zraster_picture_encode(picture, "normals", &bytes, &error), ZRASTER_BAD_REQUEST);
    assert_null(bytes.data);
    zraster_error_free(error);
    zraster_picture_free(picture);
}

/* Drawing it takes 39 MB. */
static void a_picture_holds_its_channels_and_not_its_drawing(void **state)
{
    (void)state;
    static const char studio[] = "{\"window\": {\"width\": 512, \"height\": 512}, \"look\": \"studio\", "
                                 "\"meshes\": [{\"positions\": [[0,0,0],[1,0,0],[0,1,0]], \"faces\": [[0,1,2]]}]}";
    for (int i = 0; i < 3; i++) {
        zraster_picture *picture = draw(renderer, studio);
        encode(picture, NULL);
        assert_in_range(zraster_picture_memory(picture), 512 * 512 * 4, 6 << 20);
        zraster_picture_free(picture);
    }
}

static void scene_and_renderer_may_be_freed_before_their_pictures(void **state)
{
    (void)state;
    const struct zraster_request request = request_of(triangle);
    zraster *own;
    zraster_scene *scene;
    zraster_picture *picture, *other = draw(renderer, triangle);
    assert_int_equal(zraster_open(NULL, &own), ZRASTER_OK);
    assert_int_equal(zraster_scene_read(own, &request, &scene, NULL), ZRASTER_OK);
    zraster_close(own);
    assert_int_equal(zraster_scene_draw(scene, NULL, &picture, NULL), ZRASTER_OK);
    zraster_scene_free(scene);
    assert_true(is_same(encode(picture, NULL), encode(other, NULL)));
    zraster_picture_free(picture);
    zraster_picture_free(other);
}

static void nothing_is_freed_without_harm(void **state)
{
    (void)state;
    zraster_close(NULL);
    zraster_trim(NULL);
    zraster_scene_free(NULL);
    zraster_picture_free(NULL);
    zraster_error_free(NULL);
    zraster_cancel_free(NULL);
    zraster_cancel_raise(NULL);
    assert_string_equal(zraster_error_text(NULL), "");
    assert_string_equal(zraster_version(), ZRASTER_VERSION);
    assert_true(zraster_rules() > 0);
}

static void tables_list_all_parameters_and_looks(void **state)
{
    (void)state;
    const char *tables = zraster_tables(renderer);
    cJSON *all = cJSON_Parse(tables);
    assert_non_null(all);
    assert_ptr_equal(zraster_tables(renderer), tables);
    assert_true(cJSON_GetArraySize(cJSON_GetObjectItem(all, "parameters")) > 40);
    assert_true(cJSON_GetArraySize(cJSON_GetObjectItem(all, "keys")) >= 28);
    assert_non_null(strstr(tables, "{\"name\":\"lights\",\"help\":\"list of lights\"}"));
    assert_null(strstr(tables, "turntable")); /* reserved */
    assert_true(cJSON_GetArraySize(cJSON_GetObjectItem(all, "channels")) >= 15);
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(all, "formats")), 3);
    assert_non_null(strstr(tables, "\"looks\":["));
    assert_non_null(strstr(tables, "\"studio@1\""));
    assert_non_null(strstr(tables, "\"windowSideMax\":8192"));
    cJSON_Delete(all);
}

/* ---- threads and processes ---- */

enum { THREADS = 8, DRAWINGS = 4 };

struct thread {
    const zraster_scene *scene;
    struct zraster_bytes wanted;
    int wrong;
};

static void *draw_often(void *context)
{
    struct thread *thread = context;
    for (int i = 0; i < DRAWINGS; i++) {
        const struct zraster_request request = request_of(triangle), change = request_of("{\"samples\": 4}");
        zraster_picture *picture;
        struct zraster_bytes bytes = {.data = NULL};
        const zraster_status status = i % 2 ? zraster_draw(renderer, &request, &picture, NULL)
                                            : zraster_scene_draw(thread->scene, &change, &picture, NULL);
        if (status == ZRASTER_OK) zraster_picture_encode(picture, NULL, &bytes, NULL);
        thread->wrong += !is_same(bytes, thread->wanted);
        zraster_picture_free(picture);
        if (i == 1) zraster_trim(renderer);
    }
    return NULL;
}

static void threads_share_a_renderer_and_a_scene(void **state)
{
    (void)state;
    const struct zraster_request request = request_of(triangle);
    zraster_picture *picture = draw(renderer, triangle);
    zraster_scene *scene;
    pthread_t threads[THREADS];
    struct thread contexts[THREADS];
    assert_int_equal(zraster_scene_read(renderer, &request, &scene, NULL), ZRASTER_OK);
    for (int i = 0; i < THREADS; i++) {
        contexts[i] = (struct thread){scene, encode(picture, NULL), 0};
        assert_int_equal(pthread_create(&threads[i], NULL, draw_often, &contexts[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        assert_int_equal(contexts[i].wrong, 0);
    }
    zraster_scene_free(scene);
    zraster_picture_free(picture);
}

static void a_child_process_draws_with_its_own_threads(void **state)
{
    (void)state;
    const struct zraster_request request = request_of(triangle);
    zraster_picture *picture = draw(renderer, triangle); /* its threads are there */
    zraster_scene *scene;
    assert_int_equal(zraster_scene_read(renderer, &request, &scene, NULL), ZRASTER_OK);
    const struct zraster_bytes wanted = encode(picture, NULL);
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        alarm(60);
        struct thread thread = {scene, wanted, 0};
        draw_often(&thread);
        _exit(thread.wrong);
    }
    int status = -1;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    zraster_scene_free(scene);
    zraster_picture_free(picture);
}

/* ---- cancels ---- */

static zraster_cancel *raised_by_signal;

static void raise_cancel(int number)
{
    (void)number;
    zraster_cancel_raise(raised_by_signal);
}

static void a_signal_handler_may_cancel(void **state)
{
    (void)state;
    struct zraster_request request = request_of(triangle);
    zraster_picture *picture;
    zraster_error *error;
    struct zraster_bytes bytes;
    request.cancel = raised_by_signal = zraster_cancel_new();
    assert_int_equal(zraster_draw(renderer, &request, &picture, NULL), ZRASTER_OK);
    struct sigaction action = {.sa_handler = raise_cancel}, before;
    sigaction(SIGUSR1, &action, &before);
    raise(SIGUSR1);
    sigaction(SIGUSR1, &before, NULL);
    zraster_picture *none;
    assert_int_equal(zraster_draw(renderer, &request, &none, &error), ZRASTER_CANCELLED);
    assert_null(none);
    assert_true(zraster_error_count(error) == 1);
    zraster_error_free(error);
    zraster_cancel_free(request.cancel); /* the picture keeps it */
    assert_int_equal(zraster_picture_encode(picture, NULL, &bytes, NULL), ZRASTER_CANCELLED);
    zraster_picture_free(picture);
}

/* ---- errors and structs ---- */

static void refuse(const struct zraster_request *request, zraster_status wanted, const char *pointer,
                   const char *detail)
{
    zraster_picture *picture;
    zraster_error *error;
    assert_int_equal(zraster_draw(renderer, request, &picture, &error), wanted);
    assert_null(picture);
    assert_string_equal(zraster_error_pointer(error, 0), pointer);
    if (!strstr(zraster_error_detail(error, 0), detail)) fail_msg("%s", zraster_error_text(error));
    assert_string_equal(zraster_error_pointer(error, 99), "");
    zraster_error_free(error);
    assert_int_equal(zraster_draw(renderer, request, &picture, NULL), wanted);
}

static void errors_have_a_place_and_a_reason(void **state)
{
    (void)state;
    struct zraster_request request =
        request_of("{\"meshes\": [{\"positions\": [[0,0,0]], \"faces\": [[0,0,7]]}], \"samples\": 3}");
    refuse(&request, ZRASTER_BAD_SCENE, "/meshes/0/faces/0/2", "index 7 of 1");
    zraster_picture *picture;
    zraster_error *error;
    zraster_draw(renderer, &request, &picture, &error);
    assert_int_equal(zraster_error_count(error), 2);
    assert_non_null(strstr(zraster_error_text(error), "\n/samples: 3; 1, 4"));
    zraster_error_free(error);
    request = request_of("{\"a\": ");
    refuse(&request, ZRASTER_BAD_SYNTAX, "", "line 1");
    request = request_of("what is it");
    refuse(&request, ZRASTER_BAD_TYPE, "", "no type is given");
    request.body_size = 0;
    refuse(&request, ZRASTER_BAD_SYNTAX, "", "the body is empty");
    request.type = "model/step";
    refuse(&request, ZRASTER_BAD_TYPE, "", "'model/step' is none of: application/json");
    request = request_of(triangle);
    request.query = "chanel=depth";
    refuse(&request, ZRASTER_BAD_REQUEST, "", "unknown parameter 'chanel' (did you mean channel?)");
    request.query = "channel=%4";
    refuse(&request, ZRASTER_BAD_REQUEST, "", "%-escape");
    request.query = "strict=perhaps";
    refuse(&request, ZRASTER_BAD_REQUEST, "", "parameter strict: 'perhaps' is unknown");
    static const struct {
        struct zraster_array array;
        uint32_t flags;
        const char *why;
    } parts[] = {
        {{"x", 8, 1, {1}}, 0, "its type is unknown"},
        {{"x", ZRASTER_F4, 0, {1}}, 0, "its ndim is not 1 to 4"},
        {{"x", ZRASTER_F4, 5, {1}}, 0, "its ndim is not 1 to 4"},
        {{"x", ZRASTER_BYTES, 2, {1, 1}}, 0, "bytes need ndim 1"},
        {{"x", ZRASTER_U8, 2, {SIZE_MAX / 2, 3}}, 0, "its shape is too large"},
        {{NULL, ZRASTER_U1, 1, {1}}, 0, "its data is NULL"},
        {{"x", ZRASTER_U1, 1, {1}}, 2, "unknown flags"},
    };
    request = request_of(triangle);
    request.part_count = 1;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        const struct zraster_part part = {.name = "p", .array = parts[i].array, .flags = parts[i].flags};
        request.parts = &part;
        refuse(&request, ZRASTER_BAD_REQUEST, "", parts[i].why);
    }
    const struct zraster_part numbers = {.name = "p", .array = {"abcd", ZRASTER_F4, 1, {1}}};
    request = request_of("{\"base\": {\"windowDepth\": {\"asset\": \"p\"}}, \"view\": {\"znear\": 1, \"zfar\": 9}, "
                         "\"polygons\": [{\"vertices\": [[0,0,0],[1,0,0],[0,1,0]]}]}");
    request.parts = &numbers;
    request.part_count = 1;
    refuse(&request, ZRASTER_BAD_SCENE, "/base/windowDepth/asset",
           "the part 'p' is an array of f4; the bytes of a file are needed");
    refuse(NULL, ZRASTER_BAD_REQUEST, "", "NULL");
}

static void memory_has_a_ceiling(void **state)
{
    (void)state;
    const struct zraster_options options = {.struct_size = sizeof options, .memory_max = 1 << 20, .threads = 1};
    const struct zraster_request request = request_of(triangle);
    zraster *small;
    zraster_picture *picture;
    zraster_error *error;
    assert_int_equal(zraster_open(&options, &small), ZRASTER_OK);
    assert_int_equal(zraster_draw(small, &request, &picture, &error), ZRASTER_NO_MEMORY);
    assert_non_null(strstr(zraster_error_text(error), "1048576 bytes"));
    zraster_error_free(error);
    zraster_close(small);
}

static void structs_of_other_versions_are_taken(void **state)
{
    (void)state;
    struct {
        struct zraster_request request;
        void *later;
    } newer = {.request = request_of(triangle)};
    zraster_picture *picture, *wanted = draw(renderer, triangle);
    newer.request.struct_size = sizeof newer;
    assert_int_equal(zraster_draw(renderer, &newer.request, &picture, NULL), ZRASTER_OK);
    zraster_picture_free(picture);
    newer.later = &newer;
    refuse(&newer.request, ZRASTER_BAD_REQUEST, "", "a member that this version of zraster lacks");
    struct zraster_request older = request_of(triangle);
    older.struct_size = offsetof(struct zraster_request, query);
    older.query = "chanel"; /* behind its end */
    assert_int_equal(zraster_draw(renderer, &older, &picture, NULL), ZRASTER_OK);
    assert_true(is_same(encode(picture, NULL), encode(wanted, NULL)));
    zraster_picture_free(picture);
    zraster_picture_free(wanted);
    older.struct_size = 0;
    refuse(&older, ZRASTER_BAD_REQUEST, "", "struct_size of zraster_request is 0");
    struct zraster_options options = {.struct_size = 0};
    zraster *none;
    assert_int_equal(zraster_open(&options, &none), ZRASTER_BAD_REQUEST);
    assert_null(none);
    options.struct_size = offsetof(struct zraster_options, memory_keep);
    assert_int_equal(zraster_open(&options, &none), ZRASTER_OK);
    zraster_close(none);
}

/* ---- locale ---- */

/* Needs localedef of libc-bin; a locale whose decimal separator is a comma. */
static void numbers_have_a_point_in_every_locale(void **state)
{
    (void)state;
    char folder[] = "/tmp/zraster-locale-XXXXXX", command[400];
    assert_non_null(mkdtemp(folder));
    snprintf(
        command, sizeof command,
        "cd %s && printf 'LC_NUMERIC\\ndecimal_point \",\"\\nthousands_sep \"\"\\ngrouping -1\\nEND LC_NUMERIC\\n' >in "
        "&& localedef -c -i in -f ANSI_X3.4-1968 ./comma >/dev/null 2>&1; test -s comma/LC_NUMERIC",
        folder);
    assert_int_equal(system(command), 0);
    zraster_picture *wanted = draw(renderer, triangle);
    const struct zraster_bytes info = encode(wanted, "info");
    setenv("LOCPATH", folder, 1);
    assert_non_null(setlocale(LC_NUMERIC, "comma"));
    char half[8];
    snprintf(half, sizeof half, "%.1f", 0.5);
    assert_string_equal(half, "0,5");
    zraster_picture *picture = draw(renderer, triangle);
    assert_true(is_same(encode(picture, "info"), info));
    assert_true(is_same(encode(picture, NULL), encode(wanted, NULL)));
    struct zraster_request request = request_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    request.query = "azimuth=12.5&elevation=999";
    refuse(&request, ZRASTER_BAD_REQUEST, "", "from -90 to 90");
    request.query = "azimuth=12.5";
    zraster_picture *turned;
    assert_int_equal(zraster_draw(renderer, &request, &turned, NULL), ZRASTER_OK);
    snprintf(half, sizeof half, "%.1f", 0.5);
    assert_string_equal(half, "0,5"); /* as before */
    setlocale(LC_NUMERIC, "C");
    zraster_picture_free(turned);
    zraster_picture_free(picture);
    zraster_picture_free(wanted);
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
}

static int open_renderer(void **state)
{
    const struct zraster_options options = {.struct_size = sizeof options, .threads = 3};
    (void)state;
    return zraster_open(&options, &renderer) == ZRASTER_OK ? 0 : -1;
}

static int close_renderer(void **state)
{
    (void)state;
    zraster_close(renderer);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(alpha_is_that_of_the_background),
        cmocka_unit_test(channels_lie_in_the_picture),
        cmocka_unit_test(a_picture_holds_its_channels_and_not_its_drawing),
        cmocka_unit_test(scene_and_renderer_may_be_freed_before_their_pictures),
        cmocka_unit_test(nothing_is_freed_without_harm),
        cmocka_unit_test(tables_list_all_parameters_and_looks),
        cmocka_unit_test(threads_share_a_renderer_and_a_scene),
        cmocka_unit_test(a_child_process_draws_with_its_own_threads),
        cmocka_unit_test(a_signal_handler_may_cancel),
        cmocka_unit_test(errors_have_a_place_and_a_reason),
        cmocka_unit_test(memory_has_a_ceiling),
        cmocka_unit_test(structs_of_other_versions_are_taken),
        cmocka_unit_test(numbers_have_a_point_in_every_locale),
    };
    return cmocka_run_group_tests_name("library_calls", tests, open_renderer, close_renderer);
}
