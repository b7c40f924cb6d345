/* Images: PNGs of every kind, what is not quite one, and what is none. JPEGs are in test_jpeg_read.c. */
#include "base/cancel.h"
#include "support/sanitized.h"
#include "support/tests.h"
#include "unit/common/image_check.h"
#include "unit/common/png_files.h"

static const int COLORS[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_PALETTE, PNG_COLOR_TYPE_GRAY_ALPHA,
                             PNG_COLOR_TYPE_RGB_ALPHA};

/* What the specification has: its table of colour types and bit depths. */
static bool is_kind(int color, int bits)
{
    if (color == PNG_COLOR_TYPE_GRAY) return true;
    return color == PNG_COLOR_TYPE_PALETTE ? bits <= 8 : bits >= 8;
}

enum { KINDS_MAX = 64 };

/* All of them, interlaced and not, with and without a transparent colour. */
static size_t list_kinds(struct png_kind kinds[KINDS_MAX])
{
    size_t count = 0;
    for (size_t c = 0; c < sizeof COLORS / sizeof *COLORS; c++)
        for (int bits = 1; bits <= 16; bits *= 2)
            for (int i = 0; i < 4 && is_kind(COLORS[c], bits); i++)
                if (i < 2 || !(COLORS[c] & PNG_COLOR_MASK_ALPHA))
                    kinds[count++] = (struct png_kind){COLORS[c], bits, i % 2, i >= 2, i == 1};
    return count;
}

TEST(every_kind_of_png_gives_its_values)
{
    struct random random = random_seeded(17);
    struct png_kind kinds[KINDS_MAX];
    static struct png_file file;
    const size_t count = list_kinds(kinds);
    assert_int_equal(count, 4 * (5 + 2 + 4) + 2 * (2 + 2));
    for (size_t k = 0; k < count; k++) {
        unsigned char samples[PNG_SAMPLES_MAX];
        const size_t stride = png_make_samples(&random, kinds[k], samples);
        png_file_make(&file, kinds[k], samples, stride);
        const struct image_reading reading = read_image(file.bytes, file.size);
        assert_image(&reading, PNG_WIDTH, PNG_HEIGHT, kinds[k].bits == 16 ? 16 : 8);
        for (size_t i = 0; i < PNG_PIXELS; i++) {
            unsigned want[4];
            png_expect(kinds[k], samples + i / PNG_WIDTH * stride, i % PNG_WIDTH, want);
            for (size_t c = 0; c < 4; c++)
                if (texel_channel(&reading.image, 4 * i + c) != want[c])
                    fail_msg("colour %d of %d bits, texel %zu, channel %zu: %u, not %u", kinds[k].color, kinds[k].bits,
                             i, c, texel_channel(&reading.image, 4 * i + c), want[c]);
        }
    }
}

static struct png_file a_file(int color, int bits, int interlace)
{
    struct random random = random_seeded(19);
    unsigned char samples[PNG_SAMPLES_MAX];
    static struct png_file file;
    const struct png_kind kind = {color, bits, interlace, false, false};
    png_file_make(&file, kind, samples, png_make_samples(&random, kind, samples));
    return file;
}

TEST(files_cut_anywhere_are_refused)
{
    for (int interlace = 0; interlace < 2; interlace++) {
        const struct png_file rgba = a_file(PNG_COLOR_TYPE_RGB_ALPHA, 16, interlace),
                              palette = a_file(PNG_COLOR_TYPE_PALETTE, 2, interlace);
        refuse_cut(rgba.bytes, rgba.size);
        refuse_cut(palette.bytes, palette.size);
    }
}

/* Of a file that is whole, each bit of what stands behind the header. */
TEST(no_bit_may_be_wrong)
{
    enum { BEHIND_HEADER = 33 };
    struct png_file file = a_file(PNG_COLOR_TYPE_RGB, 8, 0);
    int skipped = 0;
    for (size_t bit = 8 * BEHIND_HEADER; bit < 8 * file.size; bit += IS_SANITIZED ? 5 : 1) {
        file.bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        const struct image_reading reading = read_image(file.bytes, file.size);
        file.bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        if (reading.status == ZR_OK) fail_msg("byte %zu, bit %zu may be wrong", bit / 8, bit % 8);
        skipped += reading.status != ZR_BAD_SCENE;
    }
    assert_int_equal(skipped, 0);
}

/* The stream of the rows says where it ends, and more than the rows need is none of theirs. */
TEST(more_data_than_rows_are_refused)
{
    struct png_file file = a_file(PNG_COLOR_TYPE_RGB, 8, 0), longer = {.size = 33};
    const unsigned char *data = memmem(file.bytes, file.size, "IDAT", 4);
    assert_non_null(data);
    const uint32_t size = (uint32_t)data[-4] << 24 | (uint32_t)data[-3] << 16 | (uint32_t)data[-2] << 8 | data[-1];
    memcpy(longer.bytes, file.bytes, 33);
    png_insert_chunk(&longer, "IEND", "", 0);
    png_insert_chunk(&longer, "IDAT", data + 4, size);
    assert_int_equal(read_image(longer.bytes, longer.size).status, ZR_OK);
    unsigned char more[4096];
    memcpy(more, data + 4, size);
    memcpy(more + size, "more", 4);
    longer.size = 33;
    png_insert_chunk(&longer, "IEND", "", 0);
    png_insert_chunk(&longer, "IDAT", more, size + 4);
    assert_refused(longer.bytes, longer.size, "a broken PNG: Extra compress");
}

TEST(what_follows_the_end_is_not_looked_at)
{
    struct png_file file = a_file(PNG_COLOR_TYPE_RGB, 8, 1);
    memset(file.bytes + file.size, 0xff, 5000);
    assert_int_equal(read_image(file.bytes, file.size + 5000).status, ZR_OK);
}

