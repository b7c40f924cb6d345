/* What a body is, and what is asked of it: media types, bytes that have none, parameters of the query. */
#include <stdio.h>
#include <string.h>

#include "input/formats/formats.h"
#include "parameter_rows.h"
#include "server/support/problems.h"
#include "support/tests.h"

static struct daemon server;

static const char TRIANGLE_OBJ[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
static const char TRIANGLE_STL[] = "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                   "vertex 0 1 0\nendloop\nendfacet\nendsolid t\n";

static int start(void **state)
{
    (void)state;
    server = daemon_start(NULL);
    return 0;
}

static int stop(void **state)
{
    (void)state;
    daemon_stop(&server);
    return 0;
}

/* POST with one content type (NULL: none). */
static struct reply post(const char *target, const char *type, const char *body)
{
    return client_send(&server, "POST", target, (const char *const[]){type ? type : "Content-Type:", NULL}, body,
                       strlen(body));
}

static long post_status(const char *target, const char *type, const char *body)
{
    struct reply reply = post(target, type, body);
    long status = reply.status;
    reply_free(&reply);
    return status;
}

TEST(meshes_are_rendered_with_parameters)
{
    assert_int_equal(post_status("/v1/render", "Content-Type: model/obj", TRIANGLE_OBJ), 200);
    assert_int_equal(post_status("/v1/render", "Content-Type: model/stl", TRIANGLE_STL), 200);
    struct reply reply = post("/v1/render?preset=top&width=64&height=32&channel=depth&encoding=npy",
                              "Content-Type: model/obj; charset=utf-8", TRIANGLE_OBJ);
    assert_int_equal(reply.status, 200);
    assert_memory_equal(reply.body, "\x93NUMPY", 6);
    reply_free(&reply);
}

TEST(answers_tell_the_look_with_its_version)
{
    static const struct {
        const char *target, *type, *body, *look;
    } cases[] = {
        {"/v1/render", "Content-Type: model/obj", TRIANGLE_OBJ, "studio@1"},
        {"/v1/render?channel=depth", "Content-Type: model/stl", TRIANGLE_STL, "studio@1"},
        {"/v1/render?look=technical", "Content-Type: model/obj", TRIANGLE_OBJ, "technical@1"},
        {"/v1/render?look=textbook@1", "Content-Type: model/obj", TRIANGLE_OBJ, "textbook@1"},
        {"/v1/render", NULL, "{\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]}", "textbook@1"},
        {"/v1/render", NULL, "{\"look\":\"dark\",\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]}", "dark@1"},
        {"/v1/render", NULL, "{\"polygons\":[]}", ""}}; /* refused: nothing was drawn */
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reply reply = post(cases[i].target, cases[i].type, cases[i].body);
        assert_int_equal(reply.status, *cases[i].look ? 200 : 422);
        assert_string_equal(reply_header(&reply, "Zraster-Look"), cases[i].look);
        reply_free(&reply);
    }
}

TEST(answers_name_the_encoder_of_lossy_files)
{
    static const struct {
        const char *target, *type, *encoder, *end;
    } cases[] = {{"/v1/render?encoding=jpeg", "image/jpeg", "libjpeg", "; quality=85"},
                 {"/v1/render?encoding=webp&quality=30", "image/webp", "libwebp ", "; quality=30"},
                 {"/v1/render?encoding=webp&lossless=true", "image/webp", "libwebp ", "; lossless"},
                 {"/v1/render?channel=color,info&encoding=jpeg&quality=7", "application/zip", "libjpeg", "; quality=7"},
                 {"/v1/render?channel=depth&encoding=tiff", "image/tiff", "", ""},
                 {"/v1/render?channel=depth&encoding=pfm", "image/x-portable-floatmap", "", ""},
                 {"/v1/render", "image/png", "", ""}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reply reply = post(cases[i].target, "Content-Type: model/obj", TRIANGLE_OBJ);
        assert_int_equal(reply.status, 200);
        assert_string_equal(reply_header(&reply, "Content-Type"), cases[i].type);
        const char *encoder = reply_header(&reply, "Zraster-Encoder");
        assert_memory_equal(encoder, cases[i].encoder, strlen(cases[i].encoder));
        assert_true(strlen(encoder) >= strlen(cases[i].end));
        assert_string_equal(encoder + strlen(encoder) - strlen(cases[i].end), cases[i].end);
        reply_free(&reply);
    }
}

