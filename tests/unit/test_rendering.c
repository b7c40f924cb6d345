/* server/rendering.c: what a thread for small requests gives up, and what it answers. */
#include <stdio.h>
#include <string.h>

#include "rendering.h"
#include "server/assets.h"
#include "support/cmocka_all.h"

enum { ARENA_BYTES = 1 << 28, MESSAGE_SIZE = 512 };

#define POLYGONS "\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]"

/* What api_work would have; the store is new and empty, in a folder of its own. */
struct service {
    struct folder folder;
    struct config config;
    struct foresight foresight;
    struct api api;
};

static void service_open(struct service *service)
{
    char message[MESSAGE_SIZE];
    assert_int_equal(config_read(&service->config, 1, (char *[]){"", NULL}, message, sizeof message), CONFIG_SERVE);
    service->folder = folder_make();
    struct store *store = store_open(service->folder.path, service->config.assets_max_bytes, message, sizeof message);
    if (!store) fail_msg("%s", message);
    foresight_init(&service->foresight);
    api_init(&service->api, &service->config, NULL, &service->foresight, store);
}

static void service_close(struct service *service)
{
    store_close(service->api.store);
    foresight_free(&service->foresight);
    folder_remove(&service->folder);
}

/* By the thread for small requests. */
static enum api_next work(struct service *service, const char *scene, bool cancelled)
{
    struct api_request request = {.method = "POST", .path = "/v1/render", .small_only = true};
    request.render = (struct zr_request){.format = ZR_FORMAT_JSON, .bytes = scene, .size = strlen(scene)};
    struct zr_cancel cancel;
    struct api_times times = API_NO_TIMES;
    struct answer answer = {0};
    struct zr_arena arena;
    atomic_init(&cancel.raised, cancelled);
    zr_arena_init(&arena, ARENA_BYTES);
    enum api_next next = rendering_work(&service->api, &request, &arena, &cancel, &times, &answer);
    zr_arena_free(&arena);
    answer_free(&answer);
    return next;
}

/* Whether it is cancelled or not. */
static void expect(struct service *service, const char *scene, enum api_next want)
{
    for (int cancelled = 0; cancelled < 2; cancelled++)
        assert_int_equal(work(service, scene, cancelled), want);
}

static void expect_of_new_service(const char *scene, enum api_next want)
{
    struct service service;
    service_open(&service);
    expect(&service, scene, want);
    service_close(&service);
}

/* Being told to stop meanwhile makes no other answer of it: one that is about what was left out. */
static void request_for_a_large_asset_is_given_up_at_whatever_time_it_is_cancelled(void **state)
{
    (void)state;
    static char bytes[API_SMALL_BYTES + 1];
    char name[STORE_NAME_SIZE], scene[512];
    struct service service;
    service_open(&service);
    store_name(bytes, sizeof bytes, name);
    assert_int_equal(store_put(service.api.store, name, bytes, sizeof bytes), STORE_NEW);
    snprintf(scene, sizeof scene, "{\"base\":{\"color\":{\"asset\":\"sha256:%s\"}}," POLYGONS "}", name);
    expect(&service, scene, API_LARGE);
    service_close(&service);
}

static void request_of_much_work_is_given_up_at_whatever_time_it_is_cancelled(void **state)
{
    (void)state;
    expect_of_new_service("{\"window\":{\"width\":4000,\"height\":4000}," POLYGONS "}", API_LARGE);
}

static void small_request_is_answered(void **state)
{
    (void)state;
    expect_of_new_service("{\"window\":{\"width\":16,\"height\":16}," POLYGONS "}", API_ANSWERED);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(request_for_a_large_asset_is_given_up_at_whatever_time_it_is_cancelled),
        cmocka_unit_test(request_of_much_work_is_given_up_at_whatever_time_it_is_cancelled),
        cmocka_unit_test(small_request_is_answered),
    };
    return cmocka_run_group_tests_name("rendering", tests, NULL, NULL);
}
