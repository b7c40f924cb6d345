/* The encoding svg: units, widths, parts and warnings. Every team and instruction set gives the same bytes. */
#include <math.h>

#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

TEST_ARENA(1 << 26)

#define CUBE                                                                                                           \
    "\"positions\": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[0,0,4],[4,0,4],[4,4,4],[0,4,4]], \"faces\": [[0,3,2,1],"         \
    "[4,5,6,7],[0,1,5,4],[2,3,7,6],[1,2,6,5],[0,4,7,3]]"
#define SVG                                                                                                            \
    "\"outputs\": [{\"channel\": \"color\", \"encoding\": \"svg\"}], \"window\": {\"width\": 100, \"height\": 50}"
#define LINES "\"edges\": {\"from\": \"mesh\"}, "
#define FRONT "\"view\": {\"direction\": [0,0,-1], \"orthographic\": {\"xmag\": 10, \"ymag\": 5}}, "

/* Returns the text of a scene's only file, and its warnings. */
static const char *file_of(struct zr_team *team, const char *unit, const char *text, const char **warnings)
{
    struct reading *reading = read_request((struct zr_request){.format = ZR_FORMAT_JSON}, text, strlen(text),
                                           zr_limits_default(), (size_t)1 << 28);
    assert_read(reading);
    struct zr_scene scene = *reading->scene;
    scene.file.unit = unit;
    const struct zr_answer answer = scene_encode(&arena, team, &scene);
    assert_string_equal(answer.content_type, "image/svg+xml");
    if (warnings) *warnings = zr_arena_copy(&arena, answer.warnings, strlen(answer.warnings) + 1);
    char *copy = zr_arena_alloc(&arena, answer.size + 1, 1);
    assert_non_null(copy);
    memcpy(copy, answer.bytes, answer.size);
    copy[answer.size] = 0;
    reading_free(reading);
    return copy;
}

static void assert_has(const char *text, const char *part)
{
    if (!strstr(text, part)) fail_msg("no %s in:\n%.1000s", part, text);
}

static const char CUBE_IN_FRONT[] = "{" LINES FRONT SVG ", \"meshes\": [{\"name\": \"box\", " CUBE "}]}";

TEST(a_scene_without_units_has_its_own)
{
    const char *file = file_of(NULL, NULL, CUBE_IN_FRONT, NULL);
    assert_has(file, "width=\"100\" height=\"50\" viewBox=\"0 0 20 10\"");
    assert_has(file, "data-name=\"box\"");
    assert_has(file, "<g class=\"outline\" stroke-width=\"0.2\">"); /* a pixel, 0.2 units */
}

TEST(known_units_become_millimetres_with_widths_of_iso)
{
    const char *file = file_of(NULL, "millimetre", CUBE_IN_FRONT, NULL);
    assert_has(file, "width=\"20mm\" height=\"10mm\" viewBox=\"0 0 20 10\"");
    assert_has(file, "stroke-width=\"0.18\"");
    assert_has(file_of(NULL, "centimetre", CUBE_IN_FRONT, NULL), "width=\"200mm\" height=\"100mm\"");
    assert_has(file_of(NULL, "inch", CUBE_IN_FRONT, NULL), "width=\"508mm\" height=\"254mm\"");
    assert_has(file_of(NULL, "metre", CUBE_IN_FRONT, NULL), "width=\"20000mm\"");
}

TEST(without_one_scale_it_is_in_pixels)
{
    assert_has(file_of(NULL, "millimetre",
                       "{" LINES "\"view\": {\"perspective\": {\"yfovDegrees\": 40}}, " SVG ", \"meshes\": [{" CUBE
                       "}]}",
                       NULL),
               "width=\"100\" height=\"50\" viewBox=\"0 0 100 50\"");
    static const char stretched[] =
        "{" LINES "\"view\": {\"direction\": [0,0,-1], \"orthographic\": {\"xmag\": 10, \"ymag\": 10}}, " SVG
        ", \"meshes\": [{" CUBE "}]}";
    assert_has(file_of(NULL, "millimetre", stretched, NULL), "width=\"100\" height=\"50\"");
}

