/* What a client of the HTTP API meets: routes, encodings, headers. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cjson/cJSON.h>
#include <zlib.h>

#include "server/support/problems.h"
#include "support/files.h"
#include "support/input/draco_check.h"
#include "support/tests.h"

#define TOKEN "s3cret-token"

static struct daemon server, guarded;

static int start(void **state)
{
    (void)state;
    server = daemon_start(NULL);
    guarded = daemon_start((const char *const[]){"--token", TOKEN, NULL});
    return 0;
}

static int stop(void **state)
{
    (void)state;
    daemon_stop(&server);
    daemon_stop(&guarded);
    return 0;
}

TEST(scene_gives_png)
{
    struct reply reply = client_render(&server, GOOD_SCENE);
    assert_int_equal(reply.status, 200);
    assert_string_equal(reply_header(&reply, "Content-Type"), "image/png");
    assert_int_equal(atol(reply_header(&reply, "Content-Length")), (long)reply.size);
    assert_memory_equal(reply.body, "\x89PNG\r\n\x1a\n", 8);
    reply_free(&reply);
}

TEST(same_scene_gives_same_picture)
{
    struct reply a = client_render(&server, GOOD_SCENE), b = client_render(&server, GOOD_SCENE);
    assert_true(reply_is_same(&a, &b));
    reply_free(&a);
    reply_free(&b);
}

TEST(every_algorithm_gives_the_same_picture)
{
    static const char *const words[] = {"halfspace", "edgelist", "trapezoid", "scanline", "painter"};
    struct reply plain = client_render(&server, GOOD_SCENE);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        char scene[256];
        snprintf(scene, sizeof scene, "{\"algorithm\":\"%s\",%s", words[i], &GOOD_SCENE[1]);
        struct reply reply = client_render(&server, scene);
        assert_int_equal(reply.status, 200);
        assert_true(reply_is_same(&reply, &plain));
        reply_free(&reply);
    }
    reply_free(&plain);
}

TEST(render_says_how_long_each_step_took)
{
    struct reply reply = client_render(&server, GOOD_SCENE);
    double parse = -1, queue = -1, render = -1, encode = -1;
    assert_int_equal(sscanf(reply_header(&reply, "Server-Timing"),
                            "parse;dur=%lf, queue;dur=%lf, render;dur=%lf, encode;dur=%lf", &parse, &queue, &render,
                            &encode),
                     4);
    assert_true(parse >= 0 && queue >= 0 && render >= 0 && encode >= 0);
    reply_free(&reply);
    reply = client_render(&server, "{");
    assert_int_equal(reply.status, 400);
    assert_int_equal(strncmp(reply_header(&reply, "Server-Timing"), "parse;dur=", 10), 0);
    assert_null(strstr(reply_header(&reply, "Server-Timing"), "render"));
    reply_free(&reply);
}

/* The same scene without anything odd is drawn, and so is this one where nobody is strict. */
TEST(strict_requests_get_warnings_as_errors)
{
    static const char ODD[] = "{\"meshes\":[{\"positions\":[[0,0,0],[1,0,0],[0,1,0]],\"faces\":[[0,1,2],[0,1,0]],"
                              "\"lines\":[[0,0]]}]}";
    static const char *const headers[] = {JSON_TYPE, NULL};
    struct reply reply = client_send(&server, "POST", "/v1/render?strict=0", headers, ODD, strlen(ODD));
    assert_int_equal(reply.status, 200);
    assert_string_equal(
        reply_header(&reply, "Zraster-Warnings"),
        "1 of 2 polygons have fewer than three distinct corners and were dropped, the first: face 1 of mesh "
        "0; 1 of 1 lines have no length and were dropped, the first: line 0 of mesh 0");
    reply_free(&reply);
    reply = client_send(&server, "POST", "/v1/render?strict=1", headers, ODD, strlen(ODD));
    assert_int_equal(reply.status, 422);
    assert_string_equal(reply_header(&reply, "Content-Type"), "application/problem+json");
    cJSON *problem = cJSON_ParseWithLength(reply.body, reply.size);
    const cJSON *errors = cJSON_GetObjectItem(problem, "errors");
    assert_int_equal(cJSON_GetArraySize(errors), 2);
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(cJSON_GetArrayItem(errors, 1), "detail")),
                        "1 of 1 lines have no length and were dropped, the first: line 0 of mesh 0");
    cJSON_Delete(problem);
    reply_free(&reply);
    reply = client_send(&server, "POST", "/v1/render?strict=1", headers, GOOD_SCENE, strlen(GOOD_SCENE));
    assert_int_equal(reply.status, 200);
    reply_free(&reply);
}

