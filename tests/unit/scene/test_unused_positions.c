/* Positions that nothing of their mesh is drawn at: the picture, its bounds and its warnings are those without them. */
#include <string.h>

#include "scene/camera/resolved_view.h"
#include "support/scenes.h"
#include "support/tests.h"
#include "unit/common/json_check.h"

#define WINDOW "{\"window\": {\"width\": 32, \"height\": 24}, \"outputs\": [{\"channel\": \"depth\"}], "
#define TALL   "[0,0,0],[1,0,0],[0,1,0],[0,0,2]"

static const struct {
    enum zr_format format;
    const char *with, *without;
} CASES[] = {
    {ZR_FORMAT_JSON, WINDOW "\"meshes\": [{\"positions\": [" TALL ",[0,30,0]], \"faces\": [[0,1,2],[0,2,3]]}]}",
     WINDOW "\"meshes\": [{\"positions\": [" TALL "], \"faces\": [[0,1,2],[0,2,3]]}]}"},
    {ZR_FORMAT_JSON, WINDOW "\"meshes\": [{\"positions\": [[0,0,-90]," TALL "], \"faces\": [[1,2,3],[1,3,4]]}]}",
     WINDOW "\"meshes\": [{\"positions\": [" TALL "], \"faces\": [[0,1,2],[0,2,3]]}]}"},
    {ZR_FORMAT_JSON, WINDOW "\"meshes\": [{\"positions\": [" TALL ",[50,0,0]], \"lines\": [[0,1],[2,3]]}]}",
     WINDOW "\"meshes\": [{\"positions\": [" TALL "], \"lines\": [[0,1],[2,3]]}]}"},
    {ZR_FORMAT_JSON, WINDOW "\"meshes\": [{\"positions\": [" TALL ",[50,0,0,1]], \"points\": [0,1,2,3]}]}",
     WINDOW "\"meshes\": [{\"positions\": [" TALL "], \"points\": [0,1,2,3]}]}"},
    /* A place that is not one, of three that share all else. */
    {ZR_FORMAT_JSON,
     WINDOW "\"meshes\": [{\"positions\": [" TALL
            ",[0,0,0,0],[7,7,7]], \"faces\": [[0,1,2],[0,2,3]], \"points\": [3]}]}",
     WINDOW "\"meshes\": [{\"positions\": [" TALL "], \"faces\": [[0,1,2],[0,2,3]], \"points\": [3]}]}"},
    {ZR_FORMAT_OBJ, "v 0 0 0\nv 1 0 0\nv 0 30 0\nv 0 1 0\nv 0 0 2\nf 1 2 4\nf 1 4 5\n",
     "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 2\nf 1 2 3\nf 1 3 4\n"},
};

static struct reading *read_case(enum zr_format format, const char *text)
{
    struct zr_request request = {.format = format, .channel = "depth"};
    if (format == ZR_FORMAT_OBJ) request.width = "32", request.height = "24";
    struct reading *reading = read_request(request, text, strlen(text), zr_limits_default(), (size_t)1 << 28);
    assert_read(reading);
    return reading;
}

TEST(pictures_are_those_without_them)
{
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        struct reading *with = read_case(CASES[i].format, CASES[i].with),
                       *without = read_case(CASES[i].format, CASES[i].without);
        const struct zr_answer got = scene_encode(&with->arena, NULL, with->scene),
                               want = scene_encode(&without->arena, NULL, without->scene);
        const struct zr_bounds a = zr_bounds_of(with->scene, NULL, NULL), b = zr_bounds_of(without->scene, NULL, NULL);
        if (got.size != want.size || memcmp(got.bytes, want.bytes, got.size) != 0) fail_msg("case %zu: other bytes", i);
        if (a.valid != b.valid || memcmp(&a.min, &b.min, sizeof a.min) != 0 ||
            memcmp(&a.max, &b.max, sizeof a.max) != 0)
            fail_msg("case %zu: other bounds", i);
        assert_string_equal(got.warnings, want.warnings);
        reading_free(with);
        reading_free(without);
    }
}

/* A hundred thousand of them, in words of many kinds. */
TEST(all_are_found_among_many)
{
    enum { COUNT = 100000, STEP = 7 };
    char *text = malloc(COUNT * 40), *at = text;
    at += sprintf(at, WINDOW "\"meshes\": [{\"positions\": [");
    for (int i = 0; i < COUNT; i++)
        at += i % STEP == 0 || i / 640 % 3 == 0 ? sprintf(at, "%s[%d,%d,0]", i ? "," : "", i % 100, i / 1000)
                                                : sprintf(at, ",[%d,-5000,9]", i);
    at += sprintf(at, "], \"points\": [");
    for (int i = 0; i < COUNT; i++)
        if (i % STEP == 0 || i / 640 % 3 == 0) at += sprintf(at, "%s%d", i ? "," : "", i);
    sprintf(at, "]}]}");
    struct reading *reading = read_scene(text);
    const struct zr_bounds bounds = zr_bounds_of(reading->scene, NULL, NULL);
    assert_true(bounds.min.x == 0.0f && bounds.max.x == 99.0f && bounds.min.y == 0.0f && bounds.max.y == 99.0f &&
                bounds.max.z == 0.0f);
    reading_free(reading);
    free(text);
}

RUN_TESTS(NULL, NULL)
