#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include "output/images/filter.h"
#include "output/images/palette.h"
#include "output/images/png.h"
#include "support/pictures/png.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA((size_t)1 << 30)

/* ---- pictures ---- */

enum subject { NOISE, FLAT, GRADIENT, COLORS_256, COLORS_257, ALPHA_FEW, ALPHA_MANY, SHAPES, STRIPES, SUBJECTS };

static uint32_t rgba(uint32_t r, uint32_t g, uint32_t b, uint32_t a)
{
    const uint8_t bytes[4] = {(uint8_t)r, (uint8_t)g, (uint8_t)b, (uint8_t)a};
    uint32_t pixel;
    memcpy(&pixel, bytes, sizeof pixel);
    return pixel;
}

/* As a rasterizer would: one colour, but for some boxes of others. */
static void draw_shapes(struct random *random, uint32_t *pixels, uint32_t width, uint32_t height)
{
    for (size_t i = 0; i < (size_t)width * height; i++)
        pixels[i] = rgba(255, 255, 255, 255);
    for (int i = 0; i < 400; i++) {
        uint32_t color = rgba((uint32_t)random_next(random), (uint32_t)random_next(random), 7, 255);
        uint32_t x0 = (uint32_t)(random_next(random) % width), y0 = (uint32_t)(random_next(random) % height);
        uint32_t w = (uint32_t)(random_next(random) % (width / 4 + 2)), h = (uint32_t)(random_next(random) % 40);
        for (uint32_t y = y0; y < y0 + h && y < height; y++)
            for (uint32_t x = x0; x < x0 + w && x < width; x++)
                pixels[(size_t)y * width + x] = color;
    }
}

static uint32_t *draw(enum subject subject, uint32_t width, uint32_t height)
{
    size_t count = (size_t)width * height;
    uint32_t *pixels = zr_arena_alloc(&arena, count, sizeof *pixels);
    struct random random = random_seeded(5 + subject);
    assert_non_null(pixels);
    if (subject == SHAPES) draw_shapes(&random, pixels, width, height);
    for (size_t i = 0; i < count && subject != SHAPES; i++) {
        uint32_t x = (uint32_t)(i % width), y = (uint32_t)(i / width), n = (uint32_t)random_next(&random);
        switch (subject) {
        case NOISE:
            pixels[i] = n | rgba(0, 0, 0, 255);
            break;
        case FLAT:
            pixels[i] = rgba(10, 200, 30, 255);
            break;
        case GRADIENT:
            pixels[i] = rgba(x / 3, y / 2, (x + y) / 5, 255);
            break;
        case COLORS_256:
        case COLORS_257: /* the last one in one pixel only, where no sample is likely to be taken */
            n = (uint32_t)(i % 256);
            pixels[i] = subject == COLORS_257 && i == count - 2 ? rgba(1, 2, 3, 255) : rgba(n, n * 7, 255 - n, 255);
            break;
        case ALPHA_FEW:
            pixels[i] = rgba(x % 3 * 100, 0, 0, (x + y) % 5 * 60);
            break;
        case ALPHA_MANY:
            pixels[i] = rgba(x, y, 0, x * y);
            break;
        default: /* runs of every length, rows now equal and now not */
            pixels[i] = rgba(x * x / 97 + (y % 3 == 2 ? y : 0), y / 7 * 3, 5, 255);
        }
    }
    return pixels;
}

/* ---- what a reader makes of a file ---- */

/* RGBA, or 16 bits in the machine's order; free it. */
static unsigned char *decode(const struct zr_buffer *file, uint32_t width, uint32_t height, bool grey16)
{
    uint32_t got_width, got_height;
    unsigned char *pixels =
        png_memory_read(file->bytes, file->size, grey16 ? PNG_AS_GREY16 : PNG_AS_RGBA, &got_width, &got_height);
    if (!pixels) fail_msg("libpng refuses the file, or it has something else than was asked for");
    assert_int_equal(got_width, width);
    assert_int_equal(got_height, height);
    return pixels;
}

