/* Files of colours and floats beside PNG and NPY: decoders give the pixels back, and a number of bytes finds a quality.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <webp/decode.h>

#include "base/cancel.h"
#include "base/run.h"
#include "output/images/lossy.h"
#include "output/images/tiff.h"
#include "output/pfm.h"
#include "support/pictures/jpeg.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 26)

enum { WIDTH = 61, HEIGHT = 37, PIXELS = WIDTH * HEIGHT };

static uint8_t rgba[4 * PIXELS];

/* A gradient; with alpha, from left to right, and 0 in the first column. */
static struct zr_lossy gradient(bool has_alpha)
{
    for (int i = 0; i < PIXELS; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        const uint8_t pixel[4] = {(uint8_t)(4 * x), (uint8_t)(6 * y), (uint8_t)(2 * (x + y)), (uint8_t)(4 * x)};
        memcpy(rgba + 4 * i, pixel, 4);
        if (!has_alpha) rgba[4 * i + 3] = 255;
    }
    return (struct zr_lossy){.width = WIDTH, .height = HEIGHT, .rgba = rgba, .has_alpha = has_alpha, .quality = 90};
}

static struct zr_lossy noise(void)
{
    struct random random = random_seeded(7);
    for (int i = 0; i < 4 * PIXELS; i++)
        rgba[i] = (uint8_t)random_next(&random);
    return (struct zr_lossy){.width = WIDTH, .height = HEIGHT, .rgba = rgba, .has_alpha = true, .quality = 90};
}

static struct zr_lossy_file write_whole(zr_lossy_write_fn *write, const struct zr_lossy *image)
{
    struct zr_lossy_file file;
    assert_int_equal(write(&arena, image, SIZE_MAX, NULL, &file), ZR_OK);
    assert_non_null(file.bytes);
    return file;
}

static uint8_t *decode_webp(const struct zr_lossy_file *file)
{
    int width, height;
    uint8_t *pixels = WebPDecodeRGBA(file->bytes, file->size, &width, &height);
    assert_non_null(pixels);
    assert_int_equal(width, WIDTH);
    assert_int_equal(height, HEIGHT);
    return pixels;
}

/* Fails if a colour of a pixel, which has `step` bytes, is further than `most` from that of the picture. */
static void assert_near_picture(const uint8_t *pixels, int step, int most)
{
    for (int i = 0; i < PIXELS; i++)
        for (int k = 0; k < 3; k++)
            if (abs(pixels[step * i + k] - rgba[4 * i + k]) > most)
                fail_msg("pixel %d: %d, not %d", i, pixels[step * i + k], rgba[4 * i + k]);
}

TEST_AROUND(a_lossless_webp_has_each_pixel_also_without_any_alpha, open_arena, close_arena)
{
    for (int is_noise = 0; is_noise < 2; is_noise++)
        for (int is_small = 0; is_small < 2; is_small++) {
            struct zr_lossy image = is_noise ? noise() : gradient(true);
            image.is_lossless = true;
            image.is_small = is_small;
            const struct zr_lossy_file file = write_whole(zr_webp_write, &image);
            uint8_t *pixels = decode_webp(&file);
            assert_memory_equal(pixels, rgba, sizeof rgba);
            WebPFree(pixels);
        }
}

TEST_AROUND(lossy_files_are_near_the_picture, open_arena, close_arena)
{
    const struct zr_lossy image = gradient(false);
    uint32_t width, height, channels;
    struct zr_lossy_file file = write_whole(zr_jpeg_write, &image);
    uint8_t *pixels = jpeg_memory_read(file.bytes, file.size, &width, &height, &channels);
    assert_non_null(pixels);
    assert_true(width == WIDTH && height == HEIGHT && channels == 3);
    assert_near_picture(pixels, 3, 12);
    free(pixels);
    file = write_whole(zr_webp_write, &image);
    pixels = decode_webp(&file);
    assert_near_picture(pixels, 4, 12);
    WebPFree(pixels);
}