TEST(a_file_of_too_many_bytes_is_refused_with_its_smallest_size)
{
    static const char *const targets[] = {"/v1/render?encoding=jpeg&maxBytes=100", "/v1/render?maxBytes=100",
                                          "/v1/render?encoding=webp&lossless=true&maxBytes=100"};
    for (size_t i = 0; i < sizeof targets / sizeof targets[0]; i++) {
        struct reply reply = post(targets[i], "Content-Type: model/obj", TRIANGLE_OBJ);
        assert_int_equal(reply.status, 422);
        assert_non_null(strstr(reply.body, "\"pointer\":\"/outputs/0/maxBytes\""));
        assert_non_null(strstr(reply.body, "100 bytes are too few for this picture, which has "));
        reply_free(&reply);
    }
    assert_int_equal(post_status("/v1/render?encoding=jpeg&maxBytes=20000", "Content-Type: model/obj", TRIANGLE_OBJ),
                     200);
}

TEST(parameters_are_percent_decoded)
{
    assert_int_equal(post_status("/v1/render?chan%6eel=d%65pth", "Content-Type: model/obj", TRIANGLE_OBJ), 200);
    assert_int_equal(post_status("/v1/render?channel=%zz", "Content-Type: model/obj", TRIANGLE_OBJ), 400);
    assert_int_equal(post_status("/v1/render?channel=%00", "Content-Type: model/obj", TRIANGLE_OBJ), 400);
    assert_int_equal(post_status("/v1/render?channel=depth%", "Content-Type: model/obj", TRIANGLE_OBJ), 400);
}

#define HEIGHTS "{\"meshes\": [{\"heights\": [[0,1,3],[2,4,1]], \"colormap\": \"viridis\"}]"

/* Asked for by the scene or by the query, it is the same; data have none, and what has no numbers has a warning. */
TEST(colour_bars_are_drawn_over_pictures_alone)
{
    static const char with[] = HEIGHTS ", \"colorBar\": true}", without[] = HEIGHTS "}";
    struct reply plain = post("/v1/render", JSON_TYPE, without), bar = post("/v1/render", JSON_TYPE, with);
    struct reply asked = post("/v1/render?colorBar=true", JSON_TYPE, without);
    struct reply off = post("/v1/render?colorBar=false", JSON_TYPE, with);
    assert_true(plain.status == 200 && bar.status == 200 && asked.status == 200 && off.status == 200);
    assert_true(bar.size == asked.size && memcmp(bar.body, asked.body, bar.size) == 0);
    assert_true(plain.size == off.size && memcmp(plain.body, off.body, off.size) == 0);
    assert_false(bar.size == plain.size && memcmp(bar.body, plain.body, bar.size) == 0);
    assert_string_equal(reply_header(&bar, "Zraster-Warnings"), "");
    reply_free(&plain);
    reply_free(&bar);
    reply_free(&asked);
    reply_free(&off);
    struct reply depth = post("/v1/render?channel=depth", JSON_TYPE, without);
    struct reply same = post("/v1/render?channel=depth&colorBar=true", JSON_TYPE, without);
    assert_true(depth.size == same.size && memcmp(depth.body, same.body, depth.size) == 0);
    reply_free(&depth);
    reply_free(&same);
    struct reply none = post("/v1/render?colorBar=true", "Content-Type: model/obj", TRIANGLE_OBJ);
    assert_int_equal(none.status, 200);
    assert_non_null(strstr(reply_header(&none, "Zraster-Warnings"), "colorBar: no mesh that is drawn has scalars"));
    reply_free(&none);
    assert_problem(post("/v1/render?colorBar=maybe", JSON_TYPE, with), 400, "colorBar: 'maybe' is unknown");
    assert_problem(post("/v1/render?colorBar=true&strict=1", "Content-Type: model/obj", TRIANGLE_OBJ), 422, "colorBar");
    assert_problem(post("/v1/render", JSON_TYPE, HEIGHTS ", \"colorBar\": 1}"), 422,
                   "expected true, false or an object");
}

