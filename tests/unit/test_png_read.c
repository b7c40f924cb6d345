/* PNGs of every kind that hold 8 bits, and everything that is not quite one. */
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "guarded.h"
#include "input/png_read.h"
#include "support/cmocka_all.h"
#include "support/random.h"
#include "support/test_arena.h"

enum { WIDTH = 13, HEIGHT = 9, PIXELS = WIDTH * HEIGHT, FILE_MAX = 1 << 16 };

TEST_ARENA(1 << 24)

struct file {
    unsigned char bytes[FILE_MAX];
    size_t size;
};

static enum zr_status read_file(const void *bytes, size_t size, uint8_t **rgba, struct zr_reason *reason)
{
    struct guarded guarded = guarded_copy(bytes, size);
    zr_arena_reset(&arena, 1 << 24);
    enum zr_status status = zr_png_read(&arena, guarded.bytes, size, WIDTH, HEIGHT, rgba, reason);
    guarded_free(&guarded);
    return status;
}

static void append(png_structp png, png_bytep bytes, size_t size)
{
    struct file *file = png_get_io_ptr(png);
    assert_true(file->size + size <= FILE_MAX);
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
}

/* What a file is made of beside its samples. */
struct kind {
    int color, bits, interlace;
    bool key;   /* a transparent palette entry or colour */
    bool gamma; /* says what would change the values if it were applied */
};

static const png_color PALETTE[4] = {{1, 2, 3}, {200, 100, 50}, {255, 0, 128}, {7, 7, 7}};

/* `samples` are rows of packed samples, `stride` bytes each. */
static void write_file(struct file *file, struct kind kind, png_bytep samples, size_t stride)
{
    file->size = 0;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, file, append, NULL);
    png_set_IHDR(png, info, WIDTH, HEIGHT, kind.bits, kind.color, kind.interlace, 0, 0);
    if (kind.color == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, PALETTE, 4);
    png_byte alphas[2] = {255, 77};
    png_color_16 key = {.red = 10, .green = 20, .blue = 30, .gray = 1};
    if (kind.key) png_set_tRNS(png, info, alphas, 2, &key);
    if (kind.gamma) png_set_gAMA(png, info, 1.0);
    png_write_info(png, info);
    png_bytep rows[HEIGHT];
    for (size_t y = 0; y < HEIGHT; y++)
        rows[y] = samples + y * stride;
    png_write_image(png, rows);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
}

static unsigned sample(const unsigned char *row, size_t x, int bits)
{
    size_t bit = x * (size_t)bits;
    return (unsigned)row[bit / 8] >> (8 - bits - (int)(bit % 8)) & ((1u << bits) - 1);
}

/* What the pixel is, by the letter of the specification. */
static void expect(struct kind kind, const unsigned char *row, size_t x, uint8_t want[4])
{
    const unsigned char *at = row;
    unsigned value;
    want[3] = 255;
    switch (kind.color) {
    case PNG_COLOR_TYPE_GRAY:
        value = sample(row, x, kind.bits);
        memset(want, (int)(value * 255 / ((1u << kind.bits) - 1)), 3);
        if (kind.key && value == 1) want[3] = 0;
        break;
    case PNG_COLOR_TYPE_PALETTE:
        value = sample(row, x, kind.bits);
        memcpy(want, &PALETTE[value], 3);
        if (kind.key && value == 1) want[3] = 77;
        break;
    case PNG_COLOR_TYPE_GRAY_ALPHA:
        memset(want, at[2 * x], 3);
        want[3] = at[2 * x + 1];
        break;
    case PNG_COLOR_TYPE_RGB:
        memcpy(want, at + 3 * x, 3);
        if (kind.key && memcmp(want, "\x0a\x14\x1e", 3) == 0) want[3] = 0;
        break;
    default:
        memcpy(want, at + 4 * x, 4);
    }
}

static const struct kind KINDS[] = {
    {PNG_COLOR_TYPE_RGB, 8, 0, false, false},       {PNG_COLOR_TYPE_RGB_ALPHA, 8, 0, false, false},
    {PNG_COLOR_TYPE_GRAY, 8, 0, false, false},      {PNG_COLOR_TYPE_GRAY_ALPHA, 8, 0, false, false},
    {PNG_COLOR_TYPE_PALETTE, 8, 0, false, false},   {PNG_COLOR_TYPE_RGB, 8, 1, false, true},
    {PNG_COLOR_TYPE_RGB_ALPHA, 8, 1, false, true},  {PNG_COLOR_TYPE_GRAY, 8, 1, true, true},
    {PNG_COLOR_TYPE_GRAY_ALPHA, 8, 1, false, true}, {PNG_COLOR_TYPE_PALETTE, 8, 1, true, true},
    {PNG_COLOR_TYPE_RGB, 8, 0, true, false},        {PNG_COLOR_TYPE_GRAY, 1, 0, false, false},
    {PNG_COLOR_TYPE_GRAY, 2, 1, true, false},       {PNG_COLOR_TYPE_GRAY, 4, 0, true, true},
    {PNG_COLOR_TYPE_PALETTE, 2, 0, true, false},    {PNG_COLOR_TYPE_PALETTE, 4, 1, true, false},
};

