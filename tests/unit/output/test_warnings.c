/* What is left out, replaced or moved: counted in info, warned of, and refused where the request is strict. */
#include <cjson/cJSON.h>
#include <math.h>

#include "base/run.h"
#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

TEST_ARENA(1 << 26)

/* A scene's answer: info, as `reading` has it in its arena. */
static struct zr_answer info_of(struct reading *reading)
{
    return scene_encode(&reading->arena, NULL, reading->scene);
}

static double count_in(const struct zr_answer *answer, const char *key)
{
    cJSON *info = cJSON_ParseWithLength(answer->bytes, answer->size);
    const cJSON *counts = cJSON_GetObjectItem(info, "counts"), *count = cJSON_GetObjectItem(counts, key);
    if (!count) fail_msg("counts has no %s", key);
    const double value = count->valuedouble;
    cJSON_Delete(info);
    return value;
}

static struct reading *read_for(enum zr_format format, const char *text, const char *channel, const char *strict)
{
    return read_request((struct zr_request){.format = format, .channel = channel, .strict = strict}, text, strlen(text),
                        zr_limits_default(), (size_t)1 << 28);
}

#define MESH(more) "{\"meshes\": [{" POSITIONS ", " more "}]}"
#define NOWHERE    "{\"meshes\": [{\"positions\": [[0,0,0],[1,0,0],[0,1,0],[0,0,0,0]], "
#define NORMALS_OF_POLYGONS                                                                                            \
    "{\"polygons\": [{" TRIANGLE "}, {" TRIANGLE ", \"normals\": [[0,0,1],[0,0,0],[0,-0.0,0]]}, {" TRIANGLE "}]}"

static const struct {
    enum zr_format format;
    const char *text, *key;
    double count;
    const char *warning; /* NULL: none */
} CASES[] = {
    {ZR_FORMAT_JSON, MESH("\"faces\": [[0,1,2]]"), "degeneratePolygons", 0, NULL},
    {ZR_FORMAT_JSON, MESH("\"faces\": [[0,1,2],[0,1,1]]"), "degeneratePolygons", 1,
     "1 of 2 polygons have fewer than three distinct corners and were dropped, the first: face 1 of mesh 0"},
    {ZR_FORMAT_JSON, MESH("\"lines\": [[0,1],[1,2]]"), "degenerateLines", 0, NULL},
    {ZR_FORMAT_JSON, MESH("\"lines\": [[0,1],[1,1],[2,2]]"), "degenerateLines", 2,
     "2 of 3 lines have no length and were dropped, the first: line 1 of mesh 0"},
    {ZR_FORMAT_JSON, MESH("\"points\": [0,0,1]"), "unplaced", 0, NULL},
    {ZR_FORMAT_JSON, NOWHERE "\"faces\": [[0,1,2],[0,1,3]], \"lines\": [[0,3],[1,2]], \"points\": [3,3,1]}]}",
     "unplaced", 4, "were dropped, the first: position 3 of mesh 0"},
    {ZR_FORMAT_JSON, MESH("\"faces\": [[0,1,2]], \"normals\": [[0,0,1],[1,0,0],[0,1,0],[0,0,2]]"), "zeroNormals", 0,
     NULL},
    {ZR_FORMAT_JSON, MESH("\"faces\": [[0,1,2]], \"normals\": [[0,0,1],[0,0,0],[0,1,0],[0,0,0]]"), "zeroNormals", 2,
     "2 of 4 normals are zero, the first in mesh 0:"},
    {ZR_FORMAT_JSON, NORMALS_OF_POLYGONS, "zeroNormals", 2, "2 of 3 normals are zero, the first in mesh 0 'polygons':"},
    {ZR_FORMAT_OBJ, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 0\nf 1//1 2//2 3//1\nf 1 2 3\n", "zeroNormals", 1,
     "1 of 2 normals are zero"},
    {ZR_FORMAT_OBJ, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1 2 3\n", "zeroNormals", 0, NULL},
    {ZR_FORMAT_JSON, "{\"meshes\": [{\"heights\": [[0,1,2],[1,0,null],[1,1,1]]}]}", "leftOutCells", 2, NULL},
    {ZR_FORMAT_JSON, "{\"meshes\": [{\"heights\": [[0,1,2],[1,0,0],[1,1,1]]}]}", "leftOutCells", 0, NULL},
};

TEST(what_is_left_out_or_replaced_is_counted_and_warned_of)
{
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        struct reading *reading = read_for(CASES[i].format, CASES[i].text, "info", NULL);
        assert_read(reading);
        const struct zr_answer answer = info_of(reading);
        if (count_in(&answer, CASES[i].key) != CASES[i].count)
            fail_msg("case %zu: %s is %g", i, CASES[i].key, count_in(&answer, CASES[i].key));
        if (CASES[i].warning ? !strstr(answer.warnings, CASES[i].warning) : *answer.warnings != '\0')
            fail_msg("case %zu: %s", i, answer.warnings);
        reading_free(reading);
    }
}

TEST(pieces_and_outlines_that_are_cut_are_counted)
{
    struct reading *reading =
        read_for(ZR_FORMAT_JSON,
                 "{\"view\": {\"eye\": [0,0,2], \"orthographic\": {\"xmag\": 0.5, \"ymag\": 0.5}}, \"outline\": true, "
                 "\"polygons\": [{" TRIANGLE "}, {\"vertices\": [[0,0,0],[0,1,0],[1,0,0]]}]}",
                 "info", NULL);
    assert_read(reading);
    const struct zr_answer answer = info_of(reading);
    assert_true(count_in(&answer, "clipped") == 2 && count_in(&answer, "clippedOutlines") == 2);
    assert_true(count_in(&answer, "culledPieces") >= 1 && count_in(&answer, "drawnPieces") >= 1);
    assert_string_equal(answer.warnings, ""); /* nobody says that all must be seen */
    reading_free(reading);
}

