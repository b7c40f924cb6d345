/* Tests the decoder of EXT_ and KHR_meshopt_compression: its three modes, both versions of attributes, its filters, and broken bytes. */
#include <math.h>
#include <string.h>

#include "input/codecs/meshopt.h"
#include "support/tests.h"

#define BYTES(...) (const unsigned char[]){__VA_ARGS__}, sizeof((const unsigned char[]){__VA_ARGS__})
#define ZEROS_16   0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0

static bool decode(const struct zr_meshopt *of, const unsigned char *bytes, size_t size, void *out,
                   struct zr_reason *reason)
{
    *reason = (struct zr_reason){""};
    return zr_meshopt_check(of, bytes, size, reason) && zr_meshopt_decode(of, bytes, size, out, NULL, reason);
}

/* 16 elements of 4 bytes: the group of deltas of the specification's example in the first byte, two-bit deltas in the
 * second, bytes in the third, and none in the last. */
static const unsigned char attributes[] = {
    0xA0,     2, 0x17, 0x5F, 0xF0, 0xBC, 0x77, 0xA9, 0x21, 0x00, 0x34, 0xB5, 1, 0x80, 0,  0,  0xC0, 9,
    3,        2, 0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0, 0,    0,  0,  1,    0,
    ZEROS_16, 0, 0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0, 10,   20, 30, 40};

TEST(attributes_are_deltas_of_bytes)
{
    static const int deltas[16] = {-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0};
    const struct zr_meshopt of = {ZR_MESHOPT_ATTRIBUTES, ZR_MESHOPT_NONE, 16, 4};
    unsigned char out[64];
    struct zr_reason reason;
    if (!decode(&of, attributes, sizeof attributes, out, &reason)) fail_msg("%s", reason.text);
    unsigned char wanted = 10;
    for (int i = 0; i < 16; i++) {
        wanted = (unsigned char)(wanted + deltas[i]);
        assert_int_equal(out[4 * i], wanted);
        assert_int_equal(out[4 * i + 1], i < 12 ? 21 : 16); /* 20 + 1, later - 5 */
        assert_int_equal(out[4 * i + 2], i < 15 ? 31 : 30);
        assert_int_equal(out[4 * i + 3], 40);
    }
}

/* Version 1: 3 elements of 8 bytes. The first channel has numbers of 2 bytes: single bits, zeros, bytes, zeros. The
 * second has a number of 4 bytes, turned by 28 bits and added by xor. */
TEST(version_1_has_channels)
{
    static const uint32_t wanted[] = {0x00060003, 0x13345678, 0x00050003, 0x13345678, 0x00050001, 0x13245678};
    const struct zr_meshopt of = {ZR_MESHOPT_ATTRIBUTES, ZR_MESHOPT_NONE, 3, 8};
    unsigned char out[24];
    struct zr_reason reason;
    const bool good = decode(&of,
                             BYTES(0xA1, 0xB8, 0xEA, 1, 5, 0, 4, 3, 2, 1, 0, 0x10, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
                                   0, 0, 0, 0, 1, 0, 5, 0, 0x78, 0x56, 0x34, 0x12, 1, 0x42),
                             out, &reason);
    if (!good) fail_msg("%s", reason.text);
    for (int i = 0; i < 6; i++) {
        const unsigned char *at = out + 4 * i;
        const uint32_t found = at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
        if (found != wanted[i]) fail_msg("number %d is %08x", i, found);
    }
    assert_false(decode(&of, BYTES(0xA1, 0xAA, 0xAA, ZEROS_16, 0, 0, 0, 0, 0, 0, 3, 0), out, &reason));
}

TEST(the_filter_color_restores_red_green_and_blue)
{
    uint8_t bytes[] = {100, 20, 246, 255, 7, 0, 0, 8, 1, 2, 3, 0};
    static const uint8_t wanted[] = {130, 90, 90, 255, 119, 119, 119, 0, 0, 0, 0, 0};
    uint16_t wide[] = {1000, 0xFFFE, 3, 0x8001};
    const struct zr_meshopt of = {ZR_MESHOPT_ATTRIBUTES, ZR_MESHOPT_COLOR, 3, 4}, of_wide = {0, ZR_MESHOPT_COLOR, 1, 8};
    zr_meshopt_filter(&of, bytes, 3);
    assert_memory_equal(bytes, wanted, sizeof wanted);
    zr_meshopt_filter(&of_wide, (unsigned char *)wide, 1);
    assert_true(wide[0] == 995 && wide[1] == 1003 && wide[2] == 999 && wide[3] == 3);
}

TEST(elements_of_a_short_group_are_ignored)
{
    const struct zr_meshopt of = {ZR_MESHOPT_ATTRIBUTES, ZR_MESHOPT_NONE, 3, 4};
    unsigned char out[16] = {0};
    struct zr_reason reason;
    assert_true(decode(&of, attributes, sizeof attributes, out, &reason));
    assert_int_equal(out[8], 2);
    assert_int_equal(out[12], 0);
}

