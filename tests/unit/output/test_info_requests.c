/* The channel info of requests, as they are read: cameras, facts without a picture, unit and up. */
#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

#include "base/run.h"
#include "output/info.h"
#include "render_request.h"
#include "support/scenes.h"
#include "support/test_arena.h"
#include "support/tests.h"

TEST_ARENA(1 << 27)

#define SCENE(view) "{\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,1]]}]," view "}"

/* Returns the info of a request whose body is a text. */
static struct zr_answer answer_of(struct zr_request request)
{
    const struct zr_limits limits = zr_limits_default();
    const struct zr_scene *scene;
    struct zr_error error = {.count = 0};
    request.size = strlen(request.bytes);
    if (!request.render) request.channel = "info";
    const enum zr_status status =
        zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &scene);
    if (status != ZR_OK) fail_msg("%s: %s", request.bytes, error.count ? error.items[0].detail : "");
    return scene_encode(&arena, NULL, scene);
}

/* Returns the parsed info, which the caller deletes. */
static cJSON *info_of_text(enum zr_format format, const char *text, const char *look)
{
    const struct zr_answer answer = answer_of((struct zr_request){.format = format, .bytes = text, .look = look});
    cJSON *info = cJSON_ParseWithLength(answer.bytes, answer.size);
    assert_non_null(info);
    return info;
}

/* ---- where the camera stands ---- */

static void assert_angles(cJSON *info, const char *up, double azimuth, double elevation)
{
    const cJSON *camera = cJSON_GetObjectItem(info, "camera");
    const cJSON *got[2] = {cJSON_GetObjectItem(camera, "azimuthDegrees"),
                           cJSON_GetObjectItem(camera, "elevationDegrees")};
    assert_true(cJSON_IsNumber(got[0]) && cJSON_IsNumber(got[1]));
    if (got[0]->valuedouble != azimuth || got[1]->valuedouble != elevation)
        fail_msg("%g, %g instead of %g, %g", got[0]->valuedouble, got[1]->valuedouble, azimuth, elevation);
    assert_string_equal(cJSON_GetObjectItem(camera, "up")->valuestring, up);
}

TEST_AROUND(info_has_the_default_views_of_looks, open_arena, close_arena)
{
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\n";
    static const char stl[] = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 1\n"
                              "endloop\nendfacet\nendsolid a\n";
    cJSON *info = info_of_text(ZR_FORMAT_OBJ, obj, NULL);
    assert_angles(info, "y", 35, 28);
    assert_non_null(cJSON_GetObjectItem(cJSON_GetObjectItem(info, "camera"), "eye"));
    assert_string_equal(cJSON_GetObjectItem(info, "look")->valuestring, "studio@1");
    cJSON_Delete(info);
    info = info_of_text(ZR_FORMAT_STL, stl, "outdoor");
    assert_angles(info, "y", 35, 28); /* the mesh is turned, and the world with it */
    assert_string_equal(cJSON_GetObjectItem(info, "look")->valuestring, "outdoor@1");
    cJSON_Delete(info);
    info = info_of_text(ZR_FORMAT_OBJ, obj, "technical");
    assert_angles(info, "y", 45, 35.264);
    assert_null(cJSON_GetObjectItem(cJSON_GetObjectItem(info, "camera"), "eye"));
    cJSON_Delete(info);
}