TEST(strict_requests_draw_files_that_are_compressed_by_draco)
{
    static const char *const headers[] = {"Content-Type: model/gltf+json", NULL};
    char text[2 * DRACO_BYTES_MOST];
    size_t size = draco_stream_file(0, "", text);
    struct reply reply = client_send(&server, "POST", "/v1/render?strict=1", headers, text, size);
    assert_int_equal(reply.status, 200);
    assert_string_equal(reply_header(&reply, "Zraster-Warnings"), "");
    reply_free(&reply);
    size = draco_stream_file(0, ",\"extensionsUsed\":[\"KHR_draco_mesh_compression\",\"X\"]", text);
    reply = client_send(&server, "POST", "/v1/render", headers, text, size);
    assert_int_equal(reply.status, 200);
    assert_string_equal(reply_header(&reply, "Zraster-Warnings"), "drawn without the extension 'X'");
    reply_free(&reply);
    memcpy(strstr(text, "RFJBQ08"), "AAAA", 4);
    reply = client_send(&server, "POST", "/v1/render", headers, text, size);
    assert_problem(reply, 422, "do not begin with DRACO");
}

TEST(unknown_content_encoding_is_refused)
{
    const char *const headers[] = {JSON_TYPE, "Content-Encoding: br", NULL};
    struct reply reply = client_send(&server, "POST", "/v1/render", headers, "x", 1);
    assert_problem(reply, 415, "'br'");
}

