/* WebPs that libwebp writes, and broken ones. */
#include <webp/decode.h>
#include <webp/encode.h>

#include "support/random.h"
#include "support/tests.h"
#include "unit/common/image_check.h"

enum { WIDTH = 37, HEIGHT = 21, KINDS = 4 }; /* bit 0: lossless; bit 1: opaque */

struct file {
    uint8_t *bytes;
    size_t size;
};

static void make_pixels(uint8_t *pixels, int width, int height, bool is_opaque)
{
    struct random random = random_seeded((uint32_t)(width * 1000 + height));
    for (int i = 0; i < 4 * width * height; i++)
        pixels[i] = is_opaque && i % 4 == 3
                        ? 255
                        : (uint8_t)((uint32_t)(i / 4 % width * (3 + i % 4)) + random_below(&random, 8));
}

static struct file make_file(int width, int height, int kind)
{
    struct file file = {NULL, 0};
    uint8_t *pixels = malloc((size_t)width * (size_t)height * 4);
    assert_non_null(pixels);
    make_pixels(pixels, width, height, kind & 2);
    file.size = kind & 1 ? WebPEncodeLosslessRGBA(pixels, width, height, 4 * width, &file.bytes)
                         : WebPEncodeRGBA(pixels, width, height, 4 * width, 80, &file.bytes);
    free(pixels);
    assert_true(file.size > 0);
    return file;
}

TEST(every_kind_of_webp_gives_its_values)
{
    static const int sizes[][2] = {{1, 1}, {16, 16}, {WIDTH, HEIGHT}, {129, 3}, {300, 200}};
    for (int kind = 0; kind < KINDS; kind++)
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
            const struct file file = make_file(sizes[i][0], sizes[i][1], kind);
            const struct image_reading reading = read_image(file.bytes, file.size);
            int width, height;
            uint8_t *wanted = WebPDecodeRGBA(file.bytes, file.size, &width, &height);
            assert_non_null(wanted);
            assert_image(&reading, (uint32_t)sizes[i][0], (uint32_t)sizes[i][1], 8);
            assert_memory_equal(reading.image.texels, wanted, (size_t)width * (size_t)height * 4);
            WebPFree(wanted);
            WebPFree(file.bytes);
        }
}

TEST(lossless_pictures_are_those_that_were_written)
{
    const struct file file = make_file(WIDTH, HEIGHT, 3);
    const struct image_reading reading = read_image(file.bytes, file.size);
    uint8_t pixels[4 * WIDTH * HEIGHT];
    make_pixels(pixels, WIDTH, HEIGHT, true);
    assert_image(&reading, WIDTH, HEIGHT, 8);
    assert_memory_equal(reading.image.texels, pixels, sizeof pixels);
    WebPFree(file.bytes);
}

TEST(cut_files_are_refused)
{
    for (int kind = 0; kind < KINDS; kind++) {
        const struct file file = make_file(16, 9, kind);
        refuse_cut(file.bytes, file.size);
        WebPFree(file.bytes);
    }
}

TEST(broken_bytes_end_the_reading)
{
    struct random random = random_seeded(5);
    for (int kind = 0; kind < KINDS; kind++) {
        const struct file file = make_file(64, 48, kind);
        for (int i = 0; i < 100; i++) {
            uint8_t *at = &file.bytes[random_below(&random, (uint32_t)file.size)], before = *at;
            *at = (uint8_t)random_below(&random, 256);
            const struct image_reading reading = read_image(file.bytes, file.size);
            assert_true(reading.status == ZR_OK || *reading.reason.text);
            *at = before;
        }
        WebPFree(file.bytes);
    }
}

TEST(other_files_are_refused)
{
    static const uint8_t moving[] = "RIFF\x16\0\0\0WEBPVP8X\x0A\0\0\0\x02\0\0\0\x0F\0\0\x0F\0\0",
                         huge[] = "RIFF\x16\0\0\0WEBPVP8X\x0A\0\0\0\0\0\0\0\xFF\x3F\0\xFF\x3F\0";
    assert_refused(moving, sizeof moving - 1, "an animated WebP; those of one picture are read");
    assert_refused(huge, sizeof huge - 1, "an image of 16384 x 16384 texels");
}

TEST(a_ceiling_is_kept)
{
    const struct file file = make_file(300, 200, 1);
    assert_true(try_ceilings(file.bytes, file.size, 1 << 17) > 3);
    WebPFree(file.bytes);
}

RUN_TESTS(open_arena, close_arena)
