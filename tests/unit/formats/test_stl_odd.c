/* Odd STL that many programs draw is drawn with one warning per kind, which `strict` turns into an error. */
#include <stdio.h>
#include <stdlib.h>

#include "support/files.h"
#include "support/tests.h"
#include "unit/common/input_check.h"

#define VERTICES "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1.5 0\n"
#define HEAD     "facet normal 0 0 1\nouter loop\n"
#define FACET    HEAD VERTICES "endloop\nendfacet\n"
#define CR_FACET "facet normal 0 0 1\router loop\rvertex 0 0 0\rvertex 1 0 0\rvertex 0 1.5 0\rendloop\rendfacet\r"

enum { FACES_MAX = 3, WARNINGS_MAX = 3 };

/* The corners of each face, and the warnings. */
static const struct {
    const char *text;
    unsigned corners[FACES_MAX];
    const char *warnings[WARNINGS_MAX];
} cases[] = {
    {"solid a\n" FACET "endsolid\n", {3}, {NULL}},
    {"\xEF\xBB\xBFsolid a\n" FACET "endsolid\n", {3}, {NULL}},
    /* line ends */
    {"solid a name\r" CR_FACET CR_FACET "endsolid a name\r",
     {3, 3},
     {"STL: 16 lines that end in CR alone, the first in line 1"}},
    {"\rsolid\r" CR_FACET "endsolid\rsolid b\r" CR_FACET "endsolid\n",
     {3, 3},
     {"STL: 18 lines that end in CR alone, the first in line 1"}},
    {"solid a\r\n" CR_FACET "endsolid", {3}, {NULL}}, /* any white space */
    {"solid a\r\r\n" FACET "endsolid\r\r\n", {3}, {NULL}},
    /* extra words after keywords */
    {"solid\n" HEAD VERTICES "endloop x\nendfacet 1\n" FACET "endsolid",
     {3, 3},
     {"STL: 2 lines with words that are ignored, the first in line 7: 'x'"}},
    {"solid\nfacet normal 0 0 1 # up\nouter loop of 3\nvertex 0 0 0 255 0 0\nvertex 1 0 0 ; b\nvertex 0 1 0 a "
     "b\nendloop\n"
     "endfacet 1 2 3\nendsolid",
     {3},
     {"STL: 6 lines with words that are ignored, the first in line 2: '# up'"}},
    /* keywords in two words */
    {"solid\n" HEAD VERTICES "end loop\nEnd Facet\nend solid x\n",
     {3},
     {"STL: 3 keywords in two words, the first in line 7: 'end loop'"}},
    /* comments, colours and other lines */
    {"# made by hand\n// twice\nsolid\n; a\n" HEAD "# endloop\n" VERTICES
     "! b\nendloop\n%c\nendfacet\n#\nendsolid\n# end",
     {3},
     {"STL: 8 comment lines ignored, the first in line 1: '# made by hand'"}},
    {"solid\ncolor 1 0 0\nfacet normal 0 0 1\nColour 0 1 0\nouter loop\n" VERTICES
     "color 1\nendloop\nendfacet\nendsolid",
     {3},
     {"STL: 3 colour lines ignored, the first in line 2: 'color 1 0 0'"}},
    {"solid\nunits mm\n" FACET "layer 2\nendsolid\nmade by hand\n",
     {3},
     {"STL: 3 unknown lines ignored, the first in line 2: 'units mm'"}},
    /* facets */
    {"solid\nfacet\nouter loop\n" VERTICES "endloop\nendfacet\nfacet normal\nouter loop\n" VERTICES
     "endloop\nendfacet\nfacet 0 0 1\nouter loop\n" VERTICES "endloop\nendfacet\nendsolid",
     {3, 3, 3},
     {"STL: 3 facets without a normal of three numbers, the first in line 2"}},
    {"solid\nfacet normal 0 1 outer loop\n" VERTICES "endloop\nendfacet\nendsolid",
     {3},
     {"STL: 1 facet without a normal of three numbers, line 2"}},
    {"solid\n" FACET HEAD "vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1.5 0\nendloop\nendfacet\n" FACET
     "endsolid",
     {3, 4, 3},
     {"STL: 1 facet of more than three corners, line 9"}},
    {"solid\n" HEAD "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1.5 0\nvertex .5 .5 0\nvertex 0 .5 0\nend loop\nendfacet\n",
     {5},
     {"STL: 1 keyword in two words, line 9: 'end loop'", "STL: 1 facet of more than three corners, line 2",
      "STL: 1 solid without 'endsolid', line 11"}},
    /* solids */
    {"solid\n" FACET, {3}, {"STL: 1 solid without 'endsolid', line 9"}},
    {"solid a\n" FACET "solid b\n" FACET "solid c\n" FACET "endsolid",
     {3, 3, 3},
     {"STL: 2 solids without 'endsolid', the first in line 9"}},
    {"solid a\n" FACET "endsolid a\n" FACET "endsolid\n" FACET "endsolid\n",
     {3, 3, 3},
     {"STL: 2 solids without 'solid', the first in line 10"}},
    /* any words as a normal */
    {"solid\nfacet normal outer loop vertex outer loop\n" VERTICES "endloop endfacet # a\nendsolid",
     {3},
     {"STL: 1 line with words that are ignored, line 6: '# a'"}},
};
enum { CASES = sizeof cases / sizeof *cases };