/* As gzip(1) would make it; free it. */
static unsigned char *gzipped(const void *bytes, size_t size, size_t *out_size)
{
    z_stream stream = {0};
    assert_int_equal(deflateInit2(&stream, 9, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
    size_t room = deflateBound(&stream, size);
    unsigned char *out = malloc(room), *in = malloc(size);
    memcpy(in, bytes, size);
    stream.next_in = in;
    stream.avail_in = (uInt)size;
    stream.next_out = out;
    stream.avail_out = (uInt)room;
    assert_int_equal(deflate(&stream, Z_FINISH), Z_STREAM_END);
    *out_size = stream.total_out;
    deflateEnd(&stream);
    free(in);
    return out;
}

static struct reply post_gzip(const struct daemon *daemon, const void *body, size_t size)
{
    return client_send(daemon, "POST", "/v1/render", (const char *const[]){JSON_TYPE, "Content-Encoding: gzip", NULL},
                       body, size);
}

TEST(gzip_body_renders_the_same_picture)
{
    size_t size;
    unsigned char *body = gzipped(GOOD_SCENE, strlen(GOOD_SCENE), &size);
    struct reply plain = client_render(&server, GOOD_SCENE), packed = post_gzip(&server, body, size);
    assert_int_equal(packed.status, 200);
    assert_true(reply_is_same(&packed, &plain));
    reply_free(&plain);
    reply_free(&packed);
    free(body);
}

TEST(gzip_body_of_several_members_is_taken_whole)
{
    size_t first, second, half = strlen(GOOD_SCENE) / 2;
    unsigned char *a = gzipped(GOOD_SCENE, half, &first);
    unsigned char *b = gzipped(&GOOD_SCENE[half], strlen(GOOD_SCENE) - half, &second);
    unsigned char *both = malloc(first + second);
    memcpy(both, a, first);
    memcpy(both + first, b, second);
    struct reply reply = post_gzip(&server, both, first + second);
    assert_int_equal(reply.status, 200);
    reply_free(&reply);
    free(a);
    free(b);
    free(both);
}

TEST(gzip_body_that_is_broken_gives_400)
{
    size_t size;
    unsigned char *body = gzipped(GOOD_SCENE, strlen(GOOD_SCENE), &size);
    for (size_t cut = 0; cut < size; cut += 7) {
        struct reply reply = post_gzip(&server, body, cut);
        assert_problem(reply, 400, "gzip");
    }
    struct reply reply = post_gzip(&server, GOOD_SCENE, strlen(GOOD_SCENE));
    assert_problem(reply, 400, "gzip");
    body[size - 6] ^= 1; /* the checksum */
    reply = post_gzip(&server, body, size);
    assert_problem(reply, 400, "gzip");
    free(body);
}

/* 80 MB of spaces in 80 kB. */
TEST(gzip_body_that_inflates_beyond_the_limit_gives_413)
{
    size_t size, inflated = 80u << 20;
    char *spaces = malloc(inflated);
    memset(spaces, ' ', inflated);
    unsigned char *body = gzipped(spaces, inflated, &size);
    free(spaces);
    assert_true(size < 1u << 20);
    struct reply reply = post_gzip(&server, body, size);
    assert_problem(reply, 413, "bodyMaxBytes");
    free(body);
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
}

TEST(unknown_path_gives_404)
{
    struct reply reply = client_get(&server, "/v2/render");
    assert_problem(reply, 404, "/v2/render");
    assert_int_equal(client_get_status(&server, "/v1/render/"), 404);
}

TEST(wrong_method_gives_405_with_allow)
{
    struct reply reply = client_get(&server, "/v1/render");
    assert_string_equal(reply_header(&reply, "Allow"), "POST, OPTIONS");
    assert_problem(reply, 405, "POST");
    reply = client_send(&server, "DELETE", "/healthz", NULL, NULL, 0);
    assert_string_equal(reply_header(&reply, "Allow"), "GET, HEAD, OPTIONS");
    assert_problem(reply, 405, "GET, HEAD");
}

TEST(health_endpoints_answer_get_and_head)
{
    static const char *const PATHS[] = {"/healthz", "/readyz", "/v1/limits"};
    for (size_t i = 0; i < 3; i++) {
        struct reply get = client_get(&server, PATHS[i]);
        struct reply head = client_send(&server, "HEAD", PATHS[i], NULL, NULL, 0);
        assert_int_equal(get.status, 200);
        assert_int_equal(head.status, 200);
        assert_int_equal(head.size, 0);
        assert_int_equal(atol(reply_header(&head, "Content-Length")), (long)get.size);
        reply_free(&get);
        reply_free(&head);
    }
}

static long count_images(const struct daemon *daemon, const char *which)
{
    struct reply reply = client_get(daemon, "/healthz");
    cJSON *root = cJSON_Parse(reply.body);
    const cJSON *images = cJSON_GetObjectItemCaseSensitive(root, "images");
    const long count = (long)cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(images, which));
    cJSON_Delete(root);
    reply_free(&reply);
    return count;
}

TEST(images_are_decoded_once_for_all_requests)
{
    size_t size;
    char *scene = file_read("tests/scenes/textures-lit.json", &size);
    struct daemon none = daemon_start((const char *const[]){"--keep-image-bytes=0", NULL});
    struct reply first = client_render(&server, scene);
    const long misses = count_images(&server, "misses");
    struct reply second = client_render(&server, scene), plain = client_render(&none, scene);
    assert_int_equal(first.status, 200);
    assert_true(reply_is_same(&first, &second) && reply_is_same(&first, &plain));
    assert_true(misses > 0);
    assert_int_equal(count_images(&server, "misses"), misses);
    assert_true(count_images(&server, "hits") >= misses);
    assert_true(count_images(&server, "bytes") > 0);
    assert_int_equal(count_images(&none, "count"), 0);
    assert_int_equal(count_images(&none, "misses"), 0);
    reply_free(&first);
    reply_free(&second);
    reply_free(&plain);
    daemon_stop(&none);
    free(scene);
}

TEST(limits_lists_all_and_no_secret)
{
    struct reply reply = client_get(&server, "/v1/limits");
    cJSON *root = cJSON_Parse(reply.body);
    cJSON *limits = cJSON_GetObjectItemCaseSensitive(root, "limits");
    assert_int_equal((int)cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(limits, "bodyMaxBytes")), 64 << 20);
    assert_int_equal((int)cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(limits, "windowSideMax")), 8192);
    assert_int_equal((int)cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(limits, "renderTimeoutMs")), 10000);
    assert_null(cJSON_GetObjectItemCaseSensitive(limits, "token"));
    cJSON_Delete(root);
    reply_free(&reply);
}

