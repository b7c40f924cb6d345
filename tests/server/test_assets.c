/* Assets: uploaded, fetched, and asked for by scenes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "server/support/assets.h"
#include "support/input/base64.h"
#include "support/input/npy.h"
#include "support/tests.h"

static struct folder folder;
static struct daemon server;

static int start(void **state)
{
    (void)state;
    folder = folder_make();
    server = assets_start(&folder, (const char *const[]){"--body-max-bytes=1000000", NULL});
    return 0;
}

static int stop(void **state)
{
    (void)state;
    daemon_stop(&server);
    folder_remove(&folder);
    return 0;
}

static struct reply send(const char *method, const char *target, const char *const *headers, const void *bytes,
                         size_t size)
{
    return client_send(&server, method, target, headers, bytes, size);
}

/* Status of an upload, whose answer must have this name and size. */
static long upload_status(struct reply reply, const char *name, size_t size)
{
    char wanted[256];
    snprintf(wanted, sizeof wanted, "{\"sha256\":\"%s\",\"size\":%zu}\n", name, size);
    assert_string_equal(reply.body, wanted);
    assert_string_equal(reply_header(&reply, "Content-Type"), "application/json");
    snprintf(wanted, sizeof wanted, "/v1/assets/%s", name);
    assert_string_equal(reply_header(&reply, "Location"), wanted);
    long status = reply.status;
    reply_free(&reply);
    return status;
}

static void assert_kept_headers(const struct reply *reply, const char *name)
{
    char tag[80];
    snprintf(tag, sizeof tag, "\"%s\"", name);
    assert_string_equal(reply_header(reply, "ETag"), tag);
    assert_string_equal(reply_header(reply, "Cache-Control"), "public, max-age=31536000, immutable");
    assert_string_equal(reply_header(reply, "X-Content-Type-Options"), "nosniff");
    assert_string_equal(reply_header(reply, "Cross-Origin-Resource-Policy"), "cross-origin");
}

TEST(uploaded_bytes_come_back_under_their_hash)
{
    assert_int_equal(asset_status(&server, ABC_NAME), 404);
    assert_int_equal(upload_status(send("POST", "/v1/assets", NULL, "abc", 3), ABC_NAME, 3), 201);
    assert_int_equal(upload_status(send("POST", "/v1/assets", NULL, "abc", 3), ABC_NAME, 3), 200);
    assert_int_equal(upload_status(asset_put(&server, ABC_NAME, "abc", 3), ABC_NAME, 3), 200);
    struct reply reply = asset_get(&server, ABC_NAME);
    assert_int_equal(reply.status, 200);
    assert_int_equal(reply.size, 3);
    assert_memory_equal(reply.body, "abc", 3);
    assert_string_equal(reply_header(&reply, "Content-Type"), "application/octet-stream");
    assert_kept_headers(&reply, ABC_NAME);
    reply_free(&reply);
}

TEST(asset_of_no_bytes_is_one)
{
    assert_int_equal(upload_status(asset_put(&server, EMPTY_NAME, "", 0), EMPTY_NAME, 0), 201);
    struct reply reply = asset_get(&server, EMPTY_NAME);
    assert_int_equal(reply.status, 200);
    assert_int_equal(reply.size, 0);
    assert_string_equal(reply_header(&reply, "Content-Length"), "0");
    reply_free(&reply);
}

TEST(head_tells_what_get_would_send)
{
    struct asset_name name = asset_post(&server, "head", 4, 201);
    char target[ASSET_TARGET_SIZE];
    snprintf(target, sizeof target, "/v1/assets/%s", name.text);
    struct reply reply = send("HEAD", target, NULL, NULL, 0);
    assert_int_equal(reply.status, 200);
    assert_int_equal(reply.size, 0);
    assert_string_equal(reply_header(&reply, "Content-Length"), "4");
    assert_string_equal(reply_header(&reply, "Content-Type"), "application/octet-stream");
    assert_kept_headers(&reply, name.text);
    reply_free(&reply);
    reply = send("HEAD", "/v1/assets/" EMPTY_NAME "0", NULL, NULL, 0);
    assert_int_equal(reply.status, 404);
    reply_free(&reply);
}

