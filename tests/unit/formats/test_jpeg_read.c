/* JPEGs of every kind that libjpeg writes, and everything that is not quite one. */
#include "base/cancel.h"
#include "support/pictures/jpeg.h"
#include "support/random.h"
#include "support/sanitized.h"
#include "support/tests.h"
#include "unit/common/image_check.h"

enum { WIDTH = 37, HEIGHT = 21, PIXELS = WIDTH * HEIGHT };

static const struct jpeg_kind KINDS[] = {
    {.colors = JPEG_GREY, .across = 1, .down = 1, .quality = 90},
    {.colors = JPEG_GREY, .across = 1, .down = 1, .is_progressive = true, .quality = 75},
    {.colors = JPEG_YCBCR, .across = 1, .down = 1, .quality = 95},
    {.colors = JPEG_YCBCR, .across = 2, .down = 1, .quality = 50},
    {.colors = JPEG_YCBCR, .across = 1, .down = 2, .quality = 80},
    {.colors = JPEG_YCBCR, .across = 2, .down = 2, .quality = 75},
    {.colors = JPEG_YCBCR, .across = 4, .down = 1, .quality = 75},
    {.colors = JPEG_YCBCR, .across = 2, .down = 2, .is_progressive = true, .quality = 85},
    {.colors = JPEG_YCBCR, .across = 1, .down = 1, .is_progressive = true, .restart_rows = 1, .quality = 100},
    {.colors = JPEG_YCBCR, .across = 2, .down = 2, .restart_rows = 1, .quality = 20},
    {.colors = JPEG_RGB, .across = 1, .down = 1, .quality = 90},
    {.colors = JPEG_RGB, .across = 1, .down = 1, .is_progressive = true, .quality = 90},
    {.colors = JPEG_YCBCR, .across = 2, .down = 2, .is_arithmetic = true, .quality = 90},
    {.colors = JPEG_YCBCR, .across = 1, .down = 1, .is_arithmetic = true, .is_progressive = true, .quality = 90}};
enum { KIND_COUNT = sizeof KINDS / sizeof KINDS[0] };

struct file {
    uint8_t *bytes;
    size_t size;
};

/* Waves of colour, and some noise in them. */
static void make_pixels(uint8_t *pixels, uint32_t width, uint32_t height, size_t channels)
{
    struct random random = random_seeded(width * 1000 + height);
    for (size_t i = 0; i < (size_t)width * height * channels; i++) {
        const size_t x = i / channels % width, y = i / channels / width, c = i % channels;
        pixels[i] = (uint8_t)(x * (3 + c) + y * (5 - c) + random_below(&random, 8));
    }
}

static struct file make_sized(const struct jpeg_kind *kind, uint32_t width, uint32_t height)
{
    struct file file;
    uint8_t *pixels = malloc((size_t)width * height * 4);
    assert_non_null(pixels);
    make_pixels(pixels, width, height, kind->colors == JPEG_GREY ? 1 : kind->colors < JPEG_CMYK ? 3 : 4);
    file.bytes = jpeg_memory_write(kind, pixels, width, height, &file.size);
    free(pixels);
    assert_non_null(file.bytes);
    return file;
}

static struct file make_file(const struct jpeg_kind *kind)
{
    return make_sized(kind, WIDTH, HEIGHT);
}

static void assert_as_libjpeg_has_it(const struct file *file, const struct zr_image *image, size_t kind)
{
    uint32_t width, height, channels;
    uint8_t *wanted = jpeg_memory_read(file->bytes, file->size, &width, &height, &channels);
    const uint8_t *texels = image->texels;
    assert_non_null(wanted);
    assert_true(width == image->width && height == image->height);
    for (size_t i = 0; i < (size_t)width * height; i++)
        for (size_t c = 0; c < 4; c++) {
            const unsigned want = c == 3 ? 255 : wanted[channels * i + (channels == 3 ? c : 0)];
            if (texels[4 * i + c] != want)
                fail_msg("kind %zu, %u x %u, texel %zu, channel %zu: %u, not %u", kind, width, height, i, c,
                         texels[4 * i + c], want);
        }
    free(wanted);
}

