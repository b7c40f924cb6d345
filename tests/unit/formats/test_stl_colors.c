/* Colours of facets in binary STL: detection of the dialects, and the colours in the picture. */
#include <stdio.h>

#include "support/tests.h"
#include "unit/common/by_teams.h"

enum { FACETS = 4, MANY = 20000, HEADER = 80, TRIANGLE = 50 };

#define R                                                                                                              \
    {                                                                                                                  \
        1, 0, 0                                                                                                        \
    }
#define G                                                                                                              \
    {                                                                                                                  \
        0, 1, 0                                                                                                        \
    }
#define B                                                                                                              \
    {                                                                                                                  \
        0, 0, 1                                                                                                        \
    }
#define W                                                                                                              \
    {                                                                                                                  \
        1, 1, 1                                                                                                        \
    }
#define K                                                                                                              \
    {                                                                                                                  \
        0, 0, 0                                                                                                        \
    }

#define MAGICS "by hand COLOR=\xFF\xFF\x00\x80,MATERIAL=\x01\x02\x03\x04"
#define Y                                                                                                              \
    {                                                                                                                  \
        1, 1, 0                                                                                                        \
    } /* its part */

static const struct {
    const char *header;
    uint16_t attributes[FACETS];
    bool has_colors;
    float colors[FACETS][3];
} cases[] = {
    /* no colours */
    {"x", {0, 0, 0, 0}, false, {K}},
    {"x", {0x7C00, 0x001F, 1, 0x7FFF}, false, {K}},
    {"x", {0xFC00, 0x801F, 1, 0x83E0}, false, {K}},      /* any bytes */
    {"x", {0xFFFF, 0xFFFF, 0xFFFF, 0xFFFF}, false, {K}}, /* a filler */
    {"x", {0xFFFF, 0, 0xFFFF, 0xFFFF}, false, {K}},
    {"COLOUR=\x01\x02\x03\x04", {1, 2, 3, 4}, false, {K}},
    /* VisCAM */
    {"x", {0xFC00, 0x83E0, 0x801F, 0xFFFF}, true, {R, G, B, W}},
    {"solid", {0x8000, 0x8000, 0x8000, 0x8000}, true, {K, K, K, K}},
    {"x", {0, 0xFC00, 0, 0}, true, {W, R, W, W}},
    {"MATERIAL=\x01\x02\x03\x04", {0xFC00, 0, 0, 0}, true, {R, W, W, W}},
    /* Magics */
    {MAGICS, {0x001F, 0x03E0, 0x7C00, 0x7FFF}, true, {R, G, B, W}},
    {MAGICS, {0x001F, 0xFFFF, 0x8000, 0}, true, {R, Y, Y, K}},
    {MAGICS, {0x001F, 0x001F, 0x001F, 0x001F}, true, {R, R, R, R}},
    {MAGICS, {0, 0, 0, 0}, true, {Y, Y, Y, Y}},
    {MAGICS, {0xFFFF, 0xFFFF, 0xFFFF, 0xFFFF}, true, {Y, Y, Y, Y}},
    {MAGICS, {0x801F, 0x801F, 0x801F, 0x801F}, true, {Y, Y, Y, Y}},
    {MAGICS, {0x801F, 0x83E0, 0xFC00, 0xFFFF}, true, {R, G, B, W}}, /* by MeshLab */
    {"0123456789012345678901234567890123456789012345678901234567890123456789COLOR=\xFF\xFF\x01\x80",
     {0, 0, 0, 0},
     true,
     {{1, 1, 1 / 255.0f}, {1, 1, 1 / 255.0f}, {1, 1, 1 / 255.0f}, {1, 1, 1 / 255.0f}}},
    {"01234567890123456789012345678901234567890123456789012345678901234567890COLOR=\xFF\xFF\x01",
     {0, 0, 0, 0},
     false,
     {K}}, /* cut by the end of the header */
};
enum { CASES = sizeof cases / sizeof *cases };

