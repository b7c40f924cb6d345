/* Reading that is cancelled ends soon: JSON, arrays, patterns of parts, pictures, and memory that is cleared. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/run.h"
#include "cancel_check.h"
#include "input/images/image_read.h"
#include "output/images/png.h"
#include "render_request.h"
#include "scene/scene.h"
#include "support/pictures/jpeg.h"

static struct zr_arena arena;

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
        assert_ended_soon(&later,
                          zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &scene));
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
    assert_ended_soon(&later,
                      zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &scene));
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
            assert_ended_soon(
                &later, zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &scene));
            zr_arena_reset(&arena, 0);
        }
    zr_arena_free(&arena);
    free(zeros);
}

/* Clears 3 GB. A sanitizer first marks new memory, which cannot be cancelled: it gets 0.25 GB. */
TEST(touching_large_memory_stops)
{
    struct later later;
    zr_arena_init(&arena, (size_t)8 << 30);
    begin(&later, RAISED_MS);
    arena.cancel = &later.cancel;
    const void *zeros = zr_arena_zero(&arena, IS_SANITIZED ? 1 : 12, (size_t)1 << 28);
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
    assert_ended_soon(&later,
                      zr_image_read(&images, &(struct zr_encoded_image){bytes, size, UINT64_MAX}, &image, &reason));
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