TEST(huge_pictures_cost_nothing)
{
    static const struct {
        uint32_t width, height;
        const char *why;
    } cases[] = {{16385, 1, "16385 x 1 texels; up to 16384 per side are allowed"},
                 {1, 0x7fffffff, "up to 16384 per side"},
                 {0xffffffff, 0xffffffff, "up to 16384 per side"},
                 {1024, 1025, "1024 x 1025 texels; 1048576 are left of imagePixelsMax"},
                 {0, 7, "both sides must be at least 1"},
                 {7, 0, "both sides must be at least 1"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct png_file file = a_file(PNG_COLOR_TYPE_RGB, 8, 0);
        for (int k = 0; k < 4; k++) {
            file.bytes[16 + k] = (unsigned char)(cases[i].width >> (24 - 8 * k));
            file.bytes[20 + k] = (unsigned char)(cases[i].height >> (24 - 8 * k));
        }
        png_mend(&file);
        assert_refused(file.bytes, file.size, cases[i].why);
        assert_int_equal(arena.peak, 0);
    }
}

TEST(libraries_give_back_what_they_took)
{
    const struct png_file file = a_file(PNG_COLOR_TYPE_RGB_ALPHA, 16, 1);
    assert_int_equal(read_image(file.bytes, file.size).status, ZR_OK);
    assert_true(arena.used < PNG_PIXELS * 8 + ZR_ARENA_ALIGN);
    assert_true(arena.peak > arena.used + (8 << 10));
}

TEST(every_ceiling_is_enough_or_fails_cleanly)
{
    const struct png_file file = a_file(PNG_COLOR_TYPE_RGB_ALPHA, 16, 1);
    assert_in_range(try_ceilings(file.bytes, file.size, 64), 100, 1000);
}

TEST(cancelled_reading_ends)
{
    const struct png_file file = a_file(PNG_COLOR_TYPE_RGB, 8, 0);
    struct zr_cancel cancel = {.raised = true};
    struct zr_image image;
    struct zr_reason reason;
    arena.cancel = &cancel;
    assert_int_equal(
        zr_image_read(&arena, &(struct zr_encoded_image){file.bytes, file.size, TEXELS_MAX}, &image, &reason),
        ZR_CANCELLED);
    cancel.raised = false;
    assert_int_equal(
        zr_image_read(&arena, &(struct zr_encoded_image){file.bytes, file.size, TEXELS_MAX}, &image, &reason), ZR_OK);
    arena.cancel = NULL;
}

TEST(what_is_no_picture_is_named)
{
    static const struct {
        const char *bytes;
        size_t size;
        const char *why;
    } cases[] = {{"", 0, "no bytes; a PNG, JPEG or WebP picture is needed"},
                 {"GIF89a", 6, "it looks like a GIF picture; a PNG, JPEG or WebP picture is needed"},
                 {"RIFF\x10\0\0\0WAVE", 12, "it looks like a RIFF file, as WebP pictures are;"},
                 {"RIFF\x10\0\0\0WEBP", 12, "a broken WebP: it ends too early"},
                 {"BM123", 5, "a BMP picture"},
                 {"II*\0", 4, "a TIFF picture"},
                 {"\xABKTX 20\xBB", 8, "a KTX texture"},
                 {"\x1F\x8B\x08", 3, "gzip"},
                 {"<svg xmlns=''/>", 15, "XML or HTML"},
                 {"{\"a\": 1}", 8, "it looks like JSON"},
                 {"\x89PNG\r\n\x1a\n", 8, "it looks like a PNG picture"},
                 {"\xFF\xD8", 2, "it begins with '?"},
                 {"whatever it is", 14, "it begins with 'whatever', which is no known picture format"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        assert_refused(cases[i].bytes, cases[i].size, cases[i].why);
}

TEST(files_with_any_bytes_changed_never_read_too_far_or_show_old_memory)
{
    enum { ROUNDS = IS_SANITIZED ? 1000 : 4000 };
    struct random random = random_seeded(21);
    struct png_kind kinds[KINDS_MAX];
    static struct png_file file;
    static unsigned char first[PNG_SAMPLES_MAX];
    const size_t count = list_kinds(kinds);
    int read = 0, refused = 0;
    for (size_t round = 0; round < ROUNDS; round++) {
        unsigned char samples[PNG_SAMPLES_MAX];
        const struct png_kind kind = kinds[round % count];
        png_file_make(&file, kind, samples, png_make_samples(&random, kind, samples));
        for (uint32_t k = 1 + random_below(&random, 4); k > 0; k--)
            file.bytes[random_below(&random, (uint32_t)file.size)] = (unsigned char)random_next(&random);
        if (round % 4) png_mend(&file);
        const struct image_reading one = read_image_over(0xaa, file.bytes, file.size);
        const size_t size = one.status == ZR_OK ? (size_t)one.image.width * one.image.height * one.image.bits / 2 : 0;
        assert_true(one.status == ZR_OK || (one.status == ZR_BAD_SCENE && *one.reason.text));
        const bool compares = size <= sizeof first;
        if (size > 0 && compares) memcpy(first, one.image.texels, size);
        const struct image_reading two = read_image_over(0x55, file.bytes, file.size);
        assert_int_equal(one.status, two.status);
        if (size > 0 && compares) assert_memory_equal(first, two.image.texels, size);
        read += one.status == ZR_OK;
        refused += one.status != ZR_OK;
    }
    assert_true(read > ROUNDS / 80 && refused > ROUNDS / 4);
}

RUN_TESTS(open_arena, close_arena)