TEST_AROUND(a_jpeg_names_its_pixels_per_inch, open_arena, close_arena)
{
    struct zr_lossy image = gradient(false);
    assert_memory_equal(write_whole(zr_jpeg_write, &image).bytes + 6, "JFIF\0\1\1\0\0\1\0\1", 12);
    image.dpi = 300.0f;
    assert_memory_equal(write_whole(zr_jpeg_write, &image).bytes + 6, "JFIF\0\1\1\1\1\54\1\54", 12);
}

TEST_AROUND(a_lossy_webp_keeps_alpha, open_arena, close_arena)
{
    const struct zr_lossy image = gradient(true);
    const struct zr_lossy_file file = write_whole(zr_webp_write, &image);
    uint8_t *pixels = decode_webp(&file);
    for (int i = 0; i < PIXELS; i++)
        assert_int_equal(pixels[4 * i + 3], rgba[4 * i + 3]);
    WebPFree(pixels);
}

/* ---- the quality for a number of bytes ---- */

static int tries;

/* A file of 100 bytes for each step of quality. */
static enum zr_status write_by_steps(struct zr_arena *scratch, const struct zr_lossy *image, size_t most,
                                     const struct zr_cancel *cancel, struct zr_lossy_file *file)
{
    (void)scratch;
    (void)cancel;
    tries++;
    *file = (struct zr_lossy_file){.size = 100 * (size_t)image->quality, .quality = image->quality};
    if (file->size <= most) file->bytes = rgba;
    return ZR_OK;
}

TEST(six_tries_find_the_best_quality_within_three)
{
    struct zr_lossy image = {.width = 1, .height = 1, .rgba = rgba};
    for (image.quality = 1; image.quality <= 100; image.quality++)
        for (uint32_t best = 0; best <= image.quality; best++) {
            struct zr_lossy_file file;
            tries = 0;
            assert_int_equal(
                zr_lossy_fit(&(struct zr_run){.arena = NULL}, write_by_steps, &image, 100 * best + 99, &file), ZR_OK);
            assert_in_range(tries, 1, ZR_LOSSY_TRIES);
            if (best == 0) {
                assert_null(file.bytes);
                assert_int_equal(file.size, 100);
                continue;
            }
            assert_non_null(file.bytes);
            assert_in_range(best - file.quality, 0, 3);
            if (best == image.quality) assert_true(tries == 1 && file.quality == best);
        }
}

TEST_AROUND(real_files_fit_their_bytes, open_arena, close_arena)
{
    zr_lossy_write_fn *const writes[] = {zr_jpeg_write, zr_webp_write};
    const struct zr_lossy image = noise();
    for (int i = 0; i < 2; i++) {
        struct zr_lossy at = image;
        at.quality = 40;
        const size_t most = write_whole(writes[i], &at).size;
        struct zr_lossy_file file;
        assert_int_equal(zr_lossy_fit(&(struct zr_run){.arena = &arena}, writes[i], &image, most, &file), ZR_OK);
        assert_non_null(file.bytes);
        assert_true(file.size <= most && file.quality >= 37);
        assert_int_equal(zr_lossy_fit(&(struct zr_run){.arena = &arena}, writes[i], &image, 20, &file), ZR_OK);
        assert_true(!file.bytes && file.size > 20 && file.quality == 1);
    }
}

TEST(writers_stop_when_cancelled_or_without_memory)
{
    zr_lossy_write_fn *const writes[] = {zr_jpeg_write, zr_webp_write};
    struct zr_cancel cancel = {.raised = true};
    const struct zr_lossy image = noise();
    struct zr_lossy_file file;
    for (int i = 0; i < 2; i++) {
        zr_arena_init(&arena, 1 << 26);
        assert_int_equal(writes[i](&arena, &image, SIZE_MAX, &cancel, &file), ZR_CANCELLED);
        assert_null(file.bytes);
        zr_arena_free(&arena);
        zr_arena_init(&arena, 1 << 10);
        assert_int_equal(writes[i](&arena, &image, SIZE_MAX, NULL, &file), ZR_NO_MEMORY);
        assert_null(file.bytes);
        assert_false(zr_arena_ok(&arena));
        zr_arena_free(&arena);
    }
}

