/* Tests the decoder of Draco meshes: every kind of connectivity and prediction, refusals, and broken bytes. */
#include <math.h>

#include "support/input/draco_check.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "unit/common/guarded.h"

TEST_ARENA((size_t)1 << 26)

/* Decodes bytes that end at a page that nobody may read. */
static bool decode(const unsigned char *bytes, size_t size, struct zr_draco_mesh *out, struct zr_reason *reason)
{
    static struct guarded room;
    if (!room.map) room = guarded_copy((char[DRACO_BYTES_MOST]){0}, DRACO_BYTES_MOST);
    char *copy = (char *)room.map + (room.bytes - (const char *)room.map) + DRACO_BYTES_MOST - size;
    memcpy(copy, bytes, size);
    zr_arena_reset(&arena, SIZE_MAX);
    return zr_draco_decode(&arena, NULL, copy, size, out, reason);
}

static void assert_corners(const struct zr_draco_mesh *mesh)
{
    for (size_t i = 0; i < 3 * (size_t)mesh->face_count; i++)
        assert_true(mesh->corners[i] < mesh->point_count);
}

TEST(streams_have_the_numbers_of_the_reference_decoder)
{
    unsigned char bytes[DRACO_BYTES_MOST];
    for (size_t i = 0; i < DRACO_STREAMS; i++) {
        struct zr_draco_mesh mesh;
        struct zr_reason reason;
        if (!decode(bytes, draco_stream_bytes(i, bytes), &mesh, &reason))
            fail_msg("%s: %s", draco_streams[i].name, reason.text);
        assert_int_equal(mesh.point_count, draco_streams[i].points);
        assert_int_equal(mesh.face_count, draco_streams[i].faces);
        assert_corners(&mesh);
        if (draco_digest(&mesh) != draco_streams[i].digest) fail_msg("%s has other numbers", draco_streams[i].name);
    }
}

/* Two triangles of a square: tagged differences of corners, all of 4 bits, and positions that are not coded. */
static const unsigned char square[] = {
    'D',  'R',  'A',  'C',  'O',  2, 2,    1,    0, 0, 0, 2, 4, 0, /* two faces, four points */
    0,    5,    0x0F, 0x01, 0x40, 1, 0,                            /* one tag: 4 bits, certainly */
    0x20, 0x52, 0x24, 1,    1,    0, 9,    3,    0, 7, 0,          /* one attribute of three floats, number 7 */
    0,    0,    0,    0,    0,    0, 0,    0,    0, 0, 0, 0,       /* */
    0,    0,    0x80, 0x3F, 0,    0, 0,    0,    0, 0, 0, 0,       /* */
    0,    0,    0x80, 0x3F, 0,    0, 0x80, 0x3F, 0, 0, 0, 0,       /* */
    0,    0,    0,    0,    0,    0, 0x80, 0x3F, 0, 0, 0, 0};

TEST(differences_of_corners_are_added)
{
    static const uint32_t wanted[] = {0, 1, 2, 0, 2, 3};
    struct zr_draco_mesh mesh;
    struct zr_reason reason;
    if (!decode(square, sizeof square, &mesh, &reason)) fail_msg("%s", reason.text);
    assert_int_equal(mesh.attribute_count, 1);
    assert_int_equal(mesh.attributes[0].id, 7);
    assert_memory_equal(mesh.corners, wanted, sizeof wanted);
    assert_memory_equal(mesh.attributes[0].values, square + 32, 48);
}

TEST(normals_of_the_older_transform_are_read)
{
    static const float wanted[3][3] = {{1, 0, 0}, {0.894427f, 0.447214f, 0}, {0, -0.5547f, 0.83205f}};
    static const unsigned char bytes[] = {
        'D', 'R', 'A', 'C', 'O', 2,  2, 1, 0,  0, 0, 1, 3, 1, 0, 1, 2, /* plain corners */
        1,   1,   1,   9,   3,   0,  0, 3,                             /* a normal */
        0,   2,   0,   1,   15,  15, 5, 0, 20, 9,                      /* differences by transform 2, of one byte */
        31,  0,   0,   0,   5};
    struct zr_draco_mesh mesh;
    struct zr_reason reason;
    float normals[3][3];
    if (!decode(bytes, sizeof bytes, &mesh, &reason)) fail_msg("%s", reason.text);
    memcpy(normals, mesh.attributes[0].values, sizeof normals);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            if (!(fabsf(normals[i][k] - wanted[i][k]) < 1e-5f)) fail_msg("normal %d: %g", i, (double)normals[i][k]);
}