TEST(unknown_parameter_is_named_with_the_known_ones)
{
    assert_problem(post("/v1/render?colour=red", JSON_TYPE, GOOD_SCENE), 400, "'colour'");
#define ROW(name, ...) ", " #name
    static const char names[] = ZR_PARAMETER_ROWS(ROW);
#undef ROW
    assert_problem(post("/v1/render?colour=red", JSON_TYPE, GOOD_SCENE), 400, names + strlen(", "));
}

TEST(duplicate_parameter_is_refused)
{
    assert_problem(post("/v1/render?channel=depth&channel=depth", JSON_TYPE, GOOD_SCENE), 400,
                   "duplicate parameter 'channel'");
}

TEST(view_of_a_mesh_is_refused_with_json)
{
    assert_int_equal(post_status("/v1/render?preset=top", JSON_TYPE, GOOD_SCENE), 400);
}

TEST(content_types_are_matched_as_rfc_9110_says)
{
    assert_int_equal(post_status("/v1/render", "Content-Type: Application/JSON; charset=UTF-8", GOOD_SCENE), 200);
    assert_int_equal(post_status("/v1/render", "Content-Type: application/json;x=y", GOOD_SCENE), 200);
    assert_int_equal(post_status("/v1/render", "Content-Type: application/jsonx", GOOD_SCENE), 415);
    assert_int_equal(post_status("/v1/render", "Content-Type: application/sla", TRIANGLE_STL), 200);
    char types[400];
    snprintf(types, sizeof types, "'image/png' is none of: %s, multipart/form-data", zr_format_types_join().text);
    assert_problem(post("/v1/render", "Content-Type: image/png", GOOD_SCENE), 415, types);
}

TEST(bytes_tell_what_no_content_type_tells)
{
    static const char *const types[] = {NULL, "Content-Type: application/octet-stream", "Content-Type: text/plain",
                                        "Content-Type: application/x-www-form-urlencoded"};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        assert_int_equal(post_status("/v1/render", types[i], GOOD_SCENE), 200);
        assert_int_equal(post_status("/v1/render", types[i], TRIANGLE_OBJ), 200);
        assert_int_equal(post_status("/v1/render?preset=top", types[i], TRIANGLE_STL), 200);
        assert_int_equal(post_status("/v1/render?preset=top", types[i], GOOD_SCENE), 400);
        assert_problem(post("/v1/render", types[i], "\x89PNG and so on"), 415,
                       "looks like a PNG picture, which is none of: application/json");
        assert_problem(post("/v1/render", types[i], "what is it"), 415, "looks like none of: application/json");
    }
}

TEST(wrong_content_type_is_told_what_the_bytes_look_like)
{
    assert_problem(post("/v1/render", JSON_TYPE, TRIANGLE_STL), 400, "the type is JSON, but the body looks like STL");
    assert_problem(post("/v1/render", "Content-Type: model/obj", GOOD_SCENE), 400,
                   "the type is OBJ, but the body looks like JSON");
    assert_problem(post("/v1/render", "Content-Type: model/stl", TRIANGLE_OBJ), 400,
                   "the type is STL, but the body looks like OBJ");
    assert_problem(post("/v1/render", JSON_TYPE, "PK\x03\x04"), 400, "looks like ZIP");
}

RUN_TESTS(start, stop)
