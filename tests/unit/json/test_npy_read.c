/* Arrays as numpy.save writes them, and everything that is not quite one. */
#include <string.h>

#include "input/json/npy_read.h"
#include "output/npy.h"
#include "support/random.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "unit/common/guarded.h"

enum { FILE_MAX = 4096 };

TEST_ARENA(1 << 20)

/* Of 3 x 2 numbers. */
static enum zr_status read_file(const void *bytes, size_t size, bool is_float, uint32_t *out, struct zr_reason *reason)
{
    struct guarded guarded = guarded_copy(bytes, size);
    void *values = NULL;
    zr_arena_reset(&arena, 1 << 20);
    enum zr_status status = zr_npy_read(&arena, &(struct zr_parsed_bytes){guarded.bytes, size},
                                        &(struct zr_npy_wanted){is_float, 3, 2}, &values, reason);
    guarded_free(&guarded);
    if (status == ZR_OK) memcpy(out, values, 24);
    return status;
}

/* A file with any version, dictionary and bytes of numbers; returns its size. */
static size_t make_file(char *out, int major, const char *dictionary, const void *numbers, size_t bytes)
{
    size_t length = strlen(dictionary), prefix = major == 1 ? 10 : 12;
    memset(out, 0, prefix);
    memcpy(out, "\x93NUMPY", 6);
    out[6] = (char)major;
    out[8] = (char)(length & 255);
    out[9] = (char)(length >> 8);
    memcpy(out + prefix, dictionary, length);
    memcpy(out + prefix + length, numbers, bytes);
    return prefix + length + bytes;
}

TEST(what_we_write_is_read)
{
    const float values[6] = {0, 1, -2.5f, 1e30f, 4, 5};
    uint32_t out[6];
    struct zr_reason reason;
    struct zr_buffer file = {.arena = &arena};
    assert_int_equal(zr_npy_write(ZR_NPY_FLOAT32, 3, 2, 1, values, &file), ZR_OK);
    char copy[FILE_MAX];
    memcpy(copy, file.bytes, file.size);
    assert_int_equal(read_file(copy, file.size, true, out, &reason), ZR_OK);
    assert_memory_equal(out, values, sizeof values);
}

TEST(every_way_that_numpy_writes_it_is_read)
{
    static const char *const dictionaries[] = {
        "{'descr': '<u4', 'fortran_order': False, 'shape': (2, 3), }          \n",
        "{'descr': '<u4', 'fortran_order': False, 'shape': (2, 3)}\n",
        "{'shape': (2, 3,), 'fortran_order': False, 'descr': '<u4'}",
        "{\"descr\":\"<u4\",\"fortran_order\":False,\"shape\":(2,3)}",
        "{'descr': '<u4', 'fortran_order': False, 'shape': (2L, 3L), }\n",
    };
    const unsigned char numbers[24] = {1, 2, 3, 4, 5, 0, 0, 0, 6,    0,    0,    0,
                                       7, 0, 0, 0, 8, 0, 0, 0, 0xff, 0xff, 0xff, 0xff};
    for (int major = 1; major <= 3; major++)
        for (size_t i = 0; i < sizeof dictionaries / sizeof *dictionaries; i++) {
            char file[FILE_MAX];
            uint32_t out[6] = {0};
            struct zr_reason reason = {""};
            size_t size = make_file(file, major, dictionaries[i], numbers, sizeof numbers);
            if (read_file(file, size, false, out, &reason) != ZR_OK) fail_msg("%s: %s", dictionaries[i], reason.text);
            assert_int_equal(out[0], 0x04030201);
            assert_int_equal(out[5], 0xffffffff);
        }
}

TEST(big_endian_numbers_are_turned)
{
    const unsigned char numbers[24] = {0x3f, 0x80, 0, 0, 0xc0, 0x20, 0, 0};
    char file[FILE_MAX];
    float out[6];
    uint32_t bits[6];
    struct zr_reason reason;
    size_t size = make_file(file, 1, "{'descr': '>f4', 'fortran_order': False, 'shape': (2, 3), }", numbers, 24);
    assert_int_equal(read_file(file, size, true, bits, &reason), ZR_OK);
    memcpy(out, bits, sizeof out);
    assert_true(out[0] == 1.0f && out[1] == -2.5f && out[2] == 0.0f);
}