TEST(every_kind_of_jpeg_gives_its_values)
{
    static const uint32_t sizes[][2] = {{1, 1}, {8, 8}, {WIDTH, HEIGHT}, {16, 33}, {129, 3}, {2, 100}};
    for (size_t k = 0; k < KIND_COUNT; k++)
        for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
            const struct file file = make_sized(&KINDS[k], sizes[i][0], sizes[i][1]);
            const struct image_reading reading = read_image(file.bytes, file.size);
            assert_image(&reading, sizes[i][0], sizes[i][1], 8);
            assert_as_libjpeg_has_it(&file, &reading.image, k);
            free(file.bytes);
        }
}

/* What the values mean does not rest on libjpeg's word alone: a picture of one colour has it, to the rounding of its
 * conversion. */
TEST(colors_are_what_was_written)
{
    static const uint8_t colors[][3] = {{0, 0, 0}, {255, 255, 255}, {200, 30, 90}, {10, 220, 130}, {0, 0, 255}};
    const struct jpeg_kind kind = {.colors = JPEG_YCBCR, .across = 2, .down = 2, .quality = 100};
    for (size_t k = 0; k < sizeof colors / sizeof colors[0]; k++) {
        uint8_t pixels[PIXELS * 3];
        struct file file;
        for (size_t i = 0; i < sizeof pixels; i++)
            pixels[i] = colors[k][i % 3];
        file.bytes = jpeg_memory_write(&kind, pixels, WIDTH, HEIGHT, &file.size);
        const struct image_reading reading = read_image(file.bytes, file.size);
        assert_image(&reading, WIDTH, HEIGHT, 8);
        for (size_t i = 0; i < PIXELS * 4; i++) {
            const int value = (int)texel_channel(&reading.image, i), want = i % 4 == 3 ? 255 : colors[k][i % 4];
            assert_in_range(value, want > 1 ? want - 2 : 0, want + 2);
        }
        free(file.bytes);
    }
}

TEST(colors_of_print_are_refused)
{
    for (enum jpeg_colors colors = JPEG_CMYK; colors <= JPEG_YCCK; colors++) {
        const struct jpeg_kind kind = {.colors = colors, .across = 1, .down = 1, .quality = 90};
        const struct file file = make_file(&kind);
        assert_refused(file.bytes, file.size, "a JPEG in CMYK, the colours of print; grey, RGB and YCbCr are read");
        free(file.bytes);
    }
}

/* Of the frame's header: FF C0 to FF C2, the length, bits, height, width. */
static uint8_t *find_frame(const struct file *file)
{
    for (size_t at = 2; at + 9 < file->size; at += 2 + ((size_t)file->bytes[at + 2] << 8 | file->bytes[at + 3]))
        if (file->bytes[at + 1] >= 0xC0 && file->bytes[at + 1] <= 0xC2) return file->bytes + at;
    fail_msg("no frame");
    return NULL;
}

TEST(twelve_bits_are_refused)
{
    const struct file file = make_file(&KINDS[2]);
    find_frame(&file)[4] = 12;
    assert_refused(file.bytes, file.size, "12");
    free(file.bytes);
}

TEST(huge_pictures_cost_nothing)
{
    static const struct {
        uint16_t width, height;
        const char *why;
    } cases[] = {{65500, 65500, "65500 x 65500 texels; up to 16384 per side are allowed"},
                 {16384, 16384, "16384 x 16384 texels; 1048576 are left of imagePixelsMax"},
                 {0, 7, "a broken JPEG"},
                 {7, 0, "a broken JPEG"}};
    for (size_t i = 0; i < 2 * sizeof cases / sizeof cases[0]; i++) {
        const struct file file = make_file(&KINDS[i % 2 ? 7 : 2]);
        uint8_t *frame = find_frame(&file);
        frame[5] = (uint8_t)(cases[i / 2].height >> 8);
        frame[6] = (uint8_t)cases[i / 2].height;
        frame[7] = (uint8_t)(cases[i / 2].width >> 8);
        frame[8] = (uint8_t)cases[i / 2].width;
        assert_refused(file.bytes, file.size, cases[i / 2].why);
        assert_true(arena.peak < 16 << 10);
        free(file.bytes);
    }
}

