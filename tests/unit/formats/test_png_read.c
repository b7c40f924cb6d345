/* PNGs of every kind that hold 8 bits, and everything that is not quite one. */
#include <stdlib.h>

#include "input/images/image_file.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "unit/common/guarded.h"
#include "unit/common/png_files.h"

TEST_ARENA(1 << 24)

static const struct zr_png_head window = {PNG_WIDTH, PNG_HEIGHT, 8};

static enum zr_status read_file(const void *bytes, size_t size, uint8_t **rgba, struct zr_reason *reason)
{
    struct guarded guarded = guarded_copy(bytes, size);
    zr_arena_reset(&arena, 1 << 24);
    enum zr_status status = zr_png_read(&arena, &(struct zr_parsed_bytes){guarded.bytes, size}, &window, rgba, reason);
    guarded_free(&guarded);
    return status;
}

static const struct png_kind KINDS[] = {
    {PNG_COLOR_TYPE_RGB, 8, 0, false, false},       {PNG_COLOR_TYPE_RGB_ALPHA, 8, 0, false, false},
    {PNG_COLOR_TYPE_GRAY, 8, 0, false, false},      {PNG_COLOR_TYPE_GRAY_ALPHA, 8, 0, false, false},
    {PNG_COLOR_TYPE_PALETTE, 8, 0, false, false},   {PNG_COLOR_TYPE_RGB, 8, 1, false, true},
    {PNG_COLOR_TYPE_RGB_ALPHA, 8, 1, false, true},  {PNG_COLOR_TYPE_GRAY, 8, 1, true, true},
    {PNG_COLOR_TYPE_GRAY_ALPHA, 8, 1, false, true}, {PNG_COLOR_TYPE_PALETTE, 8, 1, true, true},
    {PNG_COLOR_TYPE_RGB, 8, 0, true, false},        {PNG_COLOR_TYPE_GRAY, 1, 0, false, false},
    {PNG_COLOR_TYPE_GRAY, 2, 1, true, false},       {PNG_COLOR_TYPE_GRAY, 4, 0, true, true},
    {PNG_COLOR_TYPE_PALETTE, 2, 0, true, false},    {PNG_COLOR_TYPE_PALETTE, 4, 1, true, false},
};

TEST(every_kind_gives_its_values_unchanged)
{
    struct random random = random_seeded(17);
    static struct png_file file;
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; k++) {
        unsigned char samples[PNG_PIXELS * 4];
        size_t stride = png_make_samples(&random, KINDS[k], samples);
        png_file_make(&file, KINDS[k], samples, stride);
        struct zr_reason reason = {""};
        uint8_t *rgba;
        if (read_file(file.bytes, file.size, &rgba, &reason) != ZR_OK) fail_msg("kind %zu: %s", k, reason.text);
        for (size_t i = 0; i < PNG_PIXELS; i++) {
            unsigned want[4];
            png_expect(KINDS[k], samples + i / PNG_WIDTH * stride, i % PNG_WIDTH, want);
            if (rgba[4 * i] != want[0] || rgba[4 * i + 1] != want[1] || rgba[4 * i + 2] != want[2] ||
                rgba[4 * i + 3] != want[3])
                fail_msg("kind %zu, pixel %zu: %u %u %u %u, not %u %u %u %u", k, i, rgba[4 * i], rgba[4 * i + 1],
                         rgba[4 * i + 2], rgba[4 * i + 3], want[0], want[1], want[2], want[3]);
        }
    }
}

TEST(sixteen_bits_are_refused)
{
    static unsigned char samples[PNG_PIXELS * 8];
    static struct png_file file;
    struct zr_reason reason = {""};
    uint8_t *rgba;
    png_file_make(&file, (struct png_kind){PNG_COLOR_TYPE_RGB_ALPHA, 16, 0, false, false}, samples, PNG_WIDTH * 8);
    assert_int_equal(read_file(file.bytes, file.size, &rgba, &reason), ZR_BAD_SCENE);
    assert_non_null(strstr(reason.text, "16 bits per channel"));
}

TEST(picture_of_another_size_is_refused_before_it_costs_anything)
{
    static unsigned char samples[PNG_PIXELS * 4];
    static struct png_file file;
    struct zr_reason reason = {""};
    uint8_t *rgba;
    png_file_make(&file, KINDS[1], samples, PNG_WIDTH * 4);
    zr_arena_reset(&arena, 0);
    const struct zr_png_head windows[4] = {
        {PNG_WIDTH + 1, PNG_HEIGHT, 8}, {PNG_WIDTH, PNG_HEIGHT - 1, 8}, {PNG_HEIGHT, PNG_WIDTH, 8}, {8192, 8192, 8}};
    const struct zr_parsed_bytes bytes = {file.bytes, file.size};
    for (int i = 0; i < 4; i++) {
        assert_int_equal(zr_png_read(&arena, &bytes, &windows[i], &rgba, &reason), ZR_BAD_SCENE);
        assert_non_null(strstr(reason.text, "13 x 9 pixels, not the window's"));
        assert_int_equal(arena.used, 0);
    }
}

TEST(what_is_no_png_is_refused)
{
    struct zr_reason reason = {""};
    uint8_t *rgba;
    assert_int_equal(read_file("", 0, &rgba, &reason), ZR_BAD_SCENE);
    static const char jpeg[64] = "\xff\xd8\xff\xe0\0\x10JFIF";
    assert_int_equal(read_file(jpeg, sizeof jpeg, &rgba, &reason), ZR_BAD_SCENE);
    assert_string_equal(reason.text, "not a PNG");
}

