/* server/keep/images.c: images kept between requests. No answer depends on them. */
#include "base/team.h"
#include "keep/images.h"
#include "render_request.h"
#include "scene/image.h"
#include "support/files.h"
#include "support/pictures/striped_images.h"
#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"

#include "base/run.h"
#include "input/images/image_read.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

TEST_ARENA((size_t)1 << 28)

/* ENTRY_BYTES: 64 x 64 x 4 bytes, a third of it for levels, and the header of an entry, in whole blocks. */
enum { SIDE = STRIPED_SIDE, FILES = 4, TEXELS_MAX = 1 << 20, ENTRY_BYTES = 6 * 4096 };

static uint8_t *files[FILES];
static size_t sizes[FILES];

static int make_files(void **state)
{
    if (!striped_files_make(FILES, files, sizes)) return -1;
    return open_arena(state);
}

static int free_files(void **state)
{
    for (int i = 0; i < FILES; i++)
        free(files[i]);
    return close_arena(state);
}

/* Reads a file within a request. */
static struct zr_image read_file(struct images_use *use, struct zr_arena *in, int number)
{
    const struct zr_kept_images lent = images_lend(use);
    struct zr_image image = {.texels = NULL};
    struct zr_reason reason;
    assert_int_equal(zr_image_read_kept(in, &lent, &(struct zr_encoded_image){files[number], sizes[number], TEXELS_MAX},
                                        &image, &reason),
                     ZR_OK);
    return image;
}

/* A request with one image. */
static void ask(struct kept *images, int number)
{
    struct images_use use = {images, NULL, NULL};
    zr_arena_reset(&arena, SIZE_MAX);
    read_file(&use, &arena, number);
    images_release(&use);
}

static struct kept *open_images(uint64_t max_bytes)
{
    struct kept *images = images_open(max_bytes);
    assert_non_null(images);
    return images;
}

static void expect(struct kept *images, uint64_t count, uint64_t hits, uint64_t misses, uint64_t dropped)
{
    const struct kept_state now = kept_look(images);
    assert_int_equal(now.count, count);
    assert_int_equal(now.bytes, count * ENTRY_BYTES);
    assert_int_equal(now.hits, hits);
    assert_int_equal(now.misses, misses);
    assert_int_equal(now.dropped, dropped);
}

TEST(an_image_is_decoded_once)
{
    struct kept *images = open_images(1 << 20);
    ask(images, 0);
    expect(images, 1, 0, 1, 0);
    ask(images, 0);
    ask(images, 1);
    ask(images, 0);
    expect(images, 2, 2, 2, 0);
    kept_close(images);
}

TEST(the_image_used_longest_ago_is_dropped_first)
{
    struct kept *images = open_images(2 * ENTRY_BYTES);
    ask(images, 0);
    ask(images, 1);
    ask(images, 0);
    ask(images, 2); /* drops 1 */
    expect(images, 2, 1, 3, 1);
    ask(images, 0);
    expect(images, 2, 2, 3, 1);
    ask(images, 1);
    expect(images, 2, 2, 4, 2);
    kept_close(images);
}

TEST(an_image_in_use_stays_whatever_others_send)
{
    struct kept *images = open_images(ENTRY_BYTES);
    struct images_use use = {images, NULL, NULL};
    ask(images, 0);
    zr_arena_reset(&arena, SIZE_MAX);
    const struct zr_image held = read_file(&use, &arena, 0), again = read_file(&use, &arena, 0);
    assert_ptr_equal(held.texels, again.texels);
    struct zr_arena other;
    zr_arena_init(&other, (size_t)1 << 28);
    struct images_use others = {images, NULL, NULL};
    read_file(&others, &other, 1); /* does not fit */
    images_release(&others);
    assert_false(kept_drop(images));
    expect(images, 1, 2, 2, 0);
    struct zr_image decoded;
    struct zr_reason reason;
    assert_int_equal(
        zr_image_read(&other, &(struct zr_encoded_image){files[0], sizes[0], TEXELS_MAX}, &decoded, &reason), ZR_OK);
    assert_memory_equal(held.texels, decoded.texels, zr_image_bytes(&decoded));
    images_release(&use);
    assert_true(kept_drop(images));
    expect(images, 0, 2, 2, 1);
    zr_arena_free(&other);
    kept_close(images);
}

TEST(too_large_images_and_none_at_all_are_not_kept)
{
    struct kept *images = open_images(ENTRY_BYTES - 1);
    ask(images, 0);
    expect(images, 0, 0, 1, 0);
    kept_close(images);
    images = open_images(0);
    ask(images, 0);
    expect(images, 0, 0, 0, 0);
    kept_close(images);
    ask(NULL, 0);
}

TEST(a_request_has_the_same_memory_left_with_a_kept_image)
{
    struct kept *images = open_images(1 << 20);
    size_t used[2], held[2];
    for (int i = 0; i < 2; i++) {
        ask(images, 0);
        used[i] = arena.used;
        held[i] = arena.held;
    }
    expect(images, 1, 1, 1, 0);
    assert_int_equal(used[0], used[1]);
    assert_int_equal(held[0], held[1]);
    kept_close(images);
}

