/* Arrays of a caller that writes to them while the library reads them. ThreadSanitizer reports this race, so .ci/run
 * does not run this program with it. */
#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>

#include "support/random.h"
#include "support/renderer.h"
#include "support/tests.h"

enum { SHARED = 3 << 17 };
static _Atomic uint32_t shared[SHARED];
static atomic_bool is_done;

static void *write_meanwhile(void *context)
{
    struct random random = random_seeded(7);
    (void)context;
    while (!atomic_load(&is_done)) {
        _Atomic uint32_t *place = &shared[random_below(&random, SHARED)];
        atomic_store_explicit(place, UINT32_MAX, memory_order_relaxed);
        atomic_store_explicit(place, 1, memory_order_relaxed);
    }
    return NULL;
}

TEST(indices_that_change_do_no_harm)
{
    static const char text[] = "{\"window\": {\"width\": 9, \"height\": 9}, \"meshes\": [{\"positions\": "
                               "[[0,0,0],[1,0,0],[0,1,0]], \"faces\": {\"asset\": \"f\"}}]}";
    const struct zraster_part part = {.name = "f",
                                      .array = {(const void *)(uintptr_t)shared, ZRASTER_U4, 2, {SHARED / 3, 3}}};
    struct zraster_request request = request_of(text);
    pthread_t writer;
    int drawn = 0;
    request.parts = &part;
    request.part_count = 1;
    for (size_t i = 0; i < SHARED; i++)
        shared[i] = (uint32_t)(i % 3);
    assert_int_equal(pthread_create(&writer, NULL, write_meanwhile, NULL), 0);
    for (int i = 0; i < 40; i++) {
        zraster_picture *picture = NULL;
        zraster_scene *scene = NULL;
        zraster_error *error = NULL;
        zraster_status status = i % 2 ? zraster_draw(renderer, &request, &picture, &error)
                                      : zraster_scene_read(renderer, &request, &scene, &error);
        if (status != ZRASTER_OK) assert_int_equal(status, ZRASTER_BAD_SCENE);
        zraster_error_free(error);
        if (scene) assert_int_equal(zraster_scene_draw(scene, NULL, &picture, NULL), ZRASTER_OK);
        drawn += picture != NULL;
        zraster_picture_free(picture);
        zraster_scene_free(scene);
    }
    atomic_store(&is_done, true);
    pthread_join(writer, NULL);
    print_message("%d of 40 drawn\n", drawn);
    shared[0] = 3;
    assert_int_equal(zraster_draw(renderer, &request, &(zraster_picture *){NULL}, NULL), ZRASTER_BAD_SCENE);
}

RUN_TESTS(open_renderer, close_renderer)