static size_t make_samples(struct random *random, struct kind kind, unsigned char *samples)
{
    int channels = kind.color == PNG_COLOR_TYPE_RGB         ? 3
                   : kind.color == PNG_COLOR_TYPE_RGB_ALPHA ? 4
                                                            : 1 + (kind.color == PNG_COLOR_TYPE_GRAY_ALPHA);
    size_t stride = (size_t)(WIDTH * channels * kind.bits + 7) / 8;
    for (size_t i = 0; i < HEIGHT * stride; i++) {
        samples[i] = (unsigned char)random_next(random);
        if (kind.color == PNG_COLOR_TYPE_PALETTE) samples[i] &= kind.bits == 8 ? 3 : kind.bits == 4 ? 0x33 : 0xff;
    }
    if (kind.color == PNG_COLOR_TYPE_RGB) memcpy(samples, "\x0a\x14\x1e", 3);
    return stride;
}

static void every_kind_gives_its_values_unchanged(void **state)
{
    (void)state;
    struct random random = random_seeded(17);
    static struct file file;
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; k++) {
        unsigned char samples[PIXELS * 4];
        size_t stride = make_samples(&random, KINDS[k], samples);
        write_file(&file, KINDS[k], samples, stride);
        struct zr_reason reason = {""};
        uint8_t *rgba;
        if (read_file(file.bytes, file.size, &rgba, &reason) != ZR_OK) fail_msg("kind %zu: %s", k, reason.text);
        for (size_t i = 0; i < PIXELS; i++) {
            uint8_t want[4];
            expect(KINDS[k], samples + i / WIDTH * stride, i % WIDTH, want);
            if (memcmp(rgba + 4 * i, want, 4) != 0)
                fail_msg("kind %zu, pixel %zu: %u %u %u %u, not %u %u %u %u", k, i, rgba[4 * i], rgba[4 * i + 1],
                         rgba[4 * i + 2], rgba[4 * i + 3], want[0], want[1], want[2], want[3]);
        }
    }
}

static void sixteen_bits_are_refused(void **state)
{
    (void)state;
    static unsigned char samples[PIXELS * 8];
    static struct file file;
    struct zr_reason reason = {""};
    uint8_t *rgba;
    write_file(&file, (struct kind){PNG_COLOR_TYPE_RGB_ALPHA, 16, 0, false, false}, samples, WIDTH * 8);
    assert_int_equal(read_file(file.bytes, file.size, &rgba, &reason), ZR_BAD_SCENE);
    assert_non_null(strstr(reason.text, "16 bits a channel"));
}

static void picture_of_another_size_is_refused_before_it_costs_anything(void **state)
{
    (void)state;
    static unsigned char samples[PIXELS * 4];
    static struct file file;
    struct zr_reason reason = {""};
    uint8_t *rgba;
    write_file(&file, KINDS[1], samples, WIDTH * 4);
    zr_arena_reset(&arena, 0);
    const uint32_t sizes[4][2] = {{WIDTH + 1, HEIGHT}, {WIDTH, HEIGHT - 1}, {HEIGHT, WIDTH}, {8192, 8192}};
    for (int i = 0; i < 4; i++) {
        assert_int_equal(zr_png_read(&arena, file.bytes, file.size, sizes[i][0], sizes[i][1], &rgba, &reason),
                         ZR_BAD_SCENE);
        assert_non_null(strstr(reason.text, "13 x 9 pixels, not the window's"));
        assert_int_equal(arena.used, 0);
    }
}

static void what_is_no_png_is_refused(void **state)
{
    (void)state;
    struct zr_reason reason = {""};
    uint8_t *rgba;
    assert_int_equal(read_file("", 0, &rgba, &reason), ZR_BAD_SCENE);
    static const char jpeg[64] = "\xff\xd8\xff\xe0\0\x10JFIF";
    assert_int_equal(read_file(jpeg, sizeof jpeg, &rgba, &reason), ZR_BAD_SCENE);
    assert_string_equal(reason.text, "not a PNG");
}

