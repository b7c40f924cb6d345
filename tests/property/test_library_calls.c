/* core/api: pictures, owners of memory, tables, threads, forks and cancels. */
#include <cjson/cJSON.h>
#include <dirent.h>
#include <pthread.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "format_rows.h"
#include "scene/encodings.h"
#include "support/renderer.h"
#include "support/tests.h"

/* ThreadSanitizer ends a child that starts threads, unless it is asked not to. */
const char *__tsan_default_options(void);
const char *__tsan_default_options(void)
{
    return "die_after_fork=0";
}

/* ---- pictures ---- */

TEST(alpha_is_that_of_the_background)
{
    static const char *const backgrounds[] = {"\"#ffffff80\"", "\"#fff\""};
    for (int i = 0; i < 2; i++) {
        char scene[200];
        snprintf(scene, sizeof scene, "{\"background\": %s, \"polygons\": [{\"vertices\": [[0,0,0],[1,0,0],[0,1,0]]}]}",
                 backgrounds[i]);
        zraster_picture *picture = picture_of(renderer, scene);
        assert_int_equal(zraster_picture_has_alpha(picture), i == 0);
        zraster_picture_free(picture);
    }
}

TEST(channels_lie_in_the_picture)
{
    zraster_picture *picture = picture_of(renderer, triangle);
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
    const struct zraster_bytes npy = bytes_of(picture, "depth");
    const size_t size = depth.shape[0] * depth.shape[1] * sizeof(float);
    assert_true(npy.size > size && memcmp((const char *)npy.data + npy.size - size, depth.data, size) == 0);
    assert_string_equal(npy.type, "application/x-npy");
    assert_ptr_equal(bytes_of(picture, "depth.npy").data, npy.data);
    assert_string_equal(bytes_of(picture, NULL).type, "application/zip");
    assert_string_equal(bytes_of(picture, "color").type, "image/png");
    assert_string_equal(zraster_picture_look(picture), "studio@1");
    assert_null(zraster_picture_warning(picture, 0));
    zraster_error *error;
    struct zraster_bytes bytes;
    assert_int_equal(zraster_picture_encode(picture, "normals", &bytes, &error), ZRASTER_BAD_REQUEST);
    assert_null(bytes.data);
    zraster_error_free(error);
    zraster_picture_free(picture);
}

/* ---- several views ---- */

static const char turned[] = "{\"window\": {\"width\": 40, \"height\": 30}, \"orbit\": {\"count\": 5}, \"outputs\": "
                             "[{\"channel\": \"color\"}, {\"channel\": \"depth\", \"encoding\": \"png16\"}], "
                             "\"polygons\": [{\"vertices\": [[0,0,0],[1,0,0],[0,1,0.5]], \"doubleSided\": true}]}";

struct taken {
    zraster_picture *picture; /* of all views together */
    uint32_t views, most;
};

/* Compares the files of a view with those of the picture. */
static int take_view(void *context, const struct zraster_view *view)
{
    struct taken *taken = context;
    assert_true(view->struct_size == sizeof *view && view->count == 5 && view->file_count == 2);
    assert_int_equal(view->number, taken->views++);
    assert_int_equal(view->warning_count, 0);
    for (size_t i = 0; i < view->file_count; i++) {
        const struct zraster_file *file = &view->files[i];
        const struct zraster_bytes whole = bytes_of(taken->picture, file->name);
        assert_string_equal(file->type, "image/png");
        assert_int_equal(file->size, whole.size);
        assert_memory_equal(file->data, whole.data, whole.size);
    }
    return taken->views == taken->most;
}

TEST(views_come_one_by_one)
{
    struct taken taken = {.picture = picture_of(renderer, turned), .most = 99};
    struct zraster_request request = {.struct_size = sizeof request, .body = turned, .body_size = strlen(turned)};
    zraster_error *error;
    assert_int_equal(zraster_draw_views(renderer, &request, take_view, &taken, &error), ZRASTER_OK);
    assert_null(error);
    assert_int_equal(taken.views, 5);
    taken.views = 0;
    taken.most = 2;
    assert_int_equal(zraster_draw_views(renderer, &request, take_view, &taken, NULL), ZRASTER_CANCELLED);
    assert_int_equal(taken.views, 2);
    zraster_picture_free(taken.picture);
}

