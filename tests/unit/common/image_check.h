/* image_check.h - tests: bytes read as an image, and what came of it. */
#ifndef ZR_TESTS_IMAGE_CHECK_H
#define ZR_TESTS_IMAGE_CHECK_H

#include <stdlib.h>

#include "guarded.h"
#include "input/images/image_read.h"
#include "support/cmocka_all.h"
#include "support/test_arena.h"

TEST_ARENA(1 << 26)

enum { TEXELS_MAX = 1 << 20 };

struct image_reading {
    enum zr_status status;
    struct zr_image image;
    struct zr_reason reason;
};

/* What lies in the arena from now on. */
static inline void fill_arena(int byte)
{
    enum { ROOM = 1 << 17 };
    zr_arena_reset(&arena, 1 << 26);
    memset(zr_arena_alloc(&arena, ROOM, 1), byte, ROOM);
    zr_arena_reset(&arena, 1 << 26);
}

/* What lay in the arena before is `byte`; bytes end at a page that nobody may read. */
static inline struct image_reading read_image_over(int byte, const void *bytes, size_t size)
{
    struct image_reading reading = {.reason = {""}};
    struct guarded guarded = guarded_copy(bytes, size);
    fill_arena(byte);
    reading.status = zr_image_read(&arena, &(struct zr_encoded_image){guarded.bytes, size, TEXELS_MAX}, &reading.image,
                                   &reading.reason);
    guarded_free(&guarded);
    return reading;
}

static inline struct image_reading read_image(const void *bytes, size_t size)
{
    return read_image_over(0x5a, bytes, size);
}

static inline void assert_image(const struct image_reading *reading, uint32_t width, uint32_t height, uint32_t bits)
{
    if (reading->status != ZR_OK) fail_msg("status %d: %s", (int)reading->status, reading->reason.text);
    assert_int_equal(reading->image.width, width);
    assert_int_equal(reading->image.height, height);
    assert_int_equal(reading->image.bits, bits);
}

static inline void assert_refused(const void *bytes, size_t size, const char *why)
{
    const struct image_reading reading = read_image(bytes, size);
    assert_int_equal(reading.status, ZR_BAD_SCENE);
    if (!strstr(reading.reason.text, why)) fail_msg("'%s' does not say '%s'", reading.reason.text, why);
}

static inline unsigned texel_channel(const struct zr_image *image, size_t at)
{
    return image->bits == 16 ? ((const uint16_t *)image->texels)[at] : ((const uint8_t *)image->texels)[at];
}

/* Each is refused, at whatever byte it ends. */
static inline void refuse_cut(const void *bytes, size_t size)
{
    for (size_t cut = 0; cut < size; cut++) {
        const struct image_reading reading = read_image(bytes, cut);
        if (reading.status != ZR_BAD_SCENE || !*reading.reason.text)
            fail_msg("%zu of %zu bytes: status %d", cut, size, (int)reading.status);
    }
}

/* Ceilings from nothing to what is enough: each fails for want of memory, or is enough. Returns how many failed. */
static inline int try_ceilings(const void *bytes, size_t size, size_t step)
{
    struct zr_image image;
    struct zr_reason reason;
    for (int failed = 0;; failed++) {
        struct zr_arena small;
        zr_arena_init(&small, (size_t)failed * step);
        const enum zr_status status =
            zr_image_read(&small, &(struct zr_encoded_image){bytes, size, TEXELS_MAX}, &image, &reason);
        const bool is_ok = zr_arena_ok(&small);
        assert_true(small.used <= small.ceiling && small.peak <= small.ceiling);
        zr_arena_free(&small);
        if (status == ZR_OK) return failed;
        assert_int_equal(status, ZR_NO_MEMORY);
        assert_false(is_ok);
        assert_true(failed < 1 << 14);
    }
}

#endif
