/* server/routes/rendering.c: what a thread for small requests gives up, and what it answers. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zlib.h>

#include "routes/routes.h"
#include "server/support/assets.h"
#include "support/input/base64.h"
#include "support/tests.h"

enum { ARENA_BYTES = 1 << 28, MESSAGE_SIZE = 512 };

#define POLYGONS "\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]"

/* What the router would have; the store is new and empty, in a folder of its own. */
struct trial {
    struct folder folder;
    struct config config;
    struct service service;
    struct slowness slowness;
};

static void trial_open(struct trial *trial)
{
    char message[MESSAGE_SIZE];
    assert_int_equal(config_read(&trial->config, 1, (char *[]){"", NULL}, message, sizeof message), CONFIG_SERVE);
    trial->folder = folder_make();
    struct store *store = store_open(trial->folder.path, trial->config.assets_max_bytes, message, sizeof message);
    if (!store) fail_msg("%s", message);
    trial->slowness = (struct slowness){
        .mutex = PTHREAD_MUTEX_INITIALIZER, .known = PTHREAD_COND_INITIALIZER, .is_known = true, .value = 1.0};
    service_init(&trial->service, &trial->config, NULL, &trial->slowness);
    trial->service.store = store;
}

static void trial_close(struct trial *trial)
{
    store_close(trial->service.store);
    folder_remove(&trial->folder);
}

static struct request request_of(const char *method, const char *path, const void *bytes, size_t size)
{
    return (struct request){.method = method, .path = path, .body = bytes, .body_size = size, .small_only = true};
}

/* By the thread for small requests; `late`: it has taken too long for one. */
static enum request_next work_on(struct trial *trial, const struct request *request, bool cancelled, bool late,
                                 size_t *used)
{
    const struct zr_cancel overdue = {.raised = late};
    const struct zr_cancel cancel = {.raised = cancelled, .parent = &overdue};
    struct step_times times = NO_STEP_TIMES;
    struct answer answer = {0};
    struct zr_arena arena;
    zr_arena_init(&arena, ARENA_BYTES);
    const struct work work = {&trial->service, request, &arena, &cancel, &overdue, &times, &answer};
    const enum request_next next = (request->asset ? assets_work : rendering_work)(&work);
    if (used) *used = arena.peak;
    zr_arena_free(&arena);
    answer_free(&answer);
    return next;
}

static enum request_next work(struct trial *trial, const char *scene, bool cancelled)
{
    const struct request request = request_of("POST", "/v1/render", scene, strlen(scene));
    return work_on(trial, &request, cancelled, false, NULL);
}

/* Whether it is cancelled or not. */
static void expect(struct trial *trial, const char *scene, enum request_next want)
{
    for (int cancelled = 0; cancelled < 2; cancelled++)
        assert_int_equal(work(trial, scene, cancelled), want);
}

static void expect_of_new_service(const char *scene, enum request_next want)
{
    struct trial trial;
    trial_open(&trial);
    expect(&trial, scene, want);
    trial_close(&trial);
}

/* Being told to stop meanwhile makes no other answer of it: one that is about what was left out. */
TEST(request_for_a_large_asset_is_given_up_at_whatever_time_it_is_cancelled)
{
    static char bytes[REQUEST_SMALL_BYTES + 1];
    char name[STORE_NAME_SIZE], scene[512];
    struct trial trial;
    trial_open(&trial);
    store_name(bytes, sizeof bytes, name);
    assert_int_equal(store_put(trial.service.store, name, bytes, sizeof bytes), STORE_NEW);
    snprintf(scene, sizeof scene, "{\"base\":{\"color\":{\"asset\":\"sha256:%s\"}}," POLYGONS "}", name);
    expect(&trial, scene, REQUEST_LARGE);
    trial_close(&trial);
}

TEST(request_of_much_work_is_given_up_at_whatever_time_it_is_cancelled)
{
    expect_of_new_service("{\"window\":{\"width\":4000,\"height\":4000}," POLYGONS "}", REQUEST_LARGE);
}

/* 100 x 100 x 30 visits of nodes; a picture of 16 million texels, of which there is but the head; 65 faces for the
 * painter. None of them is read or drawn on the way. */
