#include "support/tests.h"
#include "unit/common/input_check.h"

#include <math.h>

enum { MAX_TRIANGLES = 4, BYTES_MAX = 84 + 50 * MAX_TRIANGLES };

#define FACET "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1.5 0\n endloop\nendfacet\n"

/* As few bytes as a facet can have. */
#define SHORTEST "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 2 0 endloop endfacet "

static void put_u32(unsigned char *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (unsigned char)(value >> (8 * i));
}

static void put_f32(unsigned char *at, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_u32(at, bits);
}

/* Triangle t has the coordinates 9t, 9t + 1, ... 9t + 8, and NaN for a normal. */
static size_t make_binary(unsigned char *bytes, const char *header, uint32_t triangles)
{
    memset(bytes, 0, BYTES_MAX);
    memcpy(bytes, header, strlen(header));
    put_u32(bytes + 80, triangles);
    for (uint32_t t = 0; t < triangles; t++)
        for (uint32_t i = 0; i < 12; i++)
            put_f32(bytes + 84 + t * 50 + i * 4, i < 3 ? NAN : (float)(9 * t + i - 3));
    return 84 + (size_t)triangles * 50;
}

TEST(binary_gives_three_vertices_a_triangle)
{
    static const char *const headers[] = {"made by hand", "solid that is binary", ""};
    unsigned char bytes[BYTES_MAX];
    for (size_t h = 0; h < 3; h++) {
        const struct zr_request request = {.format = ZR_FORMAT_STL, .look = "textbook"};
        const size_t size = make_binary(bytes, headers[h], 3);
        struct reading *reading = read_request(request, bytes, size, zr_limits_default(), (size_t)1 << 24);
        assert_read(reading);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        assert_int_equal(mesh->face_count, 3);
        assert_int_equal(mesh->position_count, 9);
        assert_int_equal(mesh->normal_count, 0);
        assert_int_equal(mesh->face_offsets[3], 9);
        for (uint32_t i = 0; i < 9; i++) {
            assert_int_equal(mesh->indices[i], i);
            assert_true(mesh->positions[i].x == (float)(3 * i) && mesh->positions[i].z == (float)(3 * i + 2));
            assert_true(mesh->positions[i].w == 1.0f);
        }
        assert_true(reading->scene->materials[0].double_sided);
        assert_int_equal(reading->scene->materials[0].shading, ZR_SHADING_FLAT);
        reading_free(reading);
    }
}

TEST(truncated_binary_is_refused_with_what_it_says_and_holds)
{
    static const char *const headers[] = {"x", "solid x"};
    unsigned char bytes[BYTES_MAX];
    for (size_t h = 0; h < 2; h++)
        for (size_t size = 0; size < 184; size++) {
            if (h == 1 && size < 84) continue; /* a text */
            make_binary(bytes, headers[h], 2);
            struct reading *reading = read_bytes(ZR_FORMAT_STL, bytes, size);
            char got[64];
            snprintf(got, sizeof got, size < 84 ? "got %zu" : "got %zu; they hold %d", size, size >= 134);
            assert_complaint(reading, ZR_BAD_SYNTAX, "", got);
            assert_complaint(reading, ZR_BAD_SYNTAX, "",
                             size < 84 ? "at least 84 bytes expected" : "184 bytes expected for 2 triangles");
            reading_free(reading);
        }
}

TEST(bytes_behind_binary_are_warned_of)
{
    static const char *const headers[] = {"x", "solid x"};
    static const enum zr_format formats[] = {ZR_FORMAT_STL, ZR_FORMAT_UNKNOWN};
    unsigned char bytes[BYTES_MAX];
    for (size_t i = 0; i < 4; i++)
        for (size_t size = 184; size <= 200; size++) {
            make_binary(bytes, headers[i / 2], 2);
            struct reading *reading = read_bytes(formats[i % 2], bytes, size);
            char warning[80];
            snprintf(warning, sizeof warning, "STL: %zu byte%s behind the last of 2 triangles ignored", size - 184,
                     size == 185 ? "" : "s");
            assert_read(reading);
            assert_int_equal(reading->scene->meshes[0].face_count, 2);
            assert_int_equal(reading->scene->warning_count, size > 184);
            if (size > 184) assert_string_equal(reading->scene->warnings[0], warning);
            reading_free(reading);
        }
}

