/* Arrays in place of lists: their floats are those of the same numbers in JSON, at any alignment, within limits of
 * memory and time. tests/refusals/json-arrays.txt has the refusals. */
#include "support/input/npy.h"
#include "support/tests.h"
#include "unit/common/input_check.h"

#define SCENE(positions) "{\"meshes\":[{\"positions\":" positions ",\"points\":[0,1]}]}"
#define ASSET            SCENE("{\"asset\":\"a\"}")

static struct reading *read_asset(const struct zr_asset *asset, size_t ceiling, struct zr_quick *quick)
{
    const struct zr_request request = {.format = ZR_FORMAT_JSON, .assets = asset, .asset_count = 1, .quick = quick};
    return read_request(request, ASSET, sizeof ASSET - 1, zr_limits_default(), ceiling);
}

TEST(numbers_are_those_of_JSON)
{
    static const double f8[6] = {0.1, -0.0, 1e-46, 999999.96875, -1e6, 1.0 / 3};
    static const float f4[6] = {0.1f, -0.0f, 1e-45f, 999999.9375f, -1e6f, 1.0f / 3};
    static const long long i8[6] = {838860, -1000000, 0, 1, 999999, -3};
    static const unsigned long long u8[6] = {1000000, 0, 7, 65537, 999999, 3};
    static const int i4[6] = {-1000000, 1000000, 0, 1, 2, -3};
    static const unsigned u4[6] = {1000000, 999999, 0, 1, 2, 3};
    static const unsigned char u1[6] = {255, 254, 0, 1, 2, 128};
    static const struct {
        const char *descr, *text;
        const void *numbers;
        size_t bytes;
    } cases[] = {
        {"<f8", SCENE("[[0.1,-0.0,1e-46],[999999.96875,-1e6,0.3333333333333333]]"), f8, sizeof f8},
        {"<f4", SCENE("[[0.1,-0.0,1e-45],[999999.9375,-1e6,0.3333333432674408]]"), f4, sizeof f4},
        {"<i8", SCENE("[[838860,-1000000,0],[1,999999,-3]]"), i8, sizeof i8},
        {"<u8", SCENE("[[1000000,0,7],[65537,999999,3]]"), u8, sizeof u8},
        {"<i4", SCENE("[[-1000000,1000000,0],[1,2,-3]]"), i4, sizeof i4},
        {"<u4", SCENE("[[1000000,999999,0],[1,2,3]]"), u4, sizeof u4},
        {"|u1", SCENE("[[255,254,0],[1,2,128]]"), u1, sizeof u1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t size;
        char *file = npy_file(cases[i].descr, "False", "(2, 3)", cases[i].numbers, cases[i].bytes, &size);
        struct reading *wanted = read_text(ZR_FORMAT_JSON, cases[i].text);
        assert_non_null(file);
        assert_read(wanted);
        const size_t bytes = wanted->scene->meshes->position_count * sizeof(zr_vec4);
        zr_vec4 positions[2];
        memcpy(positions, wanted->scene->meshes->positions, bytes);
        reading_free(wanted);
        for (size_t shift = 0; shift < 8; shift++) {
            char *shifted = malloc(size + shift);
            assert_non_null(shifted);
            memset(shifted, 0, shift);
            memcpy(shifted + shift, file, size);
            struct guarded guarded = guarded_copy(shifted, size + shift);
            const struct zr_asset asset = {.name = "a", .bytes = guarded.bytes + shift, .size = size};
            struct reading *reading = read_asset(&asset, (size_t)1 << 26, NULL);
            assert_read(reading);
            assert_int_equal(reading->scene->meshes->position_count * sizeof(zr_vec4), bytes);
            assert_memory_equal(reading->scene->meshes->positions, positions, bytes);
            reading_free(reading);
            guarded_free(&guarded);
            free(shifted);
        }
        free(file);
    }
}

/* Bytes that become 16 times as many floats. */
TEST(memory_is_known_before_it_is_used)
{
    enum { ROWS = 200000 };
    static const unsigned char zeros[3 * ROWS];
    const struct zr_asset asset = {.name = "a", .array = {zeros, ZR_U1, 2, {ROWS, 3}}};
    struct reading *reading = read_asset(&asset, (size_t)3 << 20, NULL);
    assert_int_equal(reading->status, ZR_NO_MEMORY);
    assert_true(reading->arena.peak < 1 << 20);
    reading_free(reading);
    reading = read_asset(&asset, (size_t)64 << 20, NULL);
    assert_read(reading);
    reading_free(reading);
}

TEST(quick_reading_ends_beyond_its_bytes_of_arrays)
{
    static const float zeros[3 * 100];
    const struct zr_asset asset = {.name = "a", .array = {zeros, ZR_F4, 2, {100, 3}}};
    struct zr_quick quick = {UINT64_MAX, UINT64_MAX, sizeof zeros, false};
    struct reading *reading = read_asset(&asset, (size_t)1 << 26, &quick);
    assert_read(reading);
    reading_free(reading);
    quick.array_bytes_max = sizeof zeros - 1;
    reading = read_asset(&asset, (size_t)1 << 26, &quick);
    assert_int_equal(reading->status, ZR_CANCELLED);
    assert_true(quick.is_exceeded);
    reading_free(reading);
}

RUN_TESTS(NULL, NULL)