/* The zlib stream of a file: what libpng leaves unread behind the last row, and the check sum, are looked at too. */
static void assert_whole_stream(const struct zr_buffer *file, size_t filtered)
{
    z_stream stream = {0};
    unsigned char *out = zr_arena_alloc(&arena, filtered + 1, 1);
    int status = Z_OK;
    assert_int_equal(inflateInit(&stream), Z_OK);
    stream.next_out = out;
    stream.avail_out = (uInt)(filtered + 1);
    for (size_t at = 8; at + 12 <= file->size;) {
        unsigned char *c = file->bytes + at;
        size_t size = (size_t)c[0] << 24 | (size_t)c[1] << 16 | (size_t)c[2] << 8 | c[3];
        if (memcmp(c + 4, "IDAT", 4) == 0) {
            stream.next_in = c + 8;
            stream.avail_in = (uInt)size;
            status = inflate(&stream, Z_NO_FLUSH);
        }
        at += size + 12;
    }
    assert_int_equal(status, Z_STREAM_END);
    assert_int_equal(stream.avail_in, 0);
    assert_int_equal(stream.total_out, filtered);
    inflateEnd(&stream);
}

static struct zr_buffer write_png(const struct zr_png *png, struct zr_team *team)
{
    struct zr_buffer out = {.arena = &arena};
    assert_int_equal(zr_png_write(png, team, NULL, &out), ZR_OK);
    return out;
}

static int color_type(const struct zr_buffer *file)
{
    return file->bytes[25]; /* IHDR */
}

static void assert_round_trip(const struct zr_png *png, struct zr_team *team)
{
    struct zr_buffer file = write_png(png, team);
    size_t count = (size_t)png->width * png->height;
    unsigned char *got = decode(&file, png->width, png->height, png->kind == ZR_PNG_GREY16);
    if (png->kind == ZR_PNG_GREY16) {
        assert_memory_equal(got, png->pixels, 2 * count);
    } else {
        const unsigned char *want = png->pixels;
        for (size_t i = 0; i < 4 * count; i++)
            if (got[i] != (png->kind == ZR_PNG_RGB && i % 4 == 3 ? 255 : want[i]))
                fail_msg("byte %zu of %u x %u is %d, not %d", i, png->width, png->height, got[i], want[i]);
    }
    free(got);
    int type = color_type(&file);
    size_t bytes = type == 3 ? 1 : type == 0 ? 2 : type == 2 ? 3 : 4;
    if (png->compress == ZR_COMPRESS_FAST) assert_whole_stream(&file, (png->width * bytes + 1) * png->height);
}

/* ---- tests ---- */

static const uint32_t SIZES[][2] = {{1, 1},     {1, 700},  {700, 1},    {2, 2},      {97, 61},    {16384, 3},
                                    {3, 16384}, {401, 33}, {1023, 777}, {70000, 19}, {1000, 1025}};
enum { SIZE_COUNT = sizeof SIZES / sizeof *SIZES };

TEST(pictures_of_every_kind_and_size_come_back)
{
    for (int s = 0; s < SIZE_COUNT; s++)
        for (int subject = 0; subject < SUBJECTS; subject++)
            for (int kind = 0; kind < 3; kind++)
                for (int small = 0; small < (SIZES[s][0] < 1000 ? 2 : 1); small++) {
                    zr_arena_reset(&arena, SIZE_MAX);
                    uint32_t width = SIZES[s][0], height = SIZES[s][1];
                    const void *pixels = draw((enum subject)subject, width, height);
                    struct zr_png png = {.kind = (enum zr_png_kind)kind,
                                         .width = width,
                                         .height = height,
                                         .pixels = pixels,
                                         .compress = (enum zr_compress)small};
                    assert_round_trip(&png, NULL);
                }
}