TEST(what_is_not_the_wanted_array_is_refused_with_a_reason)
{
    static const struct {
        const char *dictionary, *reason;
        size_t bytes;
    } cases[] = {
        {"{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }", "type is '<f8'; float32 is needed", 48},
        {"{'descr': '<u4', 'fortran_order': False, 'shape': (2, 3), }", "type is '<u4'", 24},
        {"{'descr': '|f4', 'fortran_order': False, 'shape': (2, 3), }", "type is '|f4'", 24},
        {"{'descr': '=f4', 'fortran_order': False, 'shape': (2, 3), }", "type is '=f4'", 24},
        {"{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3), }", "type is '|u1'", 6},
        {"{'descr': '', 'fortran_order': False, 'shape': (2, 3), }", "type is ''", 24},
        {"{'descr': '<f4', 'fortran_order': True, 'shape': (2, 3), }", "Fortran order", 24},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (3, 2), }", "(3, 2), not the window's (2, 3)", 24},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3, 1), }", "3 dimensions", 24},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (6,), }", "1 dimensions", 24},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (), }", "0 dimensions", 4},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 18446744073709551616), }", "not an NPY file", 24},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 4294967299), }", "4294967299", 24},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, -3), }", "not an NPY file", 24},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", "20 bytes of numbers; 24", 20},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", "28 bytes of numbers; 24", 28},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", "25 bytes of numbers; 24", 25},
        {"{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (2, 3), }", "not an NPY file", 24},
        {"{'descr': '<f4', 'fortran_order': 0, 'shape': (2, 3), }", "not an NPY file", 24},
        {"{'descr': '<f4', 'shape': (2, 3), }", "not an NPY file", 24},
        {"{'descr': '<f4', 'fortran_order': False, }", "not an NPY file", 24},
        {"{'fortran_order': False, 'shape': (2, 3), }", "not an NPY file", 24},
        {"{'descr': '<f4', 'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", "not an NPY file", 24},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), 'shape': (2, 3), }", "not an NPY file", 24},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), 'more': 1, }", "not an NPY file", 24},
        {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), } + {}", "not an NPY file", 24},
        {"{'descr': '<f4' 'fortran_order': False 'shape': (2, 3) }", "not an NPY file", 24},
        {"{,}", "not an NPY file", 24},
        {"", "not an NPY file", 24},
    };
    const float numbers[12] = {0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char file[FILE_MAX];
        uint32_t out[6];
        struct zr_reason reason = {""};
        size_t size = make_file(file, 1, cases[i].dictionary, numbers, cases[i].bytes);
        assert_int_equal(read_file(file, size, true, out, &reason), ZR_BAD_SCENE);
        if (!strstr(reason.text, cases[i].reason)) fail_msg("%s: %s", cases[i].dictionary, reason.text);
        assert_int_equal(arena.used, 0); /* it cost nothing */
    }
}

TEST(unknown_versions_and_lengths_are_refused)
{
    static const char good[] = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }";
    const float numbers[6] = {0};
    char file[FILE_MAX];
    uint32_t out[6];
    struct zr_reason reason;
    for (int major = 0; major < 256; major++)
        for (int minor = 0; minor < 2; minor++) {
            size_t size = make_file(file, major, good, numbers, 24);
            file[7] = (char)minor;
            bool want = major >= 1 && major <= 3 && minor == 0;
            assert_int_equal(read_file(file, size, true, out, &reason), want ? ZR_OK : ZR_BAD_SCENE);
        }
    size_t size = make_file(file, 2, good, numbers, 24);
    memset(file + 8, 0xff, 4);
    assert_int_equal(read_file(file, size, true, out, &reason), ZR_BAD_SCENE);
}

TEST(files_cut_anywhere_or_with_any_byte_changed_never_read_too_far)
{
    struct random random = random_seeded(9);
    const float numbers[6] = {0};
    char file[FILE_MAX], mutated[FILE_MAX];
    uint32_t out[6];
    struct zr_reason reason;
    size_t size = make_file(file, 1, "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }", numbers, 24);
    for (size_t cut = 0; cut < size; cut++)
        assert_int_equal(read_file(file, cut, true, out, &reason), ZR_BAD_SCENE);
    int read = 0;
    for (int round = 0; round < 20000; round++) {
        memcpy(mutated, file, size);
        size_t kept = round % 2 ? size : random_below(&random, (uint32_t)size + 1);
        for (uint32_t k = random_below(&random, 3) + 1; k > 0; k--)
            mutated[random_below(&random, (uint32_t)size)] = (char)random_next(&random);
        read += read_file(mutated, kept, true, out, &reason) == ZR_OK;
    }
    assert_in_range(read, 100, 19000); /* changed numbers are numbers */
}

RUN_TESTS(open_arena, close_arena)