/* A chunk of that name and data behind the header. */
static void insert_chunk(struct file *file, const char *name, const void *data, uint32_t size)
{
    enum { BEHIND_HEADER = 33 };
    unsigned char *at = file->bytes + BEHIND_HEADER;
    assert_true(file->size + size + 12 <= FILE_MAX);
    memmove(at + size + 12, at, file->size - BEHIND_HEADER);
    file->size += size + 12;
    const unsigned char length[4] = {(unsigned char)(size >> 24), (unsigned char)(size >> 16),
                                     (unsigned char)(size >> 8), (unsigned char)size};
    memcpy(at, length, 4);
    memcpy(at + 4, name, 4);
    memcpy(at + 8, data, size);
    uint32_t sum = (uint32_t)crc32(0, at + 4, size + 4);
    const unsigned char crc[4] = {(unsigned char)(sum >> 24), (unsigned char)(sum >> 16), (unsigned char)(sum >> 8),
                                  (unsigned char)sum};
    memcpy(at + 8 + size, crc, 4);
}

/* 10 MB of zeros in 10 kB, in chunks that libpng would unpack or keep. */
static void packed_text_and_profiles_are_passed_over(void **state)
{
    (void)state;
    static unsigned char samples[PIXELS * 4], zeros[10 << 20], packed[16 << 10];
    static struct file file;
    struct zr_reason reason = {""};
    uint8_t *rgba;
    uLongf size = sizeof packed - 8;
    memcpy(packed, "text\0\0", 6);
    assert_int_equal(compress(packed + 6, &size, zeros, sizeof zeros), Z_OK);
    write_file(&file, KINDS[1], samples, WIDTH * 4);
    assert_int_equal(read_file(file.bytes, file.size, &rgba, &reason), ZR_OK);
    size_t plain = arena.used;
    for (int i = 0; i < 2; i++) {
        insert_chunk(&file, "zTXt", packed, (uint32_t)size + 6);
        insert_chunk(&file, "iCCP", packed, (uint32_t)size + 6);
    }
    insert_chunk(&file, "prIv", packed, (uint32_t)size + 6);
    assert_int_equal(read_file(file.bytes, file.size, &rgba, &reason), ZR_OK);
    assert_true(arena.used <= plain + 4096);
}

/* Megabytes of zeros in kilobytes, and then what is no stream at all: none of it is looked at. */
static void data_behind_the_last_row_are_not_read(void **state)
{
    (void)state;
    enum { SIZE = 16 << 10 };
    static unsigned char samples[PIXELS * 4], behind[SIZE];
    static struct file file, longer;
    struct zr_reason reason = {""};
    uint8_t *rgba, first[PIXELS * 4];
    write_file(&file, KINDS[1], samples, WIDTH * 4);
    assert_int_equal(read_file(file.bytes, file.size, &rgba, &reason), ZR_OK);
    memcpy(first, rgba, sizeof first);
    memset(behind, 0xff, sizeof behind);
    const unsigned char *data = memmem(file.bytes, file.size, "IDAT", 4);
    assert_non_null(data);
    size_t rows = (size_t)data[-4] << 24 | (size_t)data[-3] << 16 | (size_t)data[-2] << 8 | data[-1];
    longer = (struct file){.size = 33};
    memcpy(longer.bytes, file.bytes, 33);
    insert_chunk(&longer, "IDAT", behind, sizeof behind);
    insert_chunk(&longer, "IDAT", data + 4, (uint32_t)rows);
    assert_int_equal(read_file(longer.bytes, longer.size, &rgba, &reason), ZR_OK);
    assert_memory_equal(rgba, first, sizeof first);
}

static void every_ceiling_is_enough_or_fails_cleanly(void **state)
{
    (void)state;
    static unsigned char samples[PIXELS * 4];
    static struct file file;
    struct zr_reason reason = {""};
    uint8_t *rgba;
    int failed = 0;
    write_file(&file, KINDS[6], samples, WIDTH * 4);
    for (size_t ceiling = 0; ceiling < 1 << 18; ceiling += 512) {
        struct zr_arena small;
        zr_arena_init(&small, ceiling);
        enum zr_status status = zr_png_read(&small, file.bytes, file.size, WIDTH, HEIGHT, &rgba, &reason);
        zr_arena_free(&small);
        if (status == ZR_OK) break;
        assert_int_equal(status, ZR_NO_MEMORY);
        failed++;
    }
    assert_in_range(failed, 10, 511);
}