TEST(request_that_nothing_but_its_work_shows_to_be_large_is_given_up)
{
    enum { SIZE = 1 << 14, LINKS = 30 };
    static const unsigned char head[33] = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x10\0\0\0\x10\0\x08\x06";
    static char text[SIZE];
    int used =
        snprintf(text, SIZE, "{\"meshes\":[{\"positions\":[[0,0,0],[1,0,0],[0,1,0]],\"faces\":[[0,1,2]]}],\"nodes\":[");
    for (int k = 0; k < 2; k++)
        for (int i = 0; i <= 100; i++)
            used += snprintf(text + used, SIZE - (size_t)used,
                             i == 0    ? "{\"children\":[%d"
                             : i < 100 ? ",%d"
                                       : "]},",
                             k + 1);
    for (int k = 2; k < 2 + LINKS; k++)
        used += snprintf(text + used, SIZE - (size_t)used, "{\"children\":[%d]},", k + 1);
    snprintf(text + used, SIZE - (size_t)used, "{\"mesh\":0}]}");
    expect_of_new_service(text, REQUEST_LARGE);
    char *uri = base64_of("data:image/png;base64,", head, sizeof head);
    snprintf(text, SIZE, "{\"materials\":[{\"name\":\"m\",\"baseColorTexture\":{\"uri\":\"%s\"}}]," POLYGONS "}", uri);
    expect_of_new_service(text, REQUEST_LARGE);
    free(uri);
    used = snprintf(text, SIZE, "{\"algorithm\":\"painter\",\"window\":{\"width\":16,\"height\":16},\"polygons\":[");
    for (int i = 0; i < 65; i++)
        used +=
            snprintf(text + used, SIZE - (size_t)used, "%s{\"vertices\":[[0,0,%d],[1,0,0],[0,1,0]]}", i ? "," : "", i);
    snprintf(text + used, SIZE - (size_t)used, "]}");
    expect_of_new_service(text, REQUEST_LARGE);
}

/* Whatever it is about, and whether its client waits for it or not. */
TEST(request_that_has_taken_too_long_for_a_small_one_is_given_up)
{
    static const char scene[] = "{\"window\":{\"width\":16,\"height\":16}," POLYGONS "}";
    struct trial trial;
    trial_open(&trial);
    const struct request request = request_of("POST", "/v1/render", scene, sizeof scene - 1);
    for (int cancelled = 0; cancelled < 2; cancelled++)
        assert_int_equal(work_on(&trial, &request, cancelled, true, NULL), REQUEST_LARGE);
    trial_close(&trial);
}

/* The compressed body may be as small as it likes: it is not inflated to its end. */
TEST(request_that_inflates_to_more_is_given_up_on_the_way)
{
    enum { INFLATED = 32 << 20 };
    static const char *const paths[] = {"/v1/render", "/v1/assets"};
    unsigned char *spaces = malloc(INFLATED), *packed = malloc(INFLATED);
    assert_true(spaces && packed);
    memset(spaces, ' ', INFLATED);
    z_stream stream = {.next_in = spaces, .avail_in = INFLATED, .next_out = packed, .avail_out = INFLATED};
    assert_int_equal(deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
    assert_int_equal(deflate(&stream, Z_FINISH), Z_STREAM_END);
    struct trial trial;
    trial_open(&trial);
    for (int i = 0; i < 2; i++) {
        struct request request = request_of("POST", paths[i], packed, stream.total_out);
        size_t used;
        request.gzip = true;
        request.asset = i == 1 ? "" : NULL;
        assert_true(request.body_size < REQUEST_SMALL_BYTES);
        assert_int_equal(work_on(&trial, &request, false, false, &used), REQUEST_LARGE);
        assert_true(used < 4 * REQUEST_SMALL_BYTES);
    }
    trial_close(&trial);
    deflateEnd(&stream);
    free(spaces);
    free(packed);
}

TEST(large_asset_is_not_fetched_and_a_small_one_is)
{
    static char bytes[REQUEST_SMALL_BYTES + 1];
    struct trial trial;
    trial_open(&trial);
    for (int large = 0; large < 2; large++) {
        char name[STORE_NAME_SIZE];
        size_t size = REQUEST_SMALL_BYTES + (size_t)large, used;
        store_name(bytes, size, name);
        assert_int_equal(store_put(trial.service.store, name, bytes, size), STORE_NEW);
        struct request request = request_of("GET", "", NULL, 0);
        request.asset = name;
        assert_int_equal(work_on(&trial, &request, false, false, &used), large ? REQUEST_LARGE : REQUEST_ANSWERED);
        assert_true(!large || used == 0);
        request.method = "HEAD";
        assert_int_equal(work_on(&trial, &request, false, false, NULL), REQUEST_ANSWERED);
        request.method = "GET";
        request.has_asset = true;
        assert_int_equal(work_on(&trial, &request, false, false, NULL), REQUEST_ANSWERED);
    }
    trial_close(&trial);
}

TEST(small_request_is_answered)
{
    expect_of_new_service("{\"window\":{\"width\":16,\"height\":16}," POLYGONS "}", REQUEST_ANSWERED);
}

RUN_TESTS(NULL, NULL)