static void assert_conditional(const char *name, const char *tags, long status)
{
    char target[ASSET_TARGET_SIZE], header[256];
    snprintf(target, sizeof target, "/v1/assets/%s", name);
    snprintf(header, sizeof header, "If-None-Match: %s", tags);
    struct reply reply = send("GET", target, (const char *const[]){header, NULL}, NULL, 0);
    if (reply.status != status) fail_msg("%s: %ld", tags, reply.status);
    if (status == 304) {
        assert_int_equal(reply.size, 0);
        assert_string_equal(reply_header(&reply, "Content-Length"), "11"); /* RFC 9110, 8.6: as with 200 */
        assert_kept_headers(&reply, name);
    }
    reply_free(&reply);
}

TEST(entity_tag_that_matches_gives_304)
{
    char tags[200];
    struct asset_name name = asset_post(&server, "conditional", 11, 201);
    sprintf(tags, "\"%s\"", name.text);
    assert_conditional(name.text, tags, 304);
    sprintf(tags, "W/\"%s\"", name.text);
    assert_conditional(name.text, tags, 304);
    sprintf(tags, "\"a\", \"%s\" , \"b\"", name.text);
    assert_conditional(name.text, tags, 304);
    assert_conditional(name.text, "*", 304);
    assert_conditional(name.text, name.text, 200);
    assert_conditional(name.text, "\"" ABC_NAME "\"", 200);
    char unknown[ASSET_NAME_SIZE] = ABC_NAME;
    unknown[0] = '0';
    sprintf(tags, "\"%s\"", unknown);
    assert_conditional(unknown, tags, 404);
    assert_conditional(unknown, "*", 404);
}

TEST(wrong_hash_is_refused_with_both)
{
    int before = folder_count(&folder);
    char wrong[ASSET_NAME_SIZE] = ABC_NAME;
    wrong[63] = 'e';
    assert_problem(asset_put(&server, wrong, "abc", 3), 422, ABC_NAME);
    assert_problem(asset_put(&server, wrong, "abc", 3), 422, wrong);
    assert_int_equal(folder_count(&folder), before);
}

TEST(names_that_are_no_hash_give_404)
{
    const char *const names[] = {
        "../" ABC_NAME,
        "..%2f" ABC_NAME,
        "..",
        "",
        "/" ABC_NAME,
        ABC_NAME "/",
        ABC_NAME "/..",
        ABC_NAME "0",
        "a7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad",
        "BA7816BF8F01CFEA414140DE5DAE2223B00361A396177A9CB410FF61F20015AD",
        "ga7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad",
        "sha256:" ABC_NAME,
        "%62"
        "a7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad",
        ".zraster-upload-0123456789abcdef",
    };
    int before = folder_count(&folder);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        /* As they are: curl would tidy paths up. */
        char request[512];
        int length = snprintf(
            request, sizeof request,
            "PUT /v1/assets/%s HTTP/1.1\r\nHost: a\r\nContent-Length: 3\r\nConnection: close\r\n\r\nabc", names[i]);
        char *answer = client_raw(&server, request, (size_t)length, 5000);
        if (raw_status(answer) != 404 || !strstr(answer, "64 lower-case")) fail_msg("%s: %s", names[i], answer);
        free(answer);
    }
    assert_int_equal(folder_count(&folder), before);
}