/* An image that one request keeps may exceed the limits of another request. */
TEST(limits_and_memory_hold_for_kept_images)
{
    struct kept *images = open_images(1 << 20);
    struct zr_image image;
    struct zr_reason reasons[2], other;
    for (int i = 0; i < 2; i++) {
        struct images_use use = {images, NULL, NULL};
        const struct zr_kept_images lent = images_lend(&use);
        zr_arena_reset(&arena, SIZE_MAX);
        assert_int_equal(zr_image_read_kept(&arena, &lent,
                                            &(struct zr_encoded_image){files[0], sizes[0], SIDE * SIDE - 1}, &image,
                                            &reasons[i]),
                         ZR_BAD_SCENE);
        struct zr_arena small;
        zr_arena_init(&small, SIDE * SIDE * 4);
        assert_int_equal(zr_image_read_kept(&small, &lent, &(struct zr_encoded_image){files[0], sizes[0], TEXELS_MAX},
                                            &image, &other),
                         ZR_NO_MEMORY);
        zr_arena_free(&small);
        images_release(&use);
        ask(images, 0);
    }
    assert_string_equal(reasons[0].text, reasons[1].text);
    kept_close(images);
}

TEST(a_changed_file_is_another_one)
{
    struct kept *images = open_images(1 << 20);
    struct images_use use = {images, NULL, NULL};
    const struct zr_kept_images lent = images_lend(&use);
    struct zr_image image;
    struct zr_reason reason;
    ask(images, 0);
    files[0][sizes[0] / 2] ^= 1;
    assert_int_equal(
        zr_image_read_kept(&arena, &lent, &(struct zr_encoded_image){files[0], sizes[0], TEXELS_MAX}, &image, &reason),
        ZR_BAD_SCENE);
    files[0][sizes[0] / 2] ^= 1;
    images_release(&use);
    expect(images, 1, 0, 2, 0);
    kept_close(images);
}

/* ---- several threads ---- */

enum { THREADS = 3, ROUNDS = 200 };

static bool has_values(const struct zr_image *image, int number)
{
    const uint8_t *texels = image->texels;
    for (size_t k = 0; k < zr_image_bytes(image); k += 63)
        if (texels[k] != striped_byte(number, k)) return false;
    return true;
}

/* Returns NULL if all images were right. */
static void *ask_often(void *context)
{
    struct kept *images = context;
    bool is_right = true;
    struct zr_arena own;
    zr_arena_init(&own, (size_t)1 << 28);
    for (int i = 0; i < ROUNDS; i++) {
        struct images_use use = {images, NULL, NULL};
        zr_arena_reset(&own, SIZE_MAX);
        const int first = i % FILES, second = (i * 7 + 1) % FILES;
        const struct zr_image a = read_file(&use, &own, first), b = read_file(&use, &own, second);
        is_right &= has_values(&a, first) && has_values(&b, second);
        images_release(&use);
    }
    zr_arena_free(&own);
    return is_right ? NULL : images;
}

TEST(threads_share_images_and_drop_them)
{
    struct kept *images = open_images(2 * ENTRY_BYTES);
    pthread_t threads[THREADS];
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, ask_often, images), 0);
    for (int i = 0; i < THREADS; i++) {
        void *wrong;
        assert_int_equal(pthread_join(threads[i], &wrong), 0);
        assert_null(wrong);
    }
    const struct kept_state now = kept_look(images);
    assert_int_equal(now.hits + now.misses, 2 * THREADS * ROUNDS);
    assert_true(now.hits > 0 && now.dropped > 0);
    assert_true(now.bytes <= 2 * ENTRY_BYTES);
    kept_close(images);
}

/* ---- pictures ---- */

struct drawn {
    struct zr_team *team;
    struct kept *few, *many; /* keep some images of a scene, and all */
    int scenes;
};

static struct zr_answer draw(struct zr_arena *in, struct zr_team *team, struct images_use *use, const char *bytes,
                             size_t size)
{
    const struct zr_request request = {
        .format = ZR_FORMAT_JSON, .bytes = bytes, .size = size, .images = images_lend(use)};
    const struct zr_limits limits = zr_limits_default();
    const struct zr_scene *scene;
    struct zr_error error = {.count = 0};
    assert_int_equal(
        zr_scene_read(&(struct zr_run){.arena = in, .team = team, .error = &error}, &request, &limits, &scene), ZR_OK);
    return scene_encode(in, NULL, scene);
}

static void draw_file(const char *path, void *context)
{
    struct drawn *drawn = context;
    size_t size;
    char *bytes = file_read(path, &size);
    assert_non_null(bytes);
    if (strstr(bytes, "Texture\"")) {
        struct zr_arena plain, kept;
        size_t used = 0;
        zr_arena_init(&plain, (size_t)1 << 30);
        zr_arena_init(&kept, (size_t)1 << 30);
        const struct zr_answer want = draw(&plain, NULL, &(struct images_use){NULL, NULL, NULL}, bytes, size);
        struct kept *const all[] = {NULL, drawn->many, drawn->many, drawn->few, drawn->few};
        for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
            struct images_use use = {all[i], NULL, NULL};
            zr_arena_reset(&kept, SIZE_MAX);
            const struct zr_answer got = draw(&kept, drawn->team, &use, bytes, size);
            if (got.size != want.size || memcmp(got.bytes, want.bytes, got.size) != 0)
                fail_msg("%s: other bytes in round %zu", path, i);
            if (i == 0) used = kept.used;
            assert_int_equal(kept.used, used);
            images_release(&use);
        }
        zr_arena_free(&kept);
        zr_arena_free(&plain);
        drawn->scenes++;
    }
    free(bytes);
}

TEST(pictures_are_the_same_with_and_without_kept_images)
{
    struct drawn drawn = {zr_team_create(THREADS), open_images(3 * 4096), open_images(64 << 20), 0};
    files_each("tests/scenes", ".json", draw_file, &drawn);
    const struct kept_state few = kept_look(drawn.few), many = kept_look(drawn.many);
    assert_true(drawn.scenes > 5);
    assert_true(few.dropped > 0 && many.dropped == 0);
    assert_true(many.hits >= many.count);
    kept_close(drawn.few);
    kept_close(drawn.many);
    zr_team_destroy(drawn.team);
}

RUN_TESTS(make_files, free_files)