static const struct zr_request stl = {.format = ZR_FORMAT_STL}, strict_stl = {.format = ZR_FORMAT_STL, .strict = "1"};

static struct reading *read_case(size_t i, struct zr_request request)
{
    return read_request(request, cases[i].text, strlen(cases[i].text), zr_limits_default(), (size_t)1 << 28);
}

static void check_faces(const struct zr_mesh *mesh, const unsigned *corners)
{
    uint32_t faces = 0, end = 0;
    for (; faces < FACES_MAX && corners[faces]; faces++) {
        assert_int_equal(mesh->face_offsets[faces], end);
        end += corners[faces];
        assert_true(mesh->positions[end - corners[faces] + 1].x == 1.0f); /* the second corner */
    }
    assert_int_equal(mesh->face_count, faces);
    assert_int_equal(mesh->face_offsets[faces], end);
    assert_int_equal(mesh->position_count, end);
}

TEST(odd_text_is_drawn_and_warned_of)
{
    for (size_t i = 0; i < CASES; i++) {
        struct reading *reading = read_case(i, stl);
        uint32_t count = 0;
        if (reading->status != ZR_OK) fail_msg("%s: %s", cases[i].text, reading->error.items[0].detail);
        check_faces(&reading->scene->meshes[0], cases[i].corners);
        for (; count < WARNINGS_MAX && cases[i].warnings[count]; count++)
            if (count < reading->scene->warning_count)
                assert_string_equal(reading->scene->warnings[count], cases[i].warnings[count]);
        assert_int_equal(reading->scene->warning_count, count);
        reading_free(reading);
    }
}

TEST(strict_refuses_what_is_odd)
{
    for (size_t i = 0; i < CASES; i++) {
        struct reading *reading = read_case(i, strict_stl);
        const char *warning = cases[i].warnings[0];
        if (warning) assert_complaint(reading, ZR_BAD_SCENE, "", warning);
        assert_int_equal(reading->status, warning ? ZR_BAD_SCENE : ZR_OK);
        reading_free(reading);
    }
}

TEST(facets_of_too_many_corners_are_refused)
{
    static char text[64 << 10];
    size_t used = (size_t)sprintf(text, "solid\n" FACET HEAD);
    for (int i = 0; i < 1025; i++)
        used += (size_t)sprintf(text + used, "vertex %d 0 0\n", i);
    snprintf(text + used, sizeof text - used, "endloop\nendfacet\nendsolid\n");
    refuses(ZR_FORMAT_STL, text, ZR_BAD_SCENE, "", "line 9: a facet of 1025 corners; 3 to 1024 are allowed");
}