TEST(other_methods_give_405_with_allow)
{
    struct reply reply = send("DELETE", "/v1/assets/" ABC_NAME, NULL, NULL, 0);
    assert_string_equal(reply_header(&reply, "Allow"), "GET, HEAD, PUT, OPTIONS");
    assert_problem(reply, 405, "GET, HEAD, PUT");
    reply = send("GET", "/v1/assets", NULL, NULL, 0);
    assert_string_equal(reply_header(&reply, "Allow"), "POST, OPTIONS");
    assert_problem(reply, 405, "POST");
}

TEST(gzip_upload_is_kept_inflated)
{
    Bytef packed[256];
    char bytes[4000], target[ASSET_TARGET_SIZE];
    memset(bytes, 'g', sizeof bytes);
    z_stream stream = {
        .next_in = (Bytef *)bytes, .avail_in = sizeof bytes, .next_out = packed, .avail_out = sizeof packed};
    assert_int_equal(deflateInit2(&stream, 9, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
    assert_int_equal(deflate(&stream, Z_FINISH), Z_STREAM_END);
    deflateEnd(&stream);
    struct asset_name name = asset_post(&server, bytes, sizeof bytes, 201);
    const char *const headers[] = {"Content-Encoding: gzip", NULL};
    snprintf(target, sizeof target, "/v1/assets/%s", name.text);
    assert_int_equal(upload_status(send("PUT", target, headers, packed, stream.total_out), name.text, sizeof bytes),
                     200);
    assert_problem(send("PUT", target, NULL, packed, stream.total_out), 422, name.text);
    assert_problem(send("PUT", target, headers, packed, stream.total_out - 1), 400, "gzip");
    assert_problem(send("PUT", target, (const char *const[]){"Content-Encoding: br", NULL}, packed, 3), 415, "br");
}

TEST(form_is_not_taken_for_an_asset)
{
    const char *const headers[] = {"Content-Type: multipart/form-data; boundary=x", NULL};
    assert_problem(send("POST", "/v1/assets", headers, "--x", 3), 415, "the body itself");
}

TEST(upload_beyond_the_limits_gives_413)
{
    int before = folder_count(&folder);
    char *bytes = calloc(1, 1000001);
    assert_problem(send("POST", "/v1/assets", NULL, bytes, 1000001), 413, "bodyMaxBytes");
    assert_problem(client_send_chunked(&server, "/v1/assets", 1000001), 413, "bodyMaxBytes");
    assert_int_equal(folder_count(&folder), before);
    struct folder small = folder_make();
    struct daemon tiny = assets_start(&small, (const char *const[]){"--assets-max-bytes=8192", NULL});
    assert_problem(client_send(&tiny, "POST", "/v1/assets", NULL, bytes, 8193), 413, "assetsMaxBytes");
    assert_int_equal(folder_count(&small), 0);
    asset_post(&tiny, bytes, 8192, 201);
    daemon_stop(&tiny);
    folder_remove(&small);
    free(bytes);
}

#define POLYGON "\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]"

TEST(without_a_directory_it_is_said_how_to_have_one)
{
    struct daemon plain = daemon_start(NULL);
    assert_problem(asset_get(&plain, ABC_NAME), 404, "--assets-dir");
    assert_problem(asset_put(&plain, ABC_NAME, "abc", 3), 404, "--assets-dir");
    assert_problem(client_send(&plain, "POST", "/v1/assets", NULL, "abc", 3), 404, "--assets-dir");
    struct reply reply =
        client_render(&plain, "{\"base\":{\"windowDepth\":{\"asset\":\"sha256:" ABC_NAME "\"}}," POLYGON "}");
    assert_non_null(strstr(reply.body, "\"pointer\":\"/base/windowDepth/asset\""));
    assert_non_null(strstr(reply.body, "no assets are kept here"));
    assert_problem(reply, 422, ""); /* another fault comes first */
    daemon_stop(&plain);
}

TEST(token_is_asked_for)
{
    struct folder own = folder_make();
    struct daemon closed = assets_start(&own, (const char *const[]){"--token=secret", NULL});
    assert_problem(asset_get(&closed, ABC_NAME), 401, "Bearer");
    assert_problem(asset_put(&closed, ABC_NAME, "abc", 3), 401, "Bearer");
    assert_int_equal(folder_count(&own), 0);
    struct reply reply = client_send(&closed, "PUT", "/v1/assets/" ABC_NAME,
                                     (const char *const[]){"Authorization: Bearer secret", NULL}, "abc", 3);
    assert_int_equal(upload_status(reply, ABC_NAME, 3), 201);
    daemon_stop(&closed);
    folder_remove(&own);
}

/* ---- in scenes ---- */

#define VIEW                                                                                                           \
    "\"window\":{\"width\":64,\"height\":48},\"view\":{\"eye\":[1,2,3],\"znear\":1,\"zfar\":8},\"shading\":\"unlit\""
#define FIRST  "{\"vertices\":[[-1,-1,0],[1,-1,0.5],[0,1,0]],\"color\":\"#cc3333\",\"doubleSided\":true}"
#define SECOND "{\"vertices\":[[-1,1,0],[1,1,0.2],[0,-1,0.3]],\"color\":\"#3333cc\",\"doubleSided\":true}"

/* With a base of these two values. */
static struct reply render(const char *target, const char *color, const char *depth)
{
    static const char FORM[] = "{" VIEW ",\"base\":{\"color\":%s,\"windowDepth\":%s},\"polygons\":[" SECOND "]}";
    char *scene = NULL;
    int length = asprintf(&scene, FORM, color, depth);
    assert_true(length > 0);
    struct reply reply = send("POST", target, (const char *const[]){JSON_TYPE, NULL}, scene, (size_t)length);
    free(scene);
    return reply;
}

/* Of 3 vertices, and of so many that a small request becomes a large one. */
TEST(list_may_be_an_asset)
{
    static float values[3 * 9000];
    for (size_t rows = 3; rows <= 9000; rows *= 3000) {
        char shape[32], *text = NULL, *lists = NULL;
        size_t size, used;
        FILE *out = open_memstream(&lists, &used);
        assert_non_null(out);
        fprintf(out, "{" VIEW ",\"meshes\":[{\"faces\":[[0,1,2]],\"positions\":[");
        for (size_t i = 0; i < 3 * rows; i++) {
            values[i] = (float)(i * i % 7) * 0.25f - 0.75f;
            fprintf(out, "%s%.9g%s", i % 3 == 0 ? "[" : "", (double)values[i],
                    i % 3 < 2          ? ","
                    : i + 1 < 3 * rows ? "],"
                                       : "]");
        }
        fprintf(out, "]}]}");
        fclose(out);
        snprintf(shape, sizeof shape, "(%zu, 3)", rows);
        char *file = npy_file("<f4", "False", shape, values, 12 * rows, &size);
        assert_non_null(file);
        const struct asset_name name = asset_post(&server, file, size, 201);
        const int length = asprintf(
            &text, "{" VIEW ",\"meshes\":[{\"faces\":[[0,1,2]],\"positions\":{\"asset\":\"sha256:%s\"}}]}", name.text);
        assert_true(length > 0);
        const char *const headers[] = {JSON_TYPE, NULL};
        struct reply wanted = send("POST", "/v1/render", headers, lists, used);
        struct reply reply = send("POST", "/v1/render", headers, text, (size_t)length);
        if (reply.status != 200) fail_msg("%ld: %s", reply.status, reply.body);
        assert_int_equal(wanted.status, 200);
        assert_true(reply_is_same(&reply, &wanted));
        reply_free(&wanted);
        reply_free(&reply);
        free(file);
        free(text);
        free(lists);
    }
}

static struct reply render_first(const char *target)
{
    struct reply reply =
        client_send(&server, "POST", target, (const char *const[]){JSON_TYPE, NULL},
                    "{" VIEW ",\"polygons\":[" FIRST "]}", sizeof "{" VIEW ",\"polygons\":[" FIRST "]}" - 1);
    assert_int_equal(reply.status, 200);
    return reply;
}

/* The same picture as a data: URI and as an asset. */
struct picture {
    char *uri, stored[128];
};

/* `status` of its upload. */
static struct picture keep_picture(struct reply reply, long status)
{
    struct picture picture;
    struct asset_name name = asset_post(&server, reply.body, reply.size, status);
    char *uri = base64_of("\"data:;base64,", reply.body, reply.size);
    assert_true(asprintf(&picture.uri, "%s\"", uri) > 0);
    snprintf(picture.stored, sizeof picture.stored, "{\"asset\":\"sha256:%s\"}", name.text);
    free(uri);
    reply_free(&reply);
    return picture;
}

TEST(scene_with_assets_is_drawn_as_with_data_uris)
{
    struct picture color = keep_picture(render_first("/v1/render"), 201);
    struct picture depth = keep_picture(render_first("/v1/render?channel=windowDepth"), 201);
    const char *const targets[] = {"/v1/render", "/v1/render?channel=windowDepth"};
    for (size_t i = 0; i < 2; i++) {
        struct reply want = render(targets[i], color.uri, depth.uri);
        struct reply got = render(targets[i], color.stored, depth.stored);
        if (want.status != 200 || got.status != 200) fail_msg("%s\n%s", want.body, got.body);
        assert_string_equal(reply_header(&got, "Zraster-Warnings"), "");
        assert_true(reply_is_same(&got, &want));
        struct reply first = render_first(targets[i]);
        assert_false(reply_is_same(&first, &got));
        reply_free(&first);
        reply_free(&want);
        reply_free(&got);
    }
    free(color.uri);
    free(depth.uri);
}

TEST(unknown_hash_is_refused_where_it_stands)
{
    char unknown[128];
    struct picture depth = keep_picture(render_first("/v1/render?channel=windowDepth"), 200);
    snprintf(unknown, sizeof unknown, "{\"asset\":\"sha256:%064d\"}", 0);
    struct reply reply = render("/v1/render", unknown, depth.stored);
    assert_non_null(strstr(reply.body, "\"pointer\":\"/base/color/asset\""));
    assert_null(strstr(reply.body, "/base/windowDepth"));
    assert_problem(reply, 422,
                   "the hash 0000000000000000000000000000000000000000000000000000000000000000; upload it with PUT");
    reply = render("/v1/render", "{\"asset\":\"sha256:00\"}", depth.stored);
    assert_non_null(strstr(reply.body, "\"pointer\":\"/base/color/asset\""));
    assert_problem(reply, 422, "64 lower-case hexadecimal digits");
    free(depth.uri);
}

/* It goes from the disk to the client. A scene that asks for it has it in its memory. */
TEST(asset_beyond_the_memory_of_a_request_is_sent_and_not_drawn)
{
    enum { SIZE = 3 << 20 };
    struct folder own = folder_make();
    char *bytes = calloc(1, SIZE), scene[256];
    struct daemon small = assets_start(&own, (const char *const[]){"--request-memory-bytes=2000000", NULL});
    struct asset_name name = asset_post(&small, bytes, SIZE, 201);
    struct reply reply = asset_get(&small, name.text);
    assert_int_equal(reply.status, 200);
    assert_true(reply.size == SIZE && memcmp(reply.body, bytes, SIZE) == 0);
    reply_free(&reply);
    snprintf(scene, sizeof scene,
             "{\"view\":{\"znear\":1,\"zfar\":9},\"base\":{\"windowDepth\":{\"asset\":\"sha256:%s\"}}," POLYGON "}",
             name.text);
    assert_problem(client_render(&small, scene), 422, "requestMemoryBytes");
    assert_int_equal(folder_count(&own), 1);
    daemon_stop(&small);
    folder_remove(&own);
    free(bytes);
}

RUN_TESTS(start, stop)