TEST(one_view_and_sheets_do_not_come_one_by_one)
{
    static const struct {
        const char *keys, *says;
    } cases[] = {{"", "one view; give views"}, {"\"sheet\": \"balanced\", ", "/sheet: one picture of all views"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char scene[200];
        zraster_error *error;
        snprintf(scene, sizeof scene, "{%s\"polygons\": [{\"vertices\": [[0,0,0],[1,0,0],[0,1,0]]}]}", cases[i].keys);
        struct zraster_request request = {.struct_size = sizeof request, .body = scene, .body_size = strlen(scene)};
        assert_int_equal(zraster_draw_views(renderer, &request, take_view, NULL, &error), ZRASTER_BAD_SCENE);
        assert_non_null(strstr(zraster_error_text(error), cases[i].says));
        zraster_error_free(error);
    }
}

/* Drawing it takes 39 MB. */
TEST(a_picture_holds_its_channels_and_not_its_drawing)
{
    static const char studio[] = "{\"window\": {\"width\": 512, \"height\": 512}, \"look\": \"studio\", "
                                 "\"meshes\": [{\"positions\": [[0,0,0],[1,0,0],[0,1,0]], \"faces\": [[0,1,2]]}]}";
    for (int i = 0; i < 3; i++) {
        zraster_picture *picture = picture_of(renderer, studio);
        bytes_of(picture, NULL);
        assert_in_range(zraster_picture_memory(picture), 512 * 512 * 4, 6 << 20);
        zraster_picture_free(picture);
    }
}

TEST(scene_and_renderer_may_be_freed_before_their_pictures)
{
    const struct zraster_request request = request_of(triangle);
    zraster *own;
    zraster_scene *scene;
    zraster_picture *picture, *other = picture_of(renderer, triangle);
    assert_int_equal(zraster_open(NULL, &own), ZRASTER_OK);
    assert_int_equal(zraster_scene_read(own, &request, &scene, NULL), ZRASTER_OK);
    zraster_close(own);
    assert_int_equal(zraster_scene_draw(scene, NULL, &picture, NULL), ZRASTER_OK);
    zraster_scene_free(scene);
    assert_true(is_same_bytes(bytes_of(picture, NULL), bytes_of(other, NULL)));
    zraster_picture_free(picture);
    zraster_picture_free(other);
}

TEST(nothing_is_freed_without_harm)
{
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

TEST(tables_list_all_parameters_and_looks)
{
    const char *tables = zraster_tables(renderer);
    cJSON *all = cJSON_Parse(tables);
    assert_non_null(all);
    assert_ptr_equal(zraster_tables(renderer), tables);
    assert_true(cJSON_GetArraySize(cJSON_GetObjectItem(all, "parameters")) > 40);
    assert_true(cJSON_GetArraySize(cJSON_GetObjectItem(all, "keys")) >= 28);
    assert_non_null(strstr(tables, "{\"name\":\"lights\",\"help\":\"list of lights\"}"));
    assert_true(cJSON_GetArraySize(cJSON_GetObjectItem(all, "channels")) >= 15);
#define ONE(...) +1
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(all, "formats")), 0 ZR_FORMAT_ROWS(ONE));
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(all, "encodings")), ZR_ENCODING_COUNT);
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
        thread->wrong += !is_same_bytes(bytes, thread->wanted);
        zraster_picture_free(picture);
        if (i == 1) zraster_trim(renderer);
    }
    return NULL;
}