TEST(other_contents_are_refused_by_name)
{
    static const struct {
        size_t at; /* byte of the square */
        unsigned char value;
        const char *reason;
    } cases[] = {{0, 'X', "the compressed data are not of Draco"},
                 {5, 1, "Draco's bitstream 1.2; version 2.2 is read"},
                 {6, 1, "Draco's bitstream 2.1; version 2.2 is read"},
                 {7, 0, "a point cloud of Draco"},
                 {7, 9, "contents of Draco of the unknown kind 9; meshes are read"},
                 {8, 2, "a mesh of the unknown method 2"},
                 {27, 10, "attribute 7 has numbers of the type 10, which is not read"},
                 {28, 17, "attribute 7 has 17 numbers per point; 1 to 16 are read"},
                 {28, 0, "attribute 7 has 0 numbers per point; 1 to 16 are read"},
                 {31, 4, "attribute 7 has the unknown coder 4"},
                 {24, 33, "33 groups of attributes; 32 are read"},
                 {25, 33, "33 attributes; 32 are read"},
                 {12, 3, "the compressed data are broken, at about byte 24 of 80"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        unsigned char bytes[sizeof square];
        struct zr_draco_mesh mesh;
        struct zr_reason reason;
        memcpy(bytes, square, sizeof square);
        bytes[cases[i].at] = cases[i].value;
        assert_false(decode(bytes, sizeof bytes, &mesh, &reason));
        if (!strstr(reason.text, cases[i].reason)) fail_msg("case %zu: %s", i, reason.text);
    }
}

TEST(counts_are_limited_by_the_bytes)
{
    static const unsigned char many[] = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, 1, 0, 0, 0, 3, 0xFF, 0xFF, 0x7F, 0, 9, 0};
    struct zr_draco_mesh mesh;
    struct zr_reason reason;
    assert_false(decode(many, sizeof many, &mesh, &reason));
    assert_string_equal(reason.text, "2097151 faces are too many for 19 bytes");
}

TEST(predictive_connectivity_is_refused_by_name)
{
    static const unsigned char bytes[] = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, 1, 0, 0, 1};
    struct zr_draco_mesh mesh;
    struct zr_reason reason;
    assert_false(decode(bytes, sizeof bytes, &mesh, &reason));
    assert_string_equal(reason.text, "predictive edgebreaker connectivity is not read");
}

TEST(metadata_are_skipped)
{
    /* One attribute's object without contents; then an object with one entry and one object, which is named "b". */
    static const unsigned char metadata[] = {1, 7, 0, 0, 1, 1, 'a', 2, 8, 9, 1, 1, 'b', 0, 0};
    unsigned char bytes[sizeof square + sizeof metadata];
    struct zr_draco_mesh mesh;
    struct zr_reason reason;
    memcpy(bytes, square, 11);
    memcpy(bytes + 11, metadata, sizeof metadata);
    memcpy(bytes + 11 + sizeof metadata, square + 11, sizeof square - 11);
    bytes[10] = 0x80;
    if (!decode(bytes, sizeof bytes, &mesh, &reason)) fail_msg("%s", reason.text);
    assert_int_equal(mesh.face_count, 2);
}

TEST(streams_that_end_early_are_refused)
{
    unsigned char bytes[DRACO_BYTES_MOST];
    for (size_t i = 0; i < DRACO_STREAMS; i++) {
        const size_t size = draco_stream_bytes(i, bytes);
        for (size_t cut = i % 3; cut < size; cut += 3) {
            struct zr_draco_mesh mesh;
            struct zr_reason reason;
            if (decode(bytes, cut, &mesh, &reason) || !reason.text[0])
                fail_msg("%s: %zu of %zu bytes are read", draco_streams[i].name, cut, size);
        }
    }
}

TEST(broken_bytes_give_a_mesh_or_a_reason)
{
    unsigned char bytes[DRACO_BYTES_MOST];
    for (size_t i = 0; i < DRACO_STREAMS; i++) {
        const size_t size = draco_stream_bytes(i, bytes);
        for (size_t at = 9 + i % 3; at < size; at += 3) {
            struct zr_draco_mesh mesh;
            struct zr_reason reason;
            bytes[at] ^= (unsigned char)(1u << (at + i) % 8);
            if (decode(bytes, size, &mesh, &reason))
                assert_corners(&mesh);
            else
                assert_true(reason.text[0] || !zr_arena_ok(&arena));
            bytes[at] ^= (unsigned char)(1u << (at + i) % 8);
        }
    }
}

TEST(a_cancelled_decoder_ends)
{
    unsigned char bytes[DRACO_BYTES_MOST];
    struct zr_cancel cancel = {.raised = true};
    struct zr_draco_mesh mesh;
    struct zr_reason reason;
    const size_t size = draco_stream_bytes(DRACO_STREAMS - 1, bytes);
    zr_arena_reset(&arena, SIZE_MAX);
    assert_false(zr_draco_decode(&arena, &cancel, bytes, size, &mesh, &reason));
    assert_string_equal(reason.text, "");
}

TEST(memory_is_limited_by_the_arena)
{
    unsigned char bytes[DRACO_BYTES_MOST];
    struct zr_arena small;
    struct zr_draco_mesh mesh;
    struct zr_reason reason;
    const size_t size = draco_stream_bytes(DRACO_STREAMS - 1, bytes);
    zr_arena_init(&small, 20000);
    assert_false(zr_draco_decode(&small, NULL, bytes, size, &mesh, &reason));
    assert_string_equal(reason.text, "");
    assert_false(zr_arena_ok(&small));
    zr_arena_free(&small);
}

RUN_TESTS(open_arena, close_arena)