TEST(count_beyond_the_bytes_is_refused_before_allocating)
{
    unsigned char bytes[BYTES_MAX];
    size_t size = make_binary(bytes, "x", 1);
    put_u32(bytes + 80, UINT32_MAX);
    struct reading *reading = read_bytes(ZR_FORMAT_STL, bytes, size);
    assert_complaint(reading, ZR_BAD_SYNTAX, "",
                     "214748364834 bytes expected for 4294967295 triangles, got 134; they hold 1");
    assert_true(reading->arena.used < 8192);
    reading_free(reading);
}

TEST(text_without_solid_is_named_in_the_message)
{
    static const char text[] = "facet normal 0 0 1\r\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                               "endfacet\nendsolid\n";
    struct reading *reading = read_text(ZR_FORMAT_STL, text);
    assert_complaint(reading, ZR_BAD_SYNTAX, "",
                     "neither 'solid' nor a binary header: the text begins with 'facet normal 0 0 1'");
    reading_free(reading);
    char line[84];
    memset(line, 'x', sizeof line);
    reading = read_bytes(ZR_FORMAT_STL, line, sizeof line);
    assert_complaint(reading, ZR_BAD_SYNTAX, "", "the text begins with 'xxx");
    reading_free(reading);
}

TEST(binary_without_triangles_gives_no_geometry)
{
    unsigned char bytes[BYTES_MAX];
    struct reading *reading = read_bytes(ZR_FORMAT_STL, bytes, make_binary(bytes, "x", 0));
    assert_complaint(reading, ZR_BAD_SCENE, "", "no geometry");
    reading_free(reading);
}

TEST(place_out_of_range_gives_bad_scene_with_triangle)
{
    static const float values[] = {1.1e15f, -3e38f};
    unsigned char bytes[BYTES_MAX];
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        size_t size = make_binary(bytes, "x", 2);
        put_f32(bytes + 84 + 50 + 12 + 16, values[i]);
        struct reading *reading = read_bytes(ZR_FORMAT_STL, bytes, size);
        assert_complaint(reading, ZR_BAD_SCENE, "", "triangle 2 of 2, vertex 2: (");
        assert_int_equal(reading->error.count, 1);
        reading_free(reading);
    }
}

TEST(triangles_that_are_not_finite_are_left_out)
{
    static const float values[] = {NAN, INFINITY, -INFINITY};
    unsigned char bytes[BYTES_MAX];
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        const size_t size = make_binary(bytes, "x", 3);
        put_f32(bytes + 84 + 50 + 12 + 16, values[i]);
        struct reading *reading = read_bytes(ZR_FORMAT_STL, bytes, size);
        assert_read(reading);
        assert_int_equal(reading->scene->meshes[0].face_count, 2);
        assert_true(reading->scene->meshes[0].positions[3].x == 18.0f);
        assert_string_equal(reading->scene->warnings[0], "STL: 1 triangle is not finite and is left out");
        reading_free(reading);
    }
}

/* The middle of a far mesh is its origin. */
TEST(far_binary_meshes_are_moved_to_their_middle)
{
    static const zr_vec4 want[] = {{-5, -3, -3, 1}, {5, 0, 0, 1}, {-5, 3, 3, 1}};
    unsigned char bytes[BYTES_MAX];
    const size_t size = make_binary(bytes, "x", 1);
    for (uint32_t corner = 0; corner < 3; corner++)
        put_f32(bytes + 84 + 12 + 12 * corner, corner == 1 ? 4080930.0f : 4080920.0f);
    struct reading *reading = read_bytes(ZR_FORMAT_STL, bytes, size);
    assert_origin(reading, 4080925.0, 4, 5);
    assert_memory_equal(reading->scene->meshes[0].positions, want, sizeof want);
    reading_free(reading);
}