TEST(threads_share_a_renderer_and_a_scene)
{
    const struct zraster_request request = request_of(triangle);
    zraster_picture *picture = picture_of(renderer, triangle);
    zraster_scene *scene;
    pthread_t threads[THREADS];
    struct thread contexts[THREADS];
    assert_int_equal(zraster_scene_read(renderer, &request, &scene, NULL), ZRASTER_OK);
    for (int i = 0; i < THREADS; i++) {
        contexts[i] = (struct thread){scene, bytes_of(picture, NULL), 0};
        assert_int_equal(pthread_create(&threads[i], NULL, draw_often, &contexts[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
        assert_int_equal(contexts[i].wrong, 0);
    }
    zraster_scene_free(scene);
    zraster_picture_free(picture);
}

TEST(a_child_process_draws_with_its_own_threads)
{
    const struct zraster_request request = request_of(triangle);
    zraster_picture *picture = picture_of(renderer, triangle); /* starts its threads */
    zraster_scene *scene;
    assert_int_equal(zraster_scene_read(renderer, &request, &scene, NULL), ZRASTER_OK);
    const struct zraster_bytes wanted = bytes_of(picture, NULL);
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

/* Returns the blocked signals of a thread, bit i - 1 for signal i. */
static unsigned long long blocked_in(const char *thread)
{
    char path[300], line[200];
    unsigned long long blocked = 0;
    snprintf(path, sizeof path, "/proc/self/task/%s/status", thread);
    FILE *file = fopen(path, "r");
    while (file && fgets(line, sizeof line, file))
        if (sscanf(line, "SigBlk: %llx", &blocked) == 1) break;
    if (file) fclose(file);
    return blocked;
}

/* A blocked fault would end the process without the handler of the program. */
TEST(threads_block_signals_but_those_of_faults)
{
    const unsigned long long faults = 1ULL << (SIGBUS - 1) | 1ULL << (SIGSEGV - 1) | 1ULL << (SIGFPE - 1),
                             others = 1ULL << (SIGINT - 1) | 1ULL << (SIGTERM - 1);
    const struct zraster_options options = {.struct_size = sizeof options, .threads = 4};
    zraster *own;
    int helpers = 0;
    assert_int_equal(zraster_open(&options, &own), ZRASTER_OK);
    zraster_picture_free(picture_of(own, triangle));
    DIR *threads = opendir("/proc/self/task");
    assert_non_null(threads);
    for (const struct dirent *thread; (thread = readdir(threads)) != NULL;) {
        const unsigned long long blocked = blocked_in(thread->d_name);
        helpers += (blocked & others) == others && (blocked & faults) == 0;
    }
    closedir(threads);
    zraster_close(own);
    assert_true(helpers >= 3);
}

TEST(a_signal_handler_may_cancel)
{
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

/* ---- progress ---- */

struct seen {
    uint32_t calls, until; /* 0: never cancelled */
    pthread_t thread;
    zraster_cancel *cancel;
};

static void see(void *context, uint32_t done, uint32_t total)
{
    struct seen *seen = context;
    assert_int_equal(done, ++seen->calls);
    assert_int_equal(total, 5);
    assert_true(pthread_equal(pthread_self(), seen->thread));
    if (done == seen->until) zraster_cancel_raise(seen->cancel);
}

TEST(progress_counts_views_and_may_cancel)
{
    static const char several[] = "{\"window\": {\"width\": 20, \"height\": 10}, \"turntable\": {\"frames\": 5}, "
                                  "\"polygons\": [{\"vertices\": [[0,0,0],[1,0,0],[0,1,0]]}]}";
    for (uint32_t until = 0; until <= 2; until += 2) {
        struct seen seen = {.until = until, .thread = pthread_self(), .cancel = zraster_cancel_new()};
        struct zraster_request request = request_of(several);
        zraster_picture *picture;
        request.progress = see;
        request.progress_context = &seen;
        request.cancel = seen.cancel;
        const zraster_status status = zraster_draw(renderer, &request, &picture, NULL);
        assert_int_equal(status, until ? ZRASTER_CANCELLED : ZRASTER_OK);
        assert_in_range(seen.calls, until ? until : 5, until ? 4 : 5); /* views that are drawn at once */
        zraster_picture_free(picture);
        zraster_cancel_free(seen.cancel);
    }
}

RUN_TESTS(open_renderer, close_renderer)