static void put_binary(struct text *text, const char *header, const uint16_t *attributes, size_t pattern,
                       uint32_t count)
{
    static const float triangle[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    char head[HEADER + 1] = "";
    snprintf(head, sizeof head, "%s", header);
    put(text, head, HEADER);
    put(text, (const char *)&count, sizeof count);
    for (uint32_t i = 0; i < count; i++) {
        put(text, (const char *)triangle, sizeof triangle);
        put(text, (const char *)&attributes[i % pattern], sizeof *attributes);
    }
}

static bool is_color(zr_vec4 a, const float *b)
{
    return a.x == b[0] && a.y == b[1] && a.z == b[2] && a.w == 1.0f;
}

TEST(attributes_are_colours_or_not)
{
    for (size_t i = 0; i < CASES; i++) {
        struct text text = {0};
        put_binary(&text, cases[i].header, cases[i].attributes, FACETS, FACETS);
        struct reading *reading = read_by(NULL, ZR_FORMAT_STL, &text);
        assert_read(reading);
        assert_int_equal(reading->scene->warning_count, 0);
        const zr_vec4 *colors = reading->scene->meshes[0].face_colors;
        if (!colors != !cases[i].has_colors) fail_msg("case %zu: %s colours", i, colors ? "has" : "has no");
        for (int k = 0; colors && k < FACETS; k++)
            if (!is_color(colors[k], cases[i].colors[k])) fail_msg("case %zu: facet %d", i, k);
        reading_free(reading);
        drop(&text);
    }
}

/* Five bits per component: all fractions of 31. */
TEST(each_shade_is_a_fraction_of_31)
{
    for (uint16_t shade = 1; shade < 32; shade++) {
        const uint16_t attribute = (uint16_t)(0x8000 | shade << 10 | (31 - shade) << 5);
        struct text text = {0};
        put_binary(&text, "x", &attribute, 1, 1);
        struct reading *reading = read_by(NULL, ZR_FORMAT_STL, &text);
        assert_read(reading);
        const float wanted[3] = {(float)shade / 31, (float)(31 - shade) / 31, 0};
        assert_true(is_color(reading->scene->meshes[0].face_colors[0], wanted));
        reading_free(reading);
        drop(&text);
    }
}

/* A single attribute determines the dialect of all parts of the file. */
TEST(colours_are_the_same_for_every_team)
{
    uint16_t attributes[MANY] = {0};
    static const uint16_t last[] = {0, 0x8000, 1, 0xFFFF};
    for (size_t i = 0; i < sizeof last / sizeof *last; i++) {
        attributes[MANY - 1] = last[i];
        for (int magics = 0; magics < 2; magics++) {
            struct text text = {0};
            put_binary(&text, magics ? MAGICS : "x", attributes, MANY, MANY);
            struct reading *reading = read_by_all(ZR_FORMAT_STL, &text);
            assert_read(reading);
            const zr_vec4 *colors = reading->scene->meshes[0].face_colors;
            assert_int_equal(colors != NULL, magics || last[i] == 0x8000);
            static const float yellow[3] = Y, black[3] = K, white[3] = W;
            if (colors) assert_true(is_color(colors[0], !magics ? white : last[i] ? black : yellow));
            reading_free(reading);
            drop(&text);
        }
    }
}

/* Facet colours replace the base colour of looks that are no material by white, as vertex colours do. `color` multiplies
 * them. */
TEST(colours_replace_the_base_of_looks)
{
    static const char *const looks[] = {"studio", "dark", "outdoor", "textbook"};
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++)
        for (int is_red = 0; is_red < 2; is_red++) {
            struct text text = {0};
            put_binary(&text, "x", cases[6].attributes, FACETS, FACETS);
            const struct zr_request request = {
                .format = ZR_FORMAT_STL, .look = looks[i], .color = is_red ? "red" : NULL};
            struct reading *reading =
                read_request(request, text.bytes, text.size, zr_limits_default(), (size_t)1 << 24);
            assert_read(reading);
            const zr_vec4 base = reading->scene->materials[0].base_color;
            assert_true(is_color(base, is_red ? (float[3])R : (float[3])W));
            assert_int_equal(reading->scene->warning_count, 0);
            reading_free(reading);
            drop(&text);
        }
}

TEST(small_arena_gives_no_memory_naming_the_ceiling)
{
    struct text text = {0};
    put_binary(&text, MAGICS, cases[6].attributes, FACETS, FACETS);
    assert_true(smallest_ceiling((struct zr_request){.format = ZR_FORMAT_STL}, text.bytes, text.size, 8192) > 512);
    drop(&text);
}

RUN_TESTS(start_teams, end_teams)