/* ---- floats ---- */

static uint32_t number_at(const unsigned char *at, int bytes)
{
    uint32_t value = 0;
    for (int i = bytes; i-- > 0;)
        value = value << 8 | at[i];
    return value;
}

/* Returns a value of an entry of the first directory of a little-endian TIFF. */
static uint32_t tiff_value(const struct zr_buffer *file, uint32_t tag, uint32_t index)
{
    const unsigned char *directory = file->bytes + number_at(file->bytes + 4, 4);
    uint32_t before = 0;
    for (uint32_t i = 0; i < number_at(directory, 2); i++) {
        const unsigned char *entry = directory + 2 + 12 * (size_t)i;
        const uint32_t type = number_at(entry + 2, 2), count = number_at(entry + 4, 4), size = type == 3 ? 2 : 4;
        assert_true(number_at(entry, 2) > before); /* in order */
        before = number_at(entry, 2);
        if (before != tag) continue;
        assert_true(index < count);
        return number_at((size * count > 4 ? file->bytes + number_at(entry + 8, 4) : entry + 8) + (size_t)size * index,
                         (int)size);
    }
    fail_msg("no tag %u", tag);
    return 0;
}

static const float floats[12] = {0, INFINITY, -1.5f, 3e-40f, 5, 6, 7, 8, 9, 10, 11, 12};

TEST_AROUND(a_tiff_has_the_floats, open_arena, close_arena)
{
    for (uint32_t samples = 1; samples <= 3; samples++) {
        struct zr_buffer file = {.arena = &arena};
        assert_int_equal(zr_tiff_write(2, 2, samples, floats, &file), ZR_OK);
        assert_memory_equal(file.bytes, "II*\0", 4);
        const uint32_t strip = tiff_value(&file, 273, 0), bytes = 16 * samples;
        assert_true(tiff_value(&file, 256, 0) == 2 && tiff_value(&file, 257, 0) == 2 && tiff_value(&file, 278, 0) == 2);
        assert_true(tiff_value(&file, 259, 0) == 1 && tiff_value(&file, 277, 0) == samples);
        assert_int_equal(tiff_value(&file, 262, 0), samples == 3 ? 2 : 1);
        for (uint32_t i = 0; i < samples; i++)
            assert_true(tiff_value(&file, 258, i) == 32 && tiff_value(&file, 339, i) == 3);
        assert_int_equal(tiff_value(&file, 279, 0), bytes);
        assert_int_equal(strip % 4, 0);
        assert_int_equal(file.size, strip + bytes);
        assert_memory_equal(file.bytes + strip, floats, bytes);
    }
}

TEST_AROUND(a_pfm_has_the_bottom_row_first, open_arena, close_arena)
{
    for (uint32_t components = 1; components <= 3; components += 2) {
        const char *header = components == 3 ? "PF\n2 2\n-1.0\n" : "Pf\n2 2\n-1.0\n";
        const size_t row = 2 * components, begin = strlen(header);
        struct zr_buffer file = {.arena = &arena};
        assert_int_equal(zr_pfm_write(2, 2, components, floats, &file), ZR_OK);
        assert_int_equal(file.size, begin + 8 * row);
        assert_memory_equal(file.bytes, header, begin);
        assert_memory_equal(file.bytes + begin, floats + row, 4 * row);
        assert_memory_equal(file.bytes + begin + 4 * row, floats, 4 * row);
    }
}

RUN_TESTS(NULL, NULL)