/* A binary file whose header happens to begin like gzip is no gzip. */
TEST(smooth_shading_by_the_textbook_is_warned_of)
{
    static const struct {
        const char *shading, *look;
    } cases[] = {{"gouraud", "textbook"}, {"flat", "textbook"}, {NULL, "textbook"}, {"gouraud", NULL}, {NULL, NULL}};
    unsigned char bytes[BYTES_MAX];
    const size_t size = make_binary(bytes, "\x1F\x8B", 2);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct zr_request request = {.format = ZR_FORMAT_STL, .shading = cases[i].shading, .look = cases[i].look};
        struct reading *reading = read_request(request, bytes, size, zr_limits_default(), (size_t)1 << 24);
        assert_read(reading);
        assert_int_equal(reading->scene->warning_count, i == 0);
        if (i == 0) assert_non_null(strstr(reading->scene->warnings[0], "share no corners"));
        reading_free(reading);
    }
}

TEST(ascii_gives_its_triangles)
{
    static const char *const texts[] = {
        "solid a name of words\n" FACET FACET "endsolid a name of words\n",
        "SOLID\r\nFacet Normal 0 0 1 Outer Loop Vertex 0 0 0 VERTEX 1 0 0 vertex 0 15e-1 0 EndLoop EndFacet\r\n" FACET
        "ENDSOLID",
        "\n  solid first\n" FACET "endsolid first\nsolid second\n" FACET "endsolid\n\n",
        "solid\nfacet normal nan -nan(ind) nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1.5 0\nendloop\n"
        "endfacet\n" FACET "endsolid",
        "solid\n" SHORTEST SHORTEST "endsolid"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct reading *reading = read_text(ZR_FORMAT_STL, texts[i]);
        assert_read(reading);
        const struct zr_mesh *mesh = &reading->scene->meshes[0];
        assert_int_equal(mesh->face_count, 2);
        assert_int_equal(mesh->position_count, 6);
        assert_true(mesh->positions[4].x == 1.0f && mesh->positions[5].y >= 1.5f && mesh->positions[5].w == 1.0f);
        reading_free(reading);
    }
}

/* A normal may be any three words, whose ends are looked for many bytes at once. */
TEST(words_of_every_length_are_passed_over)
{
    static const char spaces[] = " \t\v\f\r\n";
    for (int length = 1; length < 70; length++)
        for (size_t i = 0; spaces[i]; i++) {
            char word[80], text[640];
            memset(word, 'x', sizeof word);
            snprintf(text, sizeof text,
                     "solid\nfacet normal %.*s%c%.*s%c1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1.5%c0 endloop "
                     "endfacet%cendsolid",
                     length, word, spaces[i], 70 - length, word, spaces[i], spaces[i], spaces[i]);
            struct reading *reading = read_text(ZR_FORMAT_STL, text);
            assert_read(reading);
            assert_int_equal(reading->scene->meshes[0].face_count, 1);
            assert_true(reading->scene->meshes[0].positions[2].y == 1.5f);
            reading_free(reading);
        }
}

/* Behind its facet, only the end of the solid is missing. */
TEST(every_prefix_of_ascii_is_refused_within_its_bytes)
{
    static const char text[] = "solid x\n" FACET "endsolid";
    enum { FACET_END = sizeof "solid x\n" FACET - 2 };
    for (size_t size = 0; size < sizeof text; size++) {
        struct reading *reading = read_bytes(ZR_FORMAT_STL, text, size);
        assert_int_equal(reading->status, size < FACET_END ? ZR_BAD_SYNTAX : ZR_OK);
        if (size >= FACET_END) assert_int_equal(reading->scene->warning_count > 0, size < sizeof text - 1);
        reading_free(reading);
    }
}

TEST(small_arena_gives_no_memory_naming_the_ceiling)
{
    unsigned char bytes[BYTES_MAX];
    size_t size = make_binary(bytes, "x", MAX_TRIANGLES);
    assert_true(smallest_ceiling((struct zr_request){.format = ZR_FORMAT_STL}, bytes, size, 8192) > 512);
}

RUN_TESTS(NULL, NULL)
