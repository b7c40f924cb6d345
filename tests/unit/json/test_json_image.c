/* Images by the names that scenes have for them: decoded once, counted together, and refused at their place. */
#include "base/cancel.h"
#include "input/scene/json_scene.h"
#include "support/input/base64.h"
#include "support/pictures/png.h"
#include "support/test_arena.h"
#include "support/tests.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

TEST_ARENA(1 << 26)

enum { RED, BLUE, BROKEN, PARTS };

static uint8_t *pngs[2];
static size_t sizes[2];
static char *red_uri;

static int make_pngs(void **state)
{
    for (int i = 0; i < 2; i++) {
        uint8_t rgba[6 * 4];
        for (size_t k = 0; k < sizeof rgba; k++)
            rgba[k] = (uint8_t)(i * 100 + (int)k);
        pngs[i] = png_memory_write(rgba, 3, 2, &sizes[i]);
    }
    red_uri = base64_of("data:image/png;base64,", pngs[RED], sizes[RED]);
    return pngs[0] && pngs[1] && red_uri ? open_arena(state) : -1;
}

static int free_pngs(void **state)
{
    free(pngs[0]);
    free(pngs[1]);
    free(red_uri);
    return close_arena(state);
}

#define HASH "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef"

/* Keeps the red one, whatever the hash, in a copy each time. */
static enum zr_status read_stored(void *context, const char *sha256, struct zr_arena *in, const void **bytes,
                                  size_t *size)
{
    void *copy = zr_arena_alloc(in, sizes[RED], 1);
    (void)sha256;
    ++*(int *)context;
    if (!copy) return ZR_NO_MEMORY;
    memcpy(copy, pngs[RED], sizes[RED]);
    *bytes = copy;
    *size = sizes[RED];
    return ZR_OK;
}

struct fixture {
    struct zr_parsed_scene root;
    struct zr_scene scene;
    struct zr_scene_builder builder;
    struct zr_limits limits;
    struct zr_error error;
    struct zr_asset parts[PARTS];
    uint8_t uses[PARTS];
    int times_read;
};

static struct fixture *open_fixture(void)
{
    static struct fixture f;
    zr_arena_reset(&arena, 1 << 26);
    f = (struct fixture){.limits = zr_limits_default(),
                         .parts = {{.name = "red", .bytes = pngs[RED], .size = sizes[RED]},
                                   {.name = "blue", .bytes = pngs[BLUE], .size = sizes[BLUE]},
                                   {.name = "broken", .bytes = pngs[BLUE], .size = sizes[BLUE] - 1}}};
    f.builder = zr_scene_builder_open(&arena, NULL, &f.scene);
    f.root = (struct zr_parsed_scene){.json = {.arena = &arena, .limits = &f.limits, .error = &f.error},
                                      .builder = &f.builder,
                                      .scene = &f.scene,
                                      .assets = {.count = PARTS,
                                                 .items = f.parts,
                                                 .uses = f.uses,
                                                 .use = ZR_USED,
                                                 .stored = {.read = read_stored, .context = &f.times_read}},
                                      .images = {.builder = &f.builder, .pixels_max = f.limits.image_pixels_max}};
    f.root.json.assets = &f.root.assets;
    zr_json_open(&f.root.json, "{}", 2);
    return &f;
}

static uint32_t find(struct fixture *f, const char *uri, const char *asset)
{
    uint32_t number = UINT32_MAX;
    const bool found =
        zr_parsed_find_image(&f->root, ZR_JSON_KEY(NULL, "t"), &(struct zr_bytes_name){uri, asset}, &number);
    if (!found) fail_msg("%s: %s", f->error.items[0].pointer, f->error.items[0].detail);
    return number;
}

static void refuse(struct fixture *f, const char *uri, const char *asset, const char *pointer, const char *why)
{
    uint32_t number = 77;
    f->error.count = 0;
    assert_false(zr_parsed_find_image(&f->root, ZR_JSON_KEY(NULL, "t"), &(struct zr_bytes_name){uri, asset}, &number));
    assert_int_equal(number, 77);
    assert_int_equal(f->error.count, 1);
    assert_string_equal(f->error.items[0].pointer, pointer);
    if (!strstr(f->error.items[0].detail, why)) fail_msg("'%s' does not say '%s'", f->error.items[0].detail, why);
}