/* 10 MB of zeros in 10 kB, in chunks that libpng would unpack or keep. */
TEST(packed_text_and_profiles_are_passed_over)
{
    static unsigned char samples[PNG_PIXELS * 4], zeros[10 << 20], packed[16 << 10];
    static struct png_file file;
    struct zr_reason reason = {""};
    uint8_t *rgba;
    uLongf size = sizeof packed - 8;
    memcpy(packed, "text\0\0", 6);
    assert_int_equal(compress(packed + 6, &size, zeros, sizeof zeros), Z_OK);
    png_file_make(&file, KINDS[1], samples, PNG_WIDTH * 4);
    assert_int_equal(read_file(file.bytes, file.size, &rgba, &reason), ZR_OK);
    size_t plain = arena.used;
    for (int i = 0; i < 2; i++) {
        png_insert_chunk(&file, "zTXt", packed, (uint32_t)size + 6);
        png_insert_chunk(&file, "iCCP", packed, (uint32_t)size + 6);
    }
    png_insert_chunk(&file, "prIv", packed, (uint32_t)size + 6);
    assert_int_equal(read_file(file.bytes, file.size, &rgba, &reason), ZR_OK);
    assert_true(arena.used <= plain + 4096);
}

/* Megabytes of zeros in kilobytes, and then what is no stream at all: none of it is looked at. */
TEST(data_behind_the_last_row_are_not_read)
{
    enum { SIZE = 16 << 10 };
    static unsigned char samples[PNG_PIXELS * 4], behind[SIZE];
    static struct png_file file, longer;
    struct zr_reason reason = {""};
    uint8_t *rgba, first[PNG_PIXELS * 4];
    png_file_make(&file, KINDS[1], samples, PNG_WIDTH * 4);
    assert_int_equal(read_file(file.bytes, file.size, &rgba, &reason), ZR_OK);
    memcpy(first, rgba, sizeof first);
    memset(behind, 0xff, sizeof behind);
    const unsigned char *data = memmem(file.bytes, file.size, "IDAT", 4);
    assert_non_null(data);
    size_t rows = (size_t)data[-4] << 24 | (size_t)data[-3] << 16 | (size_t)data[-2] << 8 | data[-1];
    longer = (struct png_file){.size = 33};
    memcpy(longer.bytes, file.bytes, 33);
    png_insert_chunk(&longer, "IDAT", behind, sizeof behind);
    png_insert_chunk(&longer, "IDAT", data + 4, (uint32_t)rows);
    assert_int_equal(read_file(longer.bytes, longer.size, &rgba, &reason), ZR_OK);
    assert_memory_equal(rgba, first, sizeof first);
}

TEST(every_ceiling_is_enough_or_fails_cleanly)
{
    static unsigned char samples[PNG_PIXELS * 4];
    static struct png_file file;
    struct zr_reason reason = {""};
    uint8_t *rgba;
    int failed = 0;
    png_file_make(&file, KINDS[6], samples, PNG_WIDTH * 4);
    for (size_t ceiling = 0; ceiling < 1 << 18; ceiling += 512) {
        struct zr_arena small;
        zr_arena_init(&small, ceiling);
        enum zr_status status =
            zr_png_read(&small, &(struct zr_parsed_bytes){file.bytes, file.size}, &window, &rgba, &reason);
        zr_arena_free(&small);
        if (status == ZR_OK) break;
        assert_int_equal(status, ZR_NO_MEMORY);
        failed++;
    }
    assert_in_range(failed, 10, 511);
}

TEST(files_cut_anywhere_are_refused)
{
    struct random random = random_seeded(19);
    static struct png_file file;
    unsigned char samples[PNG_PIXELS * 4];
    struct zr_reason reason = {""};
    uint8_t *rgba;
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; k += 6) {
        uint8_t whole[PNG_PIXELS * 4];
        size_t shortest = 0;
        png_file_make(&file, KINDS[k], samples, png_make_samples(&random, KINDS[k], samples));
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

/* What lay in the arena before, as another request's pictures might. */
static void fill_arena(int byte)
{
    enum { ROOM = 1 << 17 };
    zr_arena_reset(&arena, 1 << 24);
    memset(zr_arena_alloc(&arena, ROOM, 1), byte, ROOM);
}

TEST(files_with_any_bytes_changed_never_read_too_far_or_show_old_memory)
{
    struct random random = random_seeded(21);
    static struct png_file file, mutated;
    unsigned char samples[PNG_PIXELS * 4], first[PNG_PIXELS * 4];
    int read = 0, refused = 0;
    for (int round = 0; round < 6000; round++) {
        struct png_kind kind = KINDS[(size_t)round % (sizeof KINDS / sizeof *KINDS)];
        png_file_make(&file, kind, samples, png_make_samples(&random, kind, samples));
        mutated = file;
        for (uint32_t k = 1 + random_below(&random, 4); k > 0; k--)
            mutated.bytes[random_below(&random, (uint32_t)file.size)] = (unsigned char)random_next(&random);
        if (round % 3) png_mend(&mutated);
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

RUN_TESTS(open_arena, close_arena)