TEST(triangles_share_edges_and_vertices)
{
    /* 0 1 2 from the table; the edge of 2 and 0 with the next vertex; an edge with the second last vertex; an edge with
     * a number: last + 5; all three explicit. */
    static const uint32_t wanted[] = {0, 1, 2, 0, 2, 3, 0, 3, 2, 0, 2, 5, 7, 4, 6};
    const struct zr_meshopt of = {ZR_MESHOPT_TRIANGLES, ZR_MESHOPT_NONE, 15, 4};
    uint32_t out[15];
    struct zr_reason reason;
    const bool good = decode(&of, BYTES(0xE1, 0xF0, 0x00, 0x01, 0x0F, 0xFF, 10, 0x0F, 4, 1, ZEROS_16), out, &reason);
    if (!good) fail_msg("%s", reason.text);
    for (int i = 0; i < 15; i++)
        if (out[i] != wanted[i]) fail_msg("index %d is %u", i, out[i]);
}

TEST(indices_have_two_bases)
{
    static const uint16_t wanted[] = {1, 2, 200, 3, 199};
    const struct zr_meshopt of = {ZR_MESHOPT_INDICES, ZR_MESHOPT_NONE, 5, 2};
    uint16_t out[5];
    struct zr_reason reason;
    assert_true(decode(&of, BYTES(0xD1, 4, 4, 0xA1, 0x06, 4, 3, 0, 0, 0, 0), out, &reason));
    assert_memory_equal(out, wanted, sizeof wanted);
}

TEST(filters_restore_vectors_quaternions_and_floats)
{
    int8_t normal[8] = {127, 0, 127, 5, 31, 31, 63, 0};
    int16_t wide[4] = {0, 0, 32767, 9}, turn[4] = {0, 0, 0, 32767};
    int32_t exponential[2] = {(int32_t)0xFF000003, 0x02FFFFFE};
    float values[2];
    zr_meshopt_filter(&(struct zr_meshopt){ZR_MESHOPT_ATTRIBUTES, ZR_MESHOPT_OCTAHEDRAL, 2, 4}, (unsigned char *)normal,
                      2);
    assert_true(normal[0] == 127 && normal[1] == 0 && normal[2] == 0 && normal[3] == 5);
    assert_true(normal[4] == 90 && normal[5] == 90 && normal[6] == 3);
    zr_meshopt_filter(&(struct zr_meshopt){ZR_MESHOPT_ATTRIBUTES, ZR_MESHOPT_OCTAHEDRAL, 1, 8}, (unsigned char *)wide,
                      1);
    assert_true(wide[0] == 0 && wide[1] == 0 && wide[2] == 32767 && wide[3] == 9);
    zr_meshopt_filter(&(struct zr_meshopt){ZR_MESHOPT_ATTRIBUTES, ZR_MESHOPT_QUATERNION, 1, 8}, (unsigned char *)turn,
                      1);
    assert_true(turn[0] == 0 && turn[1] == 0 && turn[2] == 0 && turn[3] == 32767);
    zr_meshopt_filter(&(struct zr_meshopt){ZR_MESHOPT_ATTRIBUTES, ZR_MESHOPT_EXPONENTIAL, 2, 4},
                      (unsigned char *)exponential, 2);
    memcpy(values, exponential, sizeof values);
    assert_true(values[0] == 1.5f && values[1] == -8.0f);
}

TEST(broken_bytes_are_refused)
{
    static const struct {
        struct zr_meshopt of;
        size_t cut; /* bytes left out at the end of the attributes */
        const char *reason;
    } cases[] = {{{0, 0, 16, 6}, 0, "a byteStride of 6 does not fit the mode"},
                 {{1, 0, 3, 8}, 0, "a byteStride of 8 does not fit the mode"},
                 {{0, 2, 8, 4}, 0, "the filter does not fit the mode and a byteStride of 4"},
                 {{1, 0, 4, 4}, 0, "4 indices, no multiple of 3"},
                 {{0, 0, 4000, 4}, 0, "4000 elements cannot come from 68 bytes"},
                 {{2, 0, 3, 4}, 0, "the compressed data begin with a0, not d1"},
                 {{0, 0, 16, 4}, 3, "the compressed data are broken, at byte"},
                 {{0, 0, 16, 4}, 60, "the compressed data are broken, at byte 1 of"},
                 {{0, 0, 0, 4}, 0, "the compressed data have 35 bytes too many"}};
    unsigned char out[256];
    struct zr_reason reason;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_false(decode(&cases[i].of, attributes, sizeof attributes - cases[i].cut, out, &reason));
        if (!strstr(reason.text, cases[i].reason)) fail_msg("case %zu: %s", i, reason.text);
    }
}

RUN_TESTS(NULL, NULL)