TEST(the_same_bytes_are_one_image_by_whatever_name)
{
    struct fixture *f = open_fixture();
    char *plain = base64_of("data:;base64,", pngs[RED], sizes[RED]);
    assert_int_equal(find(f, NULL, "red"), 0);
    const void *texels = f->scene.images[0].texels;
    assert_int_equal(find(f, NULL, "blue"), 1);
    for (int turn = 0; turn < 3; turn++) {
        assert_int_equal(find(f, NULL, "red"), 0);
        assert_int_equal(find(f, red_uri, NULL), 0);
        assert_int_equal(find(f, plain, NULL), 0);
        assert_int_equal(find(f, NULL, "sha256:" HASH), 0);
    }
    assert_int_equal(f->times_read, 1);
    assert_int_equal(f->scene.image_count, 2);
    assert_ptr_equal(f->scene.images[0].texels, texels);
    assert_int_equal(f->root.images.pixels, 12);
    assert_true(f->uses[RED] && f->uses[BLUE] && !f->uses[BROKEN]);
    free(plain);
}

TEST(images_have_their_own_texels)
{
    struct fixture *f = open_fixture();
    assert_int_equal(find(f, NULL, "blue"), 0);
    assert_int_equal(find(f, red_uri, NULL), 1);
    const struct zr_image *blue = &f->scene.images[0], *red = &f->scene.images[1];
    assert_true(red->width == 3 && red->height == 2 && red->bits == 8);
    for (size_t i = 0; i < 24; i++) {
        assert_int_equal(((const uint8_t *)red->texels)[i], i);
        assert_int_equal(((const uint8_t *)blue->texels)[i], 100 + i);
    }
}

TEST(what_is_no_image_is_refused_where_it_is_named)
{
    struct fixture *f = open_fixture();
    refuse(f, NULL, "green", "/t/asset", "no part of the request has the name 'green'");
    refuse(f, NULL, "broken", "/t/asset", "a broken PNG: it ends too early");
    refuse(f, "data:image/png;base64,R0lGODlh", NULL, "/t/uri", "it looks like a GIF picture");
    refuse(f, "http://example.org/a.png", NULL, "/t/uri", "is not a data: URI; nothing is fetched from elsewhere");
    refuse(f, NULL, "sha256:12", "/t/asset", "64 lower-case hexadecimal digits");
    assert_int_equal(f->scene.image_count, 0);
    assert_int_equal(f->root.images.pixels, 0);
    assert_int_equal(find(f, NULL, "blue"), 0); /* and what is good is still found */
}

TEST(pixels_of_all_images_are_counted_together)
{
    struct fixture *f = open_fixture();
    f->root.images.pixels_max = 11;
    assert_int_equal(find(f, NULL, "red"), 0);
    refuse(f, NULL, "blue", "/t/asset", "an image of 3 x 2 texels; 5 are left of imagePixelsMax");
    assert_int_equal(find(f, red_uri, NULL), 0); /* decoded before */
    f->root.images.pixels_max = 12;
    assert_int_equal(find(f, NULL, "blue"), 1);
}

TEST(names_are_counted)
{
    enum { NAMES = 1024 };
    struct fixture *f = open_fixture();
    char name[] = "sha256:" HASH;
    for (int i = 0; i <= NAMES; i++) {
        char digits[9];
        snprintf(digits, sizeof digits, "%08x", (unsigned)i);
        memcpy(name + 7, digits, 8);
        char *kept = zr_arena_alloc(&arena, sizeof name, 1);
        memcpy(kept, name, sizeof name);
        if (i < NAMES)
            assert_int_equal(find(f, NULL, kept), 0);
        else
            refuse(f, NULL, kept, "/t/asset", "more than the 1024 images that are allowed");
    }
    assert_int_equal(f->times_read, NAMES);
}

TEST(memory_that_is_short_is_no_fault_of_the_scene)
{
    struct fixture *f = open_fixture();
    uint32_t number = 77;
    arena.ceiling = arena.used + 1024;
    assert_false(zr_parsed_find_image(&f->root, ZR_JSON_KEY(NULL, "t"), &(struct zr_bytes_name){NULL, "red"}, &number));
    arena.ceiling = 1 << 26;
    assert_int_equal(f->error.count, 0);
    assert_false(zr_arena_ok(&arena));
    assert_int_equal(zr_json_close(&f->root.json), ZR_NO_MEMORY);
}

TEST(cancelled_requests_decode_nothing)
{
    struct fixture *f = open_fixture();
    struct zr_cancel cancel = {.raised = true};
    uint32_t number = 77;
    f->root.json.cancel = arena.cancel = &cancel;
    assert_false(zr_parsed_find_image(&f->root, ZR_JSON_KEY(NULL, "t"), &(struct zr_bytes_name){NULL, "red"}, &number));
    arena.cancel = NULL;
    assert_int_equal(zr_json_close(&f->root.json), ZR_CANCELLED);
    assert_int_equal(f->scene.image_count, 0);
}

RUN_TESTS(make_pngs, free_pngs)