/* ---- files from other sources ---- */

/* The middle of far meshes is subtracted in double precision, in strict and in odd text, and in several parts. */
TEST(middle_of_far_meshes_is_their_origin)
{
    static const char facet[] =
        HEAD "vertex 408200.25 4080920.5 0\nvertex 408210.25 4080920.5 0\nvertex 408200.25 4080930.5 4\n";
    static const char *const ends[] = {"endloop\nendfacet\n", "end loop\nendfacet\n"};
    static const zr_vec4 want[] = {{-5, -5, -2, 1}, {5, -5, -2, 1}, {-5, 5, 2, 1}};
    for (size_t i = 0; i < 4; i++) {
        const size_t count = i < 2 ? 1 : 3000;
        char *text = calloc(count + 1, sizeof facet + 32), *at = text;
        assert_non_null(text);
        at += sprintf(at, "solid far\n");
        for (size_t k = 0; k < count; k++)
            at += sprintf(at, "%s%s", facet, ends[k + 1 == count ? i % 2 : 0]);
        sprintf(at, "endsolid\n");
        struct reading *reading = read_text(ZR_FORMAT_STL, text);
        assert_origin(reading, 408205.25, 4080925.5, 2);
        assert_int_equal(reading->scene->meshes[0].face_count, count);
        assert_memory_equal(reading->scene->meshes[0].positions + 3 * (count - 1), want, sizeof want);
        assert_int_equal(reading->scene->warning_count, i % 2);
        reading_free(reading);
        free(text);
    }
}

static struct reading *read_hunted(const char *name, struct zr_request request)
{
    const char *data = getenv("ZRASTER_DATA");
    char path[512];
    size_t size;
    snprintf(path, sizeof path, "%s/hunt/%s", data ? data : "../shared/data", name);
    char *bytes = file_read(path, &size);
    if (!bytes) {
        fprintf(stderr, "LEFT OUT: %s, which cannot be read (set ZRASTER_DATA)\n", path);
        skip();
    }
    struct reading *reading = read_request(request, bytes, size, zr_limits_default(), (size_t)1 << 28);
    free(bytes);
    return reading;
}

static void check_hunted(const char *name, const char *warning)
{
    struct reading *reading = read_hunted(name, stl);
    assert_read(reading);
    assert_int_equal(reading->scene->meshes[0].face_count, 12);
    assert_int_equal(reading->scene->warning_count, warning ? 1 : 0);
    if (warning) assert_string_equal(reading->scene->warnings[0], warning);
    reading_free(reading);
    reading = read_hunted(name, strict_stl);
    assert_int_equal(reading->status, warning ? ZR_BAD_SCENE : ZR_OK);
    reading_free(reading);
}

TEST(facet_colours_viscam_06)
{
    check_hunted("06-facet-colours-viscam.stl", NULL);
    struct reading *reading = read_hunted("06-facet-colours-viscam.stl", stl);
    const zr_vec4 *colors = reading->scene->meshes[0].face_colors;
    assert_non_null(colors);
    for (int i = 0; i < 12; i++)
        assert_true(colors[i].x == (i < 6) && colors[i].y == 0 && colors[i].z == (i >= 6) && colors[i].w == 1);
    reading_free(reading);
}

TEST(binary_solid_header_one_byte_more_08)
{
    check_hunted("08-binary-solid-header-one-byte-more.stl", "STL: 1 byte behind the last of 12 triangles ignored");
}

TEST(cr_only_09)
{
    check_hunted("09-cr-only.stl", "STL: 86 lines that end in CR alone, the first in line 1");
}

TEST(words_behind_endfacet_10)
{
    check_hunted("10-words-behind-endfacet.stl", "STL: 24 lines with words that are ignored, the first in line 7: 'x'");
}

RUN_TESTS(NULL, NULL)