TEST(request_id_is_echoed_where_it_is_safe)
{
    struct reply reply =
        client_send(&server, "GET", "/healthz", (const char *const[]){"X-Request-Id: job_7.a-B", NULL}, NULL, 0);
    assert_string_equal(reply_header(&reply, "X-Request-Id"), "job_7.a-B");
    assert_string_not_equal(reply_header(&reply, "Zraster-Version"), "");
    reply_free(&reply);
    reply = client_send(&server, "GET", "/healthz", (const char *const[]){"X-Request-Id: a b\"", NULL}, NULL, 0);
    char first[200];
    snprintf(first, sizeof first, "%s", reply_header(&reply, "X-Request-Id"));
    assert_true(strlen(first) >= 8);
    assert_null(strchr(first, ' '));
    reply_free(&reply);
    reply = client_get(&server, "/nowhere");
    assert_string_not_equal(reply_header(&reply, "X-Request-Id"), first);
    assert_string_not_equal(reply_header(&reply, "X-Request-Id"), "");
    reply_free(&reply);
}

TEST(expect_100_continue_gets_it)
{
    static const char REQUEST[] =
        "POST /v1/render HTTP/1.1\r\nHost: a\r\n" JSON_TYPE "\r\nExpect: 100-continue\r\nContent-Length: 2\r\n\r\n";
    int fd = client_connect(&server);
    assert_true(client_write(fd, REQUEST, sizeof REQUEST - 1));
    char *text = client_read(fd, "\r\n\r\n", 5000);
    assert_int_equal(raw_status(text), 100);
    free(text);
    assert_true(client_write(fd, "{}", 2));
    text = client_read(fd, "\r\n\r\n", 5000);
    assert_int_equal(raw_status(text), 422);
    free(text);
    close(fd);
}

TEST(proxy_form_of_a_target_is_understood)
{
    static const char REQUEST[] = "GET http://a/healthz HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n";
    char *text = client_raw(&server, REQUEST, sizeof REQUEST - 1, 5000);
    assert_int_equal(raw_status(text), 200);
    free(text);
}

TEST(token_is_asked_for_but_for_health)
{
    assert_int_equal(client_get_status(&guarded, "/healthz"), 200);
    assert_int_equal(client_get_status(&guarded, "/readyz"), 200);
    struct reply reply = client_render(&guarded, GOOD_SCENE);
    assert_int_equal(strncmp(reply_header(&reply, "WWW-Authenticate"), "Bearer", 6), 0);
    assert_problem(reply, 401, "Bearer");
    assert_int_equal(client_get_status(&guarded, "/v1/limits"), 401);
    assert_int_equal(client_get_status(&guarded, "/nowhere"), 401);
}

TEST(wrong_tokens_are_refused_and_the_right_one_is_taken)
{
    static const char *const WRONG[] = {
        "Authorization: Bearer",
        "Authorization: Bearer s3cret-toke",
        "Authorization: Bearer " TOKEN "x",
        "Authorization: Bearer " TOKEN TOKEN,
        "Authorization: Basic " TOKEN,
        "Authorization: " TOKEN,
    };
    for (size_t i = 0; i < sizeof WRONG / sizeof WRONG[0]; i++) {
        const char *const headers[] = {JSON_TYPE, WRONG[i], NULL};
        struct reply reply = client_send(&guarded, "POST", "/v1/render", headers, GOOD_SCENE, strlen(GOOD_SCENE));
        assert_int_equal(reply.status, 401);
        reply_free(&reply);
    }
    const char *const headers[] = {JSON_TYPE, "authorization: bearer " TOKEN, NULL};
    struct reply reply = client_send(&guarded, "POST", "/v1/render", headers, GOOD_SCENE, strlen(GOOD_SCENE));
    assert_int_equal(reply.status, 200);
    reply_free(&reply);
    char *log = daemon_log(&guarded);
    assert_null(strstr(log, TOKEN));
    free(log);
}