TEST(files_cut_anywhere_are_refused)
{
    for (size_t k = 0; k < KIND_COUNT; k++) {
        const struct file file = make_sized(&KINDS[k], 19, 10);
        refuse_cut(file.bytes, file.size);
        free(file.bytes);
    }
}

/* What libjpeg only warns of. */
TEST(broken_data_are_refused)
{
    const struct file file = make_file(&KINDS[2]);
    uint8_t *data = file.bytes + file.size - 100; /* of the last rows */
    while (data[0] == 0xFF || data[-1] == 0xFF || data[1] == 0xFF)
        data++;
    memcpy(data, "\xFF\xD9", 2); /* the picture ends here */
    assert_refused(file.bytes, file.size, "a broken JPEG: Corrupt JPEG data: premature end of data segment");
    memcpy(data, "\xFF\xD3", 2); /* no restart is due */
    assert_refused(file.bytes, file.size, "a broken JPEG: Corrupt JPEG data");
    free(file.bytes);
}

TEST(what_follows_the_end_is_not_looked_at)
{
    struct file file = make_file(&KINDS[7]);
    file.bytes = realloc(file.bytes, file.size + 1000);
    assert_non_null(file.bytes);
    memset(file.bytes + file.size, 0xFF, 1000);
    const struct image_reading reading = read_image(file.bytes, file.size + 1000);
    assert_image(&reading, WIDTH, HEIGHT, 8);
    free(file.bytes);
}

/* As cameras write them: how the picture was held, and a small picture inside, which is not the one that is read. */
TEST(notes_of_cameras_are_passed_over)
{
    enum { BEHIND_BEGIN = 2, HEAD = 4 };
    const struct file file = make_file(&KINDS[5]), thumbnail = make_sized(&KINDS[0], 8, 8);
    const size_t size = HEAD + thumbnail.size, length = size - 2;
    struct file noted = {malloc(file.size + size), file.size + size};
    assert_non_null(noted.bytes);
    memcpy(noted.bytes, file.bytes, BEHIND_BEGIN);
    memcpy(noted.bytes + BEHIND_BEGIN, (uint8_t[HEAD]){0xFF, 0xE1, (uint8_t)(length >> 8), (uint8_t)length}, HEAD);
    memcpy(noted.bytes + BEHIND_BEGIN + HEAD, thumbnail.bytes, thumbnail.size);
    memcpy(noted.bytes + BEHIND_BEGIN + size, file.bytes + BEHIND_BEGIN, file.size - BEHIND_BEGIN);
    const struct image_reading reading = read_image(noted.bytes, noted.size);
    assert_image(&reading, WIDTH, HEIGHT, 8);
    assert_as_libjpeg_has_it(&file, &reading.image, 5);
    assert_refused(noted.bytes, BEHIND_BEGIN + HEAD + 10, "a broken JPEG: it ends too early");
    free(file.bytes);
    free(thumbnail.bytes);
    free(noted.bytes);
}

/* 253 scans, each of which goes over all of the picture. */
TEST(endless_scans_are_refused)
{
    const struct jpeg_kind kind = {
        .colors = JPEG_GREY, .across = 1, .down = 1, .is_progressive = true, .has_refinements = true, .quality = 90};
    const struct file file = make_file(&kind);
    assert_refused(file.bytes, file.size, "a JPEG of more than 200 scans");
    free(file.bytes);
}

