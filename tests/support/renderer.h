/* renderer.h - support: a renderer of libzraster for a program of tests: RUN_TESTS(open_renderer, close_renderer). */
#ifndef ZR_TEST_RENDERER_H
#define ZR_TEST_RENDERER_H

#include <stdbool.h>
#include <string.h>

#include "api/zraster.h"
#include "support/cmocka_all.h"

static zraster *renderer;

static inline int open_renderer(void **state)
{
    const struct zraster_options options = {.struct_size = sizeof options, .threads = 3};
    (void)state;
    return zraster_open(&options, &renderer) == ZRASTER_OK ? 0 : -1;
}

static inline int close_renderer(void **state)
{
    (void)state;
    zraster_close(renderer);
    return 0;
}

static inline struct zraster_request request_of_bytes(const char *body, size_t size)
{
    return (struct zraster_request){.struct_size = sizeof(struct zraster_request), .body = body, .body_size = size};
}

static inline struct zraster_request request_of(const char *text)
{
    return request_of_bytes(text, strlen(text));
}

/* ---- calls that succeed ---- */

/* A small scene with three outputs and a node. */
static const char triangle[] =
    "{\"window\": {\"width\": 200, \"height\": 150}, \"samples\": 4, \"look\": \"studio\", "
    "\"outputs\": [{\"channel\": \"color\"}, {\"channel\": \"depth\"}, {\"channel\": \"info\"}], "
    "\"nodes\": [{\"name\": \"n\", \"mesh\": 0}], "
    "\"meshes\": [{\"positions\": [[0,0,0],[1,0.25,0],[0,1,0.5]], \"faces\": [[0,1,2]]}]}";

static inline zraster_picture *picture_of_request(zraster *by, const struct zraster_request *request, const char *name)
{
    zraster_picture *picture;
    zraster_error *error;
    if (zraster_draw(by, request, &picture, &error) != ZRASTER_OK) fail_msg("%s: %s", name, zraster_error_text(error));
    assert_null(error);
    return picture;
}

static inline zraster_picture *picture_of(zraster *by, const char *text)
{
    const struct zraster_request request = request_of(text);
    return picture_of_request(by, &request, "a text");
}

static inline struct zraster_bytes bytes_of(zraster_picture *picture, const char *channel)
{
    struct zraster_bytes bytes;
    assert_int_equal(zraster_picture_encode(picture, channel, &bytes, NULL), ZRASTER_OK);
    return bytes;
}

static inline bool is_same_bytes(struct zraster_bytes a, struct zraster_bytes b)
{
    return a.size == b.size && memcmp(a.data, b.data, a.size) == 0;
}

/* Returns the first of the channels color, depth and faceId that differs, or NULL. */
static inline const char *channel_that_differs(zraster_picture *a, zraster_picture *b)
{
    static const char *const channels[] = {"color", "depth", "faceId"};
    for (int i = 0; i < 3; i++)
        if (!is_same_bytes(bytes_of(a, channels[i]), bytes_of(b, channels[i]))) return channels[i];
    return NULL;
}

#endif