TEST(up_to_256_colors_are_a_palette_and_257_are_not)
{
    const struct {
        enum subject subject;
        enum zr_png_kind kind;
        int type;
    } cases[] = {{COLORS_256, ZR_PNG_RGB, 3},  {COLORS_256, ZR_PNG_RGBA, 3}, {COLORS_257, ZR_PNG_RGB, 2},
                 {COLORS_257, ZR_PNG_RGBA, 6}, {ALPHA_FEW, ZR_PNG_RGBA, 3},  {ALPHA_FEW, ZR_PNG_RGB, 3},
                 {ALPHA_MANY, ZR_PNG_RGBA, 6}, {FLAT, ZR_PNG_RGB, 3},        {NOISE, ZR_PNG_RGB, 2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        zr_arena_reset(&arena, SIZE_MAX);
        struct zr_png png = {
            .kind = cases[i].kind, .width = 999, .height = 300, .pixels = draw(cases[i].subject, 999, 300)};
        struct zr_buffer file = write_png(&png, NULL);
        assert_int_equal(color_type(&file), cases[i].type);
    }
}

TEST(pixels_are_the_same_for_every_team_and_whatever_memory_held)
{
    struct zr_team *teams[] = {NULL, zr_team_create(1), zr_team_create(2), zr_team_create(7)};
    const enum subject subjects[] = {NOISE, SHAPES, GRADIENT, COLORS_256};
    for (int i = 0; i < 4; i++)
        for (int kind = 0; kind < 3; kind++) {
            zr_arena_reset(&arena, SIZE_MAX);
            struct zr_png png = {
                .kind = (enum zr_png_kind)kind, .width = 2000, .height = 1531, .pixels = draw(subjects[i], 2000, 1531)};
            for (int t = 0; t < 4; t++)
                assert_round_trip(&png, teams[t]);
        }
    for (int t = 0; t < 4; t++)
        zr_team_destroy(teams[t]);
}

TEST(noise_hardly_grows_and_background_is_next_to_nothing)
{
    zr_arena_reset(&arena, SIZE_MAX);
    struct zr_png noise = {.kind = ZR_PNG_RGB, .width = 1920, .height = 1080, .pixels = draw(NOISE, 1920, 1080)};
    size_t raw = 1080 * (1920 * 3 + 1);
    assert_in_range(write_png(&noise, NULL).size, raw / 2, raw + raw / 1000 + 1000);
    struct zr_png flat = {.kind = ZR_PNG_RGB, .width = 1920, .height = 1080, .pixels = draw(FLAT, 1920, 1080)};
    assert_in_range(write_png(&flat, NULL).size, 100, 12000);
    struct zr_png grey = {.kind = ZR_PNG_GREY16, .width = 1920, .height = 1080, .pixels = flat.pixels};
    assert_in_range(write_png(&grey, NULL).size, 100, 25000);
}

TEST(small_is_smaller_than_fast)
{
    for (int kind = 0; kind < 3; kind++)
        for (int subject = FLAT; subject < SUBJECTS; subject++) { /* noise is what it is */
            zr_arena_reset(&arena, SIZE_MAX);
            struct zr_png png = {.kind = (enum zr_png_kind)kind,
                                 .width = 640,
                                 .height = 480,
                                 .pixels = draw((enum subject)subject, 640, 480)};
            size_t fast = write_png(&png, NULL).size;
            png.compress = ZR_COMPRESS_SMALL;
            size_t small = write_png(&png, NULL).size;
            if (small > fast) fail_msg("kind %d, subject %d: %zu bytes, and %zu fast", kind, subject, small, fast);
        }
}

/* Rows of random spans: bytes and sum against the definition. */
TEST(filtered_rows_and_their_sum_are_as_defined)
{
    struct random random = random_seeded(11);
    static uint8_t above[5000 * 4], row[5000 * 4], want[5000 * 4 + 1], got[5000 * 4 + 1 + ZR_FILTER_PADDING];
    for (int i = 0; i < 3000; i++) {
        enum zr_layout layout = (enum zr_layout)(random_next(&random) % ZR_LAYOUT_COUNT);
        uint32_t width = (uint32_t)(1 + random_next(&random) % (i % 10 ? 200 : 5000));
        size_t memory = zr_layout_memory(layout), file = zr_layout_file(layout);
        for (size_t k = 0; k < width * memory; k++)
            row[k] = above[k] = (uint8_t)random_next(&random);
        uint32_t begin = (uint32_t)(random_next(&random) % width), end = (uint32_t)(random_next(&random) % width);
        for (size_t k = begin * memory; k < end * memory; k++)
            row[k] = (uint8_t)random_next(&random);
        want[0] = 2;
        for (size_t x = 0; x < width; x++)
            for (size_t k = 0; k < file; k++) {
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
                size_t from = layout == ZR_LAYOUT_16 ? 2 * x + 1 - k : x * memory + k;
#else
                size_t from = x * memory + k;
#endif
                want[1 + x * file + k] = (uint8_t)(row[from] - above[from]);
            }
        struct zr_adler sum = zr_adler_begin();
        struct zr_column_span reach = {0, width}; /* or what is known to be enough */
        if (begin < end && i % 2)
            reach = (struct zr_column_span){begin - (uint32_t)(random_next(&random) % (begin + 1)),
                                            end + (uint32_t)(random_next(&random) % (width - end + 1))};
        zr_filter_row(layout, row, above, width, reach, got, &sum);
        assert_memory_equal(got, want, 1 + width * file);
        assert_int_equal(sum.b << 16 | sum.a, adler32(1, want, (uInt)(1 + width * file)));
    }
}

TEST(sums_of_the_largest_bytes_do_not_overflow)
{
    enum { WIDTH = 1 << 20 };
    zr_arena_reset(&arena, SIZE_MAX);
    uint8_t *row = zr_arena_alloc(&arena, WIDTH, 4), *above = zr_arena_zero(&arena, WIDTH, 4);
    uint8_t *out = zr_arena_alloc(&arena, 4 * WIDTH + 1 + ZR_FILTER_PADDING, 1);
    struct zr_adler sum = zr_adler_begin();
    memset(row, 255, 4 * (size_t)WIDTH);
    zr_filter_row(ZR_LAYOUT_RGBA, row, above, WIDTH, (struct zr_column_span){0, WIDTH}, out, &sum);
    assert_int_equal(sum.b << 16 | sum.a, adler32(1, out, 4 * WIDTH + 1));
}

TEST(what_is_cancelled_or_has_no_memory_ends_cleanly)
{
    zr_arena_reset(&arena, SIZE_MAX);
    struct zr_team *team = zr_team_create(3);
    struct zr_cancel cancel = {.raised = true};
    const uint32_t *pixels = draw(SHAPES, 1000, 900);
    for (int small = 0; small < 2; small++) {
        struct zr_png png = {.kind = ZR_PNG_RGB,
                             .width = 1000,
                             .height = 900,
                             .pixels = pixels,
                             .text = "text",
                             .compress = (enum zr_compress)small};
        struct zr_buffer out = {.arena = &arena};
        assert_int_equal(zr_png_write(&png, team, &cancel, &out), ZR_CANCELLED);
        int failures = 0, successes = 0;
        for (size_t ceiling = 0; ceiling < 24000000; ceiling += 500000) {
            struct zr_arena little;
            zr_arena_init(&little, ceiling);
            struct zr_buffer file = {.arena = &little};
            enum zr_status status = zr_png_write(&png, team, NULL, &file);
            assert_true(status == ZR_OK || status == ZR_NO_MEMORY);
            failures += status != ZR_OK;
            successes += status == ZR_OK;
            zr_arena_free(&little);
        }
        assert_true(failures > 0 && successes > 0);
    }
    zr_team_destroy(team);
}

TEST(pngcheck_is_content)
{
    if (system("command -v pngcheck >/dev/null 2>&1") != 0) {
        fprintf(stderr, "LEFT OUT: there is no pngcheck\n");
        skip();
    }
    for (int subject = 0; subject < SUBJECTS; subject++)
        for (int kind = 0; kind < 3; kind++)
            for (int small = 0; small < 2; small++) {
                zr_arena_reset(&arena, SIZE_MAX);
                struct zr_png png = {.kind = (enum zr_png_kind)kind,
                                     .width = 601,
                                     .height = 500,
                                     .pixels = draw((enum subject)subject, 601, 500),
                                     .text = "a text",
                                     .compress = (enum zr_compress)small};
                struct zr_buffer file = write_png(&png, NULL);
                char path[] = "/tmp/zraster-test-XXXXXX", command[80];
                int descriptor = mkstemp(path);
                assert_true(descriptor >= 0);
                assert_int_equal(write(descriptor, file.bytes, file.size), (ssize_t)file.size);
                close(descriptor);
                snprintf(command, sizeof command, "pngcheck -q %s >&2", path);
                int status = system(command);
                unlink(path);
                if (status != 0) fail_msg("subject %d, kind %d, compress %d", subject, kind, small);
            }
}

RUN_TESTS(open_arena, close_arena)
