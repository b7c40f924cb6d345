/* base_scenes.h - scenes with a base, and the assets that they ask for: "c", "w", "d", "f". */
#ifndef TEST_BASE_SCENES_H
#define TEST_BASE_SCENES_H

#include <cjson/cJSON.h>
#include <math.h>

#include "input_check.h"
#include "output/images/png.h"
#include "output/npy.h"
#include "shade/frame.h"
#include "support/input/base64.h"
#include "support/scenes.h"

enum { WIDTH = 4, HEIGHT = 2, PIXELS = WIDTH * HEIGHT, ASSETS = 5 };

/* The whole window at window depth 0.5, eye depth 0. */
#define HEAD                                                                                                           \
    "{\"window\":{\"width\":4,\"height\":2},\"shading\":\"unlit\",\"view\":{\"projectionMatrix\":"                     \
    "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},\"polygons\":[{\"vertices\":[[-1,-1,0],[3,-1,0],[-1,3,0]],\"color\":"          \
    "\"#112233\",\"doubleSided\":true}],"
#define ALL                                                                                                            \
    "\"color\":{\"asset\":\"c\"},\"windowDepth\":{\"asset\":\"w\"},\"depth\":{\"asset\":\"d\"},\"faceId\":"            \
    "{\"asset\":\"f\"}"
#define OUTPUTS                                                                                                        \
    "\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"windowDepth\"},{\"channel\":\"depth\"},"                      \
    "{\"channel\":\"faceId\"},{\"channel\":\"info\"}]"
#define BASE(members) "\"base\":{" members "}"
#define HASH_C        "cccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccc"
#define HASH_W        "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"

/* Four pixels behind the polygon and one at its depth; three in front or with nothing. */
static const float WINDOW_DEPTH[PIXELS] = {0, 0.25f, 0.5f, 0.75f, 1, 0.500001f, 0.9f, 0.49999f};
static const float DEPTH[PIXELS] = {-1, -0.5f, 0, 0.5f, INFINITY, NAN, 0.8f, -0.01f};
static const uint32_t FACE_ID[PIXELS] = {1, 2, 3, 4, 0, 5, 6, 7};
static uint8_t colors[PIXELS * 4];

static struct zr_arena arena;
static struct zr_asset assets[ASSETS];

static inline struct zr_asset png_asset(const char *name, enum zr_png_kind kind, uint32_t width, uint32_t height)
{
    static uint8_t large[64 * 64 * 4];
    struct zr_png png = {.kind = kind, .width = width, .height = height, .pixels = width == WIDTH ? colors : large};
    struct zr_buffer out = {.arena = &arena};
    assert_int_equal(zr_png_write(&png, NULL, NULL, &out), ZR_OK);
    return (struct zr_asset){.name = name, .bytes = out.bytes, .size = out.size};
}

static inline struct zr_asset npy_asset(const char *name, enum zr_npy_type type, const void *values)
{
    struct zr_buffer out = {.arena = &arena};
    assert_int_equal(zr_npy_write(type, WIDTH, HEIGHT, 1, values, &out), ZR_OK);
    return (struct zr_asset){.name = name, .bytes = out.bytes, .size = out.size};
}

static inline int make_assets(void **state)
{
    (void)state;
    zr_arena_init(&arena, 1 << 26);
    for (size_t i = 0; i < sizeof colors; i++)
        colors[i] = (uint8_t)(i % 4 == 3 ? 255 - i : 7 * i);
    assets[0] = png_asset("c", ZR_PNG_RGBA, WIDTH, HEIGHT);
    assets[1] = npy_asset("w", ZR_NPY_FLOAT32, WINDOW_DEPTH);
    assets[2] = npy_asset("d", ZR_NPY_FLOAT32, DEPTH);
    assets[3] = npy_asset("f", ZR_NPY_UINT32, FACE_ID);
    return 0;
}

static inline int free_assets(void **state)
{
    (void)state;
    zr_arena_free(&arena);
    return 0;
}

/* With the four assets, and `extra` where it has a name. */
static inline struct reading *read_with(const char *text, struct zr_asset extra, const char *channel)
{
    assets[4] = extra;
    struct zr_request request = {.format = ZR_FORMAT_JSON,
                                 .channel = channel,
                                 .assets = assets,
                                 .asset_count = extra.name ? ASSETS : ASSETS - 1};
    return read_request(request, text, strlen(text), zr_limits_default(), (size_t)1 << 26);
}

static const struct zr_asset NO_EXTRA = {.name = NULL};

static inline struct reading *read_good(const char *text)
{
    struct reading *reading = read_with(text, NO_EXTRA, NULL);
    assert_read(reading);
    return reading;
}

static inline void refuses_with(const char *text, struct zr_asset extra, const char *pointer, const char *detail)
{
    struct reading *reading = read_with(text, extra, NULL);
    assert_complaint(reading, ZR_BAD_SCENE, pointer, detail);
    reading_free(reading);
}

static inline const struct zr_frame *render(struct reading *reading)
{
    return scene_render(&reading->arena, NULL, reading->scene);
}

/* Where the polygon is seen, from pixel 0 on: '#'. */
static inline void assert_seen(const struct zr_frame *frame, const char *want)
{
    char got[PIXELS + 1] = "";
    for (int i = 0; i < PIXELS; i++)
        got[i] = frame->window_depth[i] == 0.5f && frame->face_id[i] == 8 ? '#' : '.';
    assert_string_equal(got, want);
}

static inline void assert_warned(const struct zr_scene *scene, const char *text)
{
    for (uint32_t i = 0; i < scene->warning_count; i++)
        if (strstr(scene->warnings[i], text)) return;
    fail_msg("no warning says '%s'; there are %u", text, scene->warning_count);
}

#endif