static void files_cut_anywhere_are_refused(void **state)
{
    (void)state;
    struct random random = random_seeded(19);
    static struct file file;
    unsigned char samples[PIXELS * 4];
    struct zr_reason reason = {""};
    uint8_t *rgba;
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; k += 6) {
        uint8_t whole[PIXELS * 4];
        size_t shortest = 0;
        write_file(&file, KINDS[k], samples, make_samples(&random, KINDS[k], samples));
        assert_int_equal(read_file(file.bytes, file.size, &rgba, &reason), ZR_OK);
        memcpy(whole, rgba, sizeof whole);
        for (size_t cut = 0; cut < file.size; cut++) {
            reason.text[0] = '\0';
            enum zr_status status = read_file(file.bytes, cut, &rgba, &reason);
            if (status == ZR_OK) { /* all rows were there: only what ends the file is not */
                assert_memory_equal(rgba, whole, sizeof whole);
                if (shortest == 0) shortest = cut;
                continue;
            }
            assert_int_equal(status, ZR_BAD_SCENE);
            assert_true(shortest == 0 && reason.text[0] != '\0');
        }
        enum { END_OF_DATA = 4 + 4, END_CHUNK = 12 }; /* adler32 and CRC; IEND */
        assert_true(shortest == 0 || shortest + END_OF_DATA + END_CHUNK + 8 >= file.size);
    }
}

/* With their checksums mended, so that libpng looks at what was changed. */
static void mend(struct file *file)
{
    size_t at = 8;
    while (file->size - at >= 12) {
        const unsigned char *c = file->bytes + at;
        size_t size = (size_t)c[0] << 24 | (size_t)c[1] << 16 | (size_t)c[2] << 8 | c[3];
        if (size > file->size - at - 12) return;
        uint32_t sum = (uint32_t)crc32(0, c + 4, (uInt)size + 4);
        for (int i = 0; i < 4; i++)
            file->bytes[at + 8 + size + (size_t)i] = (unsigned char)(sum >> (24 - 8 * i));
        at += size + 12;
    }
}

/* What lay in the arena before, as another request's pictures might. */
static void fill_arena(int byte)
{
    enum { ROOM = 1 << 17 };
    zr_arena_reset(&arena, 1 << 24);
    memset(zr_arena_alloc(&arena, ROOM, 1), byte, ROOM);
}

static void files_with_any_bytes_changed_never_read_too_far_or_show_old_memory(void **state)
{
    (void)state;
    struct random random = random_seeded(21);
    static struct file file, mutated;
    unsigned char samples[PIXELS * 4], first[PIXELS * 4];
    int read = 0, refused = 0;
    for (int round = 0; round < 6000; round++) {
        struct kind kind = KINDS[(size_t)round % (sizeof KINDS / sizeof *KINDS)];
        write_file(&file, kind, samples, make_samples(&random, kind, samples));
        mutated = file;
        for (uint32_t k = 1 + random_below(&random, 4); k > 0; k--)
            mutated.bytes[random_below(&random, (uint32_t)file.size)] = (unsigned char)random_next(&random);
        if (round % 3) mend(&mutated);
        enum zr_status statuses[2];
        for (int turn = 0; turn < 2; turn++) {
            struct zr_reason reason = {""};
            uint8_t *rgba;
            fill_arena(turn ? 0x55 : 0xaa);
            statuses[turn] = read_file(mutated.bytes, mutated.size, &rgba, &reason);
            assert_true(statuses[turn] == ZR_OK || statuses[turn] == ZR_BAD_SCENE);
            assert_int_equal(statuses[turn] == ZR_OK, reason.text[0] == '\0');
            if (statuses[turn] != ZR_OK) continue;
            if (turn == 0) memcpy(first, rgba, sizeof first);
            if (turn == 1) assert_memory_equal(first, rgba, sizeof first);
        }
        assert_int_equal(statuses[0], statuses[1]);
        read += statuses[0] == ZR_OK;
        refused += statuses[0] != ZR_OK;
    }
    assert_true(read > 50 && refused > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_gives_its_values_unchanged),
        cmocka_unit_test(sixteen_bits_are_refused),
        cmocka_unit_test(picture_of_another_size_is_refused_before_it_costs_anything),
        cmocka_unit_test(what_is_no_png_is_refused),
        cmocka_unit_test(packed_text_and_profiles_are_passed_over),
        cmocka_unit_test(data_behind_the_last_row_are_not_read),
        cmocka_unit_test(every_ceiling_is_enough_or_fails_cleanly),
        cmocka_unit_test(files_cut_anywhere_are_refused),
        cmocka_unit_test(files_with_any_bytes_changed_never_read_too_far_or_show_old_memory),
    };
    return cmocka_run_group_tests_name("png_read", tests, open_arena, close_arena);
}