TEST(space_behind_a_header_is_no_part_of_it)
{
    const char *const headers[] = {JSON_TYPE " ", "Authorization: Bearer " TOKEN " \t", "X-Request-Id: mine ",
                                   "Content-Encoding: identity\t", NULL};
    struct reply reply = client_send(&guarded, "POST", "/v1/render", headers, GOOD_SCENE, strlen(GOOD_SCENE));
    assert_int_equal(reply.status, 200);
    assert_string_equal(reply_header(&reply, "X-Request-Id"), "mine");
    reply_free(&reply);
}

TEST(log_line_is_json_and_tells_of_the_request)
{
    static const char TRACE[] = "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01";
    const char *const headers[] = {JSON_TYPE, "X-Request-Id: log-test",
                                   "traceparent: 00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01", NULL};
    struct reply reply = client_send(&server, "POST", "/v1/render?channel=x", headers, "{}", 2);
    assert_true(reply.status >= 400);
    char *line = daemon_wait_for_log(&server, "\"log-test\"");
    cJSON *root = cJSON_ParseWithOpts(line, NULL, 1);
    assert_non_null(root);
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "method")), "POST");
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "path")), "/v1/render");
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "route")), "/v1/render");
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "query")), "channel=x");
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "remote")), "127.0.0.1");
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "traceparent")), TRACE);
    assert_true((long)cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(root, "status")) == reply.status);
    assert_int_equal((int)cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(root, "bytesIn")), 2);
    assert_true(cJSON_IsString(cJSON_GetObjectItemCaseSensitive(root, "detail")));
    cJSON_Delete(root);
    free(line);
    reply_free(&reply);
}

/* Renders a scene and returns the line of the log, parsed. */
static cJSON *log_of(const char *accept, const char *scene, const char *id)
{
    char named[96];
    snprintf(named, sizeof named, "X-Request-Id: %s", id);
    const char *const headers[] = {JSON_TYPE, named, accept, NULL};
    struct reply reply = client_send(&server, "POST", "/v1/render", headers, scene, strlen(scene));
    assert_int_equal(reply.status, 200);
    reply_free(&reply);
    char *line = daemon_wait_for_log(&server, id);
    cJSON *root = cJSON_ParseWithOpts(line, NULL, 1);
    assert_non_null(root);
    free(line);
    return root;
}

static void assert_look_and_warnings(cJSON *root, double warnings)
{
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "look")), "technical@1");
    assert_true(cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(root, "warnings")) == warnings);
    cJSON_Delete(root);
}

TEST(log_line_names_look_and_counts_warnings)
{
    static const char ODD[] = "{\"look\":\"technical\",\"meshes\":[{\"positions\":[[0,0,0],[1,0,0],[0,1,0]],"
                              "\"faces\":[[0,1,2],[0,1,0]],\"lines\":[[0,0]]}],"
                              "\"views\":[\"front\",\"isometric\"]}";
    assert_look_and_warnings(log_of("Accept: application/zip", ODD, "log-of-zip"), 2);
    assert_look_and_warnings(log_of("Accept: multipart/mixed", ODD, "log-of-stream"), 4); /* two in each part */
}

TEST(log_line_of_hostile_path_is_json)
{
    static const char REQUEST[] =
        "GET /\"\\\xff\xc0\xafmark?%01=\xf0\x9f HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n";
    free(client_raw(&server, REQUEST, sizeof REQUEST - 1, 5000));
    char *line = daemon_wait_for_log(&server, "mark");
    cJSON *root = cJSON_ParseWithOpts(line, NULL, 1);
    assert_non_null(root);
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "path")),
                        "/\"\\\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBDmark");
    cJSON_Delete(root);
    free(line);
}

RUN_TESTS(start, stop)