TEST_AROUND(angles_of_views_equal_the_given_angles, open_arena, close_arena)
{
    static const struct {
        const char *text, *up;
        double azimuth, elevation;
    } cases[] = {
        {SCENE("\"view\":{\"preset\":\"front\"}"), "y", 0, 0},
        {SCENE("\"view\":{\"preset\":\"back\"}"), "y", 180, 0},
        {SCENE("\"view\":{\"preset\":\"left\"}"), "y", -90, 0},
        {SCENE("\"view\":{\"preset\":\"top\"}"), "y", 0, 90},
        {SCENE("\"view\":{\"preset\":\"bottom\"}"), "y", 0, -90},
        {SCENE("\"view\":{\"azimuthDegrees\":-120.5,\"elevationDegrees\":-33.25}"), "y", -120.5, -33.25},
        {SCENE("\"up\":\"z\",\"view\":{\"azimuthDegrees\":200,\"elevationDegrees\":10}"), "z", -160, 10},
        {SCENE("\"up\":\"z\",\"view\":{\"preset\":\"right\"}"), "z", 90, 0},
        {SCENE("\"up\":\"z\",\"look\":\"studio\""), "z", 35, 28},
        {SCENE("\"view\":{\"eye\":[3,0,3],\"target\":[0,0,0]}"), "y", 45, 0},
        /* One that is wider than it is high: what it looks along is z all the same. */
        {SCENE("\"view\":{\"worldToCamera\":[[2,0,0,0],[0,1,0,0],[0,0,3,-9],[0,0,0,1]]}"), "y", 0, 0},
        {SCENE("\"view\":{\"projectionMatrix\":[[1,0,0,0],[0,1,0,0],[0,0,-0.1,0],[0,0,0,1]]}"), "y", 0, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        cJSON *info = info_of_text(ZR_FORMAT_JSON, cases[i].text, NULL);
        assert_angles(info, cases[i].up, cases[i].azimuth, cases[i].elevation);
        cJSON_Delete(info);
        zr_arena_reset(&arena, SIZE_MAX);
    }
}

TEST_AROUND(info_has_the_eye_of_the_view, open_arena, close_arena)
{
    cJSON *info = info_of_text(ZR_FORMAT_JSON, SCENE("\"view\":{\"eye\":[3,1,-2],\"target\":[0,0,0]}"), NULL);
    const cJSON *eye = cJSON_GetObjectItem(cJSON_GetObjectItem(info, "camera"), "eye");
    const double want[3] = {3, 1, -2};
    assert_int_equal(cJSON_GetArraySize(eye), 3);
    for (int k = 0; k < 3; k++)
        assert_true(fabs(cJSON_GetArrayItem(eye, k)->valuedouble - want[k]) < 1e-5);
    cJSON_Delete(info);
}

/* ---- facts without a picture ---- */

/* info is the default output. It lacks all keys about pixels, and has the camera and the parts. */
TEST_AROUND(without_a_picture_info_has_no_pixels, open_arena, close_arena)
{
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 3 2 1\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    static const char *const absent[] = {"\"pixels\"", "\"faces\":[", "\"backgroundPixels\"", "\"triangles\":0",
                                         "nothing is visible"};
    static const char *const present[] = {
        "\"worldToCamera\":[",
        "\"bounds\":{",
        "\"polygons\":4",
        "\"triangles\":4",
        "\"volume\":0.1666666666",
        "\"closed\":true,\"shells\":{\"outward\":1,\"inward\":0,\"open\":0},\"color\":",
        "\"faces\":4",
        "\"warnings\":[]"};
    const struct zr_answer answer =
        answer_of((struct zr_request){.format = ZR_FORMAT_OBJ, .bytes = obj, .render = "false"});
    for (size_t i = 0; i < sizeof absent / sizeof *absent; i++)
        if (strstr(answer.bytes, absent[i])) fail_msg("%s in %s", absent[i], (const char *)answer.bytes);
    for (size_t i = 0; i < sizeof present / sizeof *present; i++)
        if (!strstr(answer.bytes, present[i])) fail_msg("no %s in %s", present[i], (const char *)answer.bytes);
}

/* The parameter overrides the key of a scene. */
TEST_AROUND(the_picture_is_left_out_by_key_or_parameter, open_arena, close_arena)
{
    static const char not_drawn[] = "{\"render\":false,\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,1]]}],"
                                    "\"outputs\":[{\"channel\":\"info\"}]}";
    static const struct {
        const char *render;
        bool has_pixels;
    } cases[] = {{NULL, false}, {"false", false}, {"true", true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zr_answer answer =
            answer_of((struct zr_request){.format = ZR_FORMAT_JSON, .bytes = not_drawn, .render = cases[i].render});
        assert_int_equal(strstr(answer.bytes, "\"pixels\"") != NULL, cases[i].has_pixels);
    }
}

TEST_AROUND(other_channels_need_a_picture, open_arena, close_arena)
{
    static const struct {
        const char *text, *channel, *render, *pointer, *detail;
    } cases[] = {
        {SCENE("\"render\":false,\"outputs\":[{\"channel\":\"color\"}]"), NULL, NULL, "/render",
         "false draws nothing, so the channel color has no values"},
        {SCENE("\"render\":false"), "info,depth", NULL, "/render", "the channel depth has no values"},
        {SCENE("\"window\":{}"), "layers", "0", "", "parameter render: false draws nothing, so the channel layers"},
        {SCENE("\"render\":1"), "info", NULL, "/render", "true or false"}};
    const struct zr_limits limits = zr_limits_default();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct zr_scene *scene;
        struct zr_error error = {.count = 0};
        const struct zr_request request = {.format = ZR_FORMAT_JSON,
                                           .bytes = cases[i].text,
                                           .size = strlen(cases[i].text),
                                           .channel = cases[i].channel,
                                           .render = cases[i].render};
        assert_int_equal(zr_scene_read(&(struct zr_run){.arena = &arena, .error = &error}, &request, &limits, &scene),
                         ZR_BAD_SCENE);
        if (strcmp(error.items[0].pointer, cases[i].pointer) != 0 || !strstr(error.items[0].detail, cases[i].detail))
            fail_msg("%s: %s", error.items[0].pointer, error.items[0].detail);
    }
}

/* ---- unit and up ---- */

TEST_AROUND(unit_and_up_describe_the_file, open_arena, close_arena)
{
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    static const char tent[] = "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv .5 1.5 2\nv 3.5 1.5 2\n"
                               "f 4 3 2 1\nf 1 2 6 5\nf 2 3 6\nf 3 4 5 6\nf 4 1 5\n";
    static const char triangle[] = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                   "vertex 0 1 1\nendloop\nendfacet\nendsolid a\n";
    static const char gltf[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"name\":\"wing\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"buffers\":[{\"byteLength\":36,\"uri\":"
        "\"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],\"bufferViews\":[{\"buffer\":0,"
        "\"byteLength\":36}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
        "\"min\":[0,0,0],\"max\":[1,1,0]}]}";
    static const struct {
        enum zr_format format;
        const char *text, *up, *want;
    } cases[] = {{ZR_FORMAT_OBJ, obj, NULL, "\"unit\":null,\"up\":{\"axis\":\"y\",\"source\":\"format\"},"},
                 {ZR_FORMAT_OBJ, obj, "-z", "\"unit\":null,\"up\":{\"axis\":\"-z\",\"source\":\"parameter\"},"},
                 {ZR_FORMAT_OBJ, tent, "auto", "\"unit\":null,\"up\":{\"axis\":\"z\",\"source\":\"auto\"},"},
                 {ZR_FORMAT_STL, triangle, NULL, "\"unit\":null,\"up\":{\"axis\":\"z\",\"source\":\"format\"},"},
                 {ZR_FORMAT_GLTF, gltf, NULL, "\"unit\":\"metre\",\"up\":{\"axis\":\"y\",\"source\":\"format\"},"},
                 {ZR_FORMAT_GLTF, gltf, "auto", "\"unit\":\"metre\",\"up\":{\"axis\":\"y\",\"source\":\"format\"},"},
                 {ZR_FORMAT_GLTF, gltf, "x", "\"unit\":\"metre\",\"up\":{\"axis\":\"x\",\"source\":\"parameter\"},"},
                 {ZR_FORMAT_JSON, "{\"up\":\"z\",\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,1]]}]}", NULL,
                  "\"unit\":null,\"up\":{\"axis\":\"z\",\"source\":\"scene\"},"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct zr_answer answer =
            answer_of((struct zr_request){.format = cases[i].format, .bytes = cases[i].text, .up = cases[i].up});
        if (!strstr(answer.bytes, cases[i].want)) fail_msg("case %zu: %s", i, (const char *)answer.bytes);
        zr_arena_reset(&arena, SIZE_MAX);
    }
}

RUN_TESTS(NULL, NULL)