/* By the identity as projection, depths of -1 to 1 are between the planes. */
TEST_AROUND(depths_of_a_base_beyond_the_planes_are_counted, open_arena, close_arena)
{
    enum { PIXELS = 8 * 8 };
    static const struct zr_output output = {.channel = ZR_CHANNEL_INFO, .encoding = ZR_ENCODING_JSON};
    static float depths[PIXELS];
    static uint32_t ids[PIXELS];
    const zr_vec4 p[] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}};
    const struct zr_base base = {.depth = depths, .face_id = ids, .first_face_id = 5};
    static struct test_scene test;
    scene_of_triangles(&test, 8, 8, p, 1);
    test.scene.base = &base;
    test.scene.views[0].outputs = &output;
    test.scene.views[0].output_count = 1;
    for (int i = 0; i < PIXELS; i++)
        depths[i] = i == 0 ? -1.000001f : i == 1 ? 1.000001f : INFINITY; /* rounding, and nothing there */
    struct zr_answer answer = scene_encode(&arena, NULL, &test.scene);
    assert_true(count_in(&answer, "clampedBaseDepths") == 0);
    assert_string_equal(answer.warnings, "");
    depths[7] = -1.5f;
    depths[8] = 3.0f;
    depths[9] = 0.5f;
    answer = scene_encode(&arena, NULL, &test.scene);
    assert_true(count_in(&answer, "clampedBaseDepths") == 2);
    assert_non_null(strstr(answer.warnings, "2 depths of the base are not between the near and the far plane"));
}

/* ---- strict ---- */

/* All that is known when it has been read. */
TEST(strict_reading_refuses_every_warning_of_the_scene)
{
    static const char text[] =
        "{\"meshes\": [{\"name\": \"a\", " POSITIONS ", \"faces\": [[0,1,2]]}, {\"name\": \"b\", " POSITIONS
        ", \"faces\": [[0,1,2]]}], \"nodes\": [{\"mesh\": \"a\"}], "
        "\"background\": \"white\", \"polygons\": [{" TRIANGLE ", \"color\": \"#ff000080\"}]}";
    struct reading *reading = read_for(ZR_FORMAT_JSON, text, NULL, "1");
    assert_complaint(reading, ZR_BAD_SCENE, "", "1 of 2 meshes are placed by no node");
    assert_int_equal(reading->error.count, 2);
    assert_non_null(strstr(reading->error.items[1].detail, "alpha below 1"));
    reading_free(reading);
    reading = read_for(ZR_FORMAT_JSON, text, NULL, "0");
    assert_read(reading);
    assert_int_equal(reading->scene->warning_count, 2);
    reading_free(reading);
}

TEST(strict_is_a_flag)
{
    static const struct {
        const char *text;
        int strict; /* -1: refused */
    } cases[] = {{"1", 1}, {"true", 1}, {"0", 0}, {"false", 0}, {NULL, 0}, {"yes", -1}, {"", -1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_for(ZR_FORMAT_JSON, "{" POLYGONS "}", NULL, cases[i].text);
        if (cases[i].strict < 0)
            assert_complaint(reading, ZR_BAD_REQUEST, "", "parameter strict: ");
        else
            assert_int_equal(reading->scene->is_strict, cases[i].strict);
        reading_free(reading);
    }
}

/* What ends it: 0 finding the view, 1 rendering, 2 encoding; 3: nothing. */
static int step_that_refuses(const struct zr_scene *scene, struct zr_arena *memory, struct zr_error *error)
{
    const struct zr_resolved_view *resolved = NULL;
    const struct zr_frame *frame = NULL;
    struct zr_answer answer = {0};
    enum zr_status status = zr_resolved_view_find(&(struct zr_run){.arena = memory, .error = error}, scene, &resolved);
    int step = 0;
    if (status == ZR_OK)
        status = zr_render(&(struct zr_run){.arena = memory, .error = error}, scene, resolved, &frame), step++;
    if (status == ZR_OK)
        status = zr_encode(&(struct zr_run){.arena = memory, .error = error}, scene, frame, &answer), step++;
    if (status == ZR_OK) return 3;
    assert_int_equal(status, ZR_BAD_SCENE);
    assert_null(answer.bytes);
    return step;
}

TEST(strict_ends_as_soon_as_a_warning_is_known)
{
    static const struct {
        const char *text, *detail;
        int step;
    } cases[] = {
        {"{" POLYGONS "}", NULL, 3},
        {MESH("\"faces\": [[0,1,2],[0,1,1]]"), "fewer than three distinct corners", 2},
        {"{\"view\": {\"eye\": [0,0,-5]}, " POLYGONS "}", "nothing is visible", 2},
        {"{" POLYGONS ", \"outputs\": [{\"channel\": \"depth\", \"encoding\": \"png16\", \"scale\": 1e-6}]}",
         "does not fit 16 bits", 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reading *reading = read_for(ZR_FORMAT_JSON, cases[i].text, NULL, "true");
        assert_read(reading);
        struct zr_error error = {.count = 0};
        assert_int_equal(step_that_refuses(reading->scene, &reading->arena, &error), cases[i].step);
        assert_int_equal(error.count, cases[i].detail != NULL);
        if (cases[i].detail && !strstr(error.items[0].detail, cases[i].detail)) fail_msg("%s", error.items[0].detail);
        reading_free(reading);
    }
}

RUN_TESTS(NULL, NULL)