TEST(hidden_lines_are_dashed)
{
    static const char text[] =
        "{\"edges\": {\"from\": \"mesh\", \"hiddenLines\": true, \"color\": \"#ff0000\"}, " SVG
        ", \"view\": {\"direction\": [-1,-2,-3], \"perspective\": {\"yfovDegrees\": 40}}, \"meshes\": [{" CUBE "}]}";
    const char *file = file_of(NULL, NULL, text, NULL);
    assert_has(file, "stroke=\"#ff0000\"");
    assert_has(file, "<g class=\"hidden\" stroke-width=\"0.5\" stroke-opacity=\"0.5\" stroke-dasharray=\"4 2.5\">");
}

TEST(parts_have_groups)
{
    static const char text[] =
        "{" LINES SVG ", \"meshes\": [{\"name\": \"a\", " CUBE "}], \"nodes\": [{\"mesh\": \"a\"}, {\"name\": \"b\", "
        "\"mesh\": \"a\", \"translation\": [9,0,0]}]}";
    const char *file = file_of(NULL, NULL, text, NULL);
    assert_has(file, "<g id=\"part-0\" data-name=\"a\">");
    assert_has(file, "<g id=\"part-1\" data-name=\"b\">");
}

TEST(lines_and_points_are_left_out_with_a_warning)
{
    static const char text[] = "{" LINES SVG ", \"meshes\": [{" CUBE ", \"lines\": [[0,6],[1,7]], \"points\": [0]}]}";
    const char *warnings;
    file_of(NULL, NULL, text, &warnings);
    assert_has(warnings, "2 lines and 1 points are left out of the SVG");
    file_of(NULL, NULL, CUBE_IN_FRONT, &warnings);
    assert_string_equal(warnings, "");
}

TEST(masks_hide_lines_with_a_warning)
{
    static const char text[] = "{" LINES SVG ", \"materials\": [{\"name\": \"m\", \"alphaMode\": \"MASK\"}], "
                               "\"meshes\": [{\"material\": \"m\", " CUBE "}]}";
    const char *warnings;
    file_of(NULL, NULL, text, &warnings);
    assert_has(warnings, "6 faces have the alphaMode MASK: they hide lines of the mesh");
}

TEST(the_file_is_the_same_for_every_team)
{
    static const char text[] = "{\"edges\": {\"from\": \"mesh\", \"hiddenLines\": true}, " SVG ", \"meshes\": [{" CUBE
                               "}, {\"positions\": [[-1,1,-1],[5,2,2],[2,5,7]], \"faces\": "
                               "[[0,1,2]]}]}";
    const char *alone = file_of(NULL, NULL, text, NULL);
    for (int threads = 2; threads < 5; threads++)
        for (enum zr_isa isa = 0; isa < ZR_ISA_COUNT; isa++) {
            if (!zr_isa_is_available(isa)) continue;
            struct zr_team *team = zr_team_create_for(threads, isa);
            assert_non_null(team);
            assert_string_equal(file_of(team, NULL, text, NULL), alone);
            zr_team_destroy(team);
        }
}

TEST(a_mesh_is_drawn_as_lines_in_the_look_technical)
{
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    struct reading *mesh = read_request((struct zr_request){.format = ZR_FORMAT_OBJ, .encoding = "svg"}, text,
                                        strlen(text), zr_limits_default(), 1 << 24);
    assert_read(mesh);
    const struct zr_answer answer = scene_encode(&arena, NULL, mesh->scene);
    assert_string_equal(answer.content_type, "image/svg+xml");
    assert_string_equal(answer.look, "technical@1");
    reading_free(mesh);
}

RUN_TESTS(open_arena, close_arena)