/* Of fewer, the more texels there are. Arithmetic coding counts four times. */
TEST(many_scans_of_large_pictures_are_refused)
{
    for (int arithmetic = 0; arithmetic < 2; arithmetic++) {
        const struct jpeg_kind kind = {.colors = JPEG_GREY,
                                       .across = 1,
                                       .down = 1,
                                       .is_progressive = true,
                                       .is_arithmetic = arithmetic,
                                       .has_refinements = true,
                                       .quality = 90};
        const struct file file = make_sized(&kind, 512, 256);
        assert_refused(file.bytes, file.size,
                       arithmetic ? "a JPEG of 512 x 256 texels in 33 scans or more, of arithmetic coding"
                                  : "a JPEG of 512 x 256 texels in 129 scans or more; up to 16777216 texels");
        free(file.bytes);
    }
}

TEST(libjpeg_gives_back_what_it_took)
{
    const struct file file = make_file(&KINDS[7]);
    assert_int_equal(read_image(file.bytes, file.size).status, ZR_OK);
    assert_true(arena.used < PIXELS * 4 + ZR_ARENA_ALIGN);
    assert_true(arena.peak > arena.used + PIXELS * 3); /* its coefficients among others */
    free(file.bytes);
}

TEST(every_ceiling_is_enough_or_fails_cleanly)
{
    const struct file baseline = make_file(&KINDS[5]), progressive = make_file(&KINDS[7]);
    assert_in_range(try_ceilings(baseline.bytes, baseline.size, 64), 100, 1000);
    assert_in_range(try_ceilings(progressive.bytes, progressive.size, 64), 100, 2000);
    free(baseline.bytes);
    free(progressive.bytes);
}

TEST(cancelled_reading_ends)
{
    struct zr_cancel cancel = {.raised = true};
    struct zr_reason reason;
    for (size_t k = 0; k < KIND_COUNT; k++) {
        const struct file file = make_file(&KINDS[k]);
        struct zr_image image = {0};
        fill_arena(0x5a);
        arena.cancel = &cancel;
        const enum zr_status status =
            zr_image_read(&arena, &(struct zr_encoded_image){file.bytes, file.size, TEXELS_MAX}, &image, &reason);
        arena.cancel = NULL;
        assert_int_equal(status, ZR_CANCELLED);
        assert_int_equal(texel_channel(&image, 3), 0x5a); /* no row was read: alpha would be 255 */
        free(file.bytes);
    }
}

TEST(files_with_any_bytes_changed_never_read_too_far_or_show_old_memory)
{
    enum { ROUNDS = IS_SANITIZED ? 1000 : 4000 };
    struct random random = random_seeded(23);
    static uint8_t first[1 << 16];
    int read = 0, refused = 0;
    for (size_t round = 0; round < ROUNDS; round++) {
        const struct file file = make_sized(&KINDS[round % KIND_COUNT], 19, 10);
        for (uint32_t k = 1 + random_below(&random, 3); k > 0; k--)
            file.bytes[random_below(&random, (uint32_t)file.size)] = (uint8_t)random_next(&random);
        const struct image_reading one = read_image_over(0xaa, file.bytes, file.size);
        assert_true(one.status == ZR_OK || (one.status == ZR_BAD_SCENE && *one.reason.text));
        const size_t size = one.status == ZR_OK ? (size_t)one.image.width * one.image.height * 4 : 0;
        const bool compares = size > 0 && size <= sizeof first;
        if (compares) memcpy(first, one.image.texels, size);
        const struct image_reading two = read_image_over(0x55, file.bytes, file.size);
        assert_int_equal(one.status, two.status);
        if (compares) assert_memory_equal(first, two.image.texels, size);
        read += one.status == ZR_OK;
        refused += one.status != ZR_OK;
        free(file.bytes);
    }
    assert_true(read > ROUNDS / 80 && refused > ROUNDS / 4);
}

RUN_TESTS(open_arena, close_arena)
