/* Several parts in one request: a scene, and the pictures it is drawn into. */
#include <stdio.h>
#include <string.h>
#include <zlib.h>

#include "server/support/client.h"
#include "support/input/npy.h"
#include "support/tests.h"

#define VIEW                                                                                                           \
    "\"window\":{\"width\":120,\"height\":90},\"view\":{\"eye\":[1,2,3],\"znear\":1,\"zfar\":8},\"shading\":\"unlit\""
#define FIRST  "{\"vertices\":[[-1,-1,0],[1,-1,0.5],[0,1,0]],\"color\":\"#cc3333\",\"doubleSided\":true}"
#define SECOND "{\"vertices\":[[-1,1,0],[1,1,0.2],[0,-1,0.3]],\"color\":\"#3333cc\",\"doubleSided\":true}"
#define INTO   ",\"base\":{\"color\":{\"asset\":\"picture\"},\"windowDepth\":{\"asset\":\"z-buffer\"}}"

#define BOUNDARY "----zraster-test"
#define TYPE     "Content-Type: multipart/form-data; boundary=" BOUNDARY

static struct daemon server;

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

struct body {
    char bytes[1 << 17];
    size_t size;
};

static void add_part(struct body *body, const char *headers, const void *bytes, size_t size)
{
    body->size += (size_t)snprintf(body->bytes + body->size, sizeof body->bytes - body->size,
                                   "--" BOUNDARY "\r\nContent-Disposition: form-data; %s\r\n\r\n", headers);
    assert_true(body->size + size + 2 < sizeof body->bytes);
    memcpy(body->bytes + body->size, bytes, size);
    memcpy(body->bytes + body->size + size, "\r\n", 2);
    body->size += size + 2;
}

static void end_parts(struct body *body)
{
    body->size += (size_t)snprintf(body->bytes + body->size, sizeof body->bytes - body->size, "--" BOUNDARY "--\r\n");
}

static struct reply send_body(const char *target, const char *const *headers, const void *bytes, size_t size)
{
    return client_send(&server, "POST", target, headers, bytes, size);
}

static struct reply send_parts(const char *target, const struct body *body)
{
    return send_body(target, (const char *const[]){TYPE, NULL}, body->bytes, body->size);
}

static struct reply send_scene(const char *target, const char *scene)
{
    return send_body(target, (const char *const[]){JSON_TYPE, NULL}, scene, strlen(scene));
}

/* The second polygon, and what the first one's picture was. */
static void make_body(struct body *body)
{
    static const char scene[] = "{" VIEW INTO ",\"polygons\":[" SECOND "]}";
    struct reply color = send_scene("/v1/render", "{" VIEW ",\"polygons\":[" FIRST "]}");
    struct reply depth = send_scene("/v1/render?channel=windowDepth", "{" VIEW ",\"polygons\":[" FIRST "]}");
    assert_int_equal(color.status, 200);
    assert_int_equal(depth.status, 200);
    body->size = 0;
    add_part(body, "name=\"picture\"; filename=\"a.png\"\r\nContent-Type: image/png", color.body, color.size);
    add_part(body, "name=scene\r\nContent-Type: application/json", scene, sizeof scene - 1);
    add_part(body, "name=\"z-buffer\"", depth.body, depth.size);
    end_parts(body);
    reply_free(&color);
    reply_free(&depth);
}

static void assert_is_whole(struct reply *reply, const char *target)
{
    struct reply whole = send_scene(target, "{" VIEW ",\"polygons\":[" FIRST "," SECOND "]}");
    assert_int_equal(whole.status, 200);
    if (reply->status != 200) fail_msg("%ld: %s", reply->status, reply->body);
    assert_true(reply_is_same(reply, &whole));
    reply_free(&whole);
    reply_free(reply);
}

TEST(scene_drawn_into_its_parts_is_the_whole)
{
    static struct body body;
    make_body(&body);
    struct reply reply = send_parts("/v1/render", &body);
    assert_string_equal(reply_header(&reply, "Zraster-Warnings"), "");
    assert_is_whole(&reply, "/v1/render");
    reply = send_parts("/v1/render?channel=windowDepth", &body);
    assert_string_equal(reply_header(&reply, "Zraster-Warnings"), "");
    assert_is_whole(&reply, "/v1/render?channel=windowDepth");
}

TEST(parts_may_be_compressed_together)
{
    static struct body body, packed;
    make_body(&body);
    z_stream stream = {.next_in = (Bytef *)body.bytes,
                       .avail_in = (uInt)body.size,
                       .next_out = (Bytef *)packed.bytes,
                       .avail_out = sizeof packed.bytes};
    assert_int_equal(deflateInit2(&stream, 9, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
    assert_int_equal(deflate(&stream, Z_FINISH), Z_STREAM_END);
    packed.size = stream.total_out;
    deflateEnd(&stream);
    struct reply reply =
        send_body("/v1/render", (const char *const[]){TYPE, "Content-Encoding: gzip", NULL}, packed.bytes, packed.size);
    assert_is_whole(&reply, "/v1/render");
}

/* The quad as NPY parts, and as lists. */
TEST(lists_may_come_as_parts)
{
    static const double positions[12] = {-1, -1, 0, 1, -1, 0.5, 1, 1, 0.25, -1, 1, 0};
    static const long long faces[4] = {0, 1, 2, 3};
    static struct body body;
    static const char scene[] = "{" VIEW ",\"meshes\":[{\"positions\":{\"asset\":\"p\"},\"faces\":{\"asset\":\"f\"}}]}";
    size_t p_size, f_size;
    char *p = npy_file("<f8", "False", "(4, 3)", positions, sizeof positions, &p_size);
    char *f = npy_file("<i8", "False", "(1, 4)", faces, sizeof faces, &f_size);
    assert_true(p && f);
    body.size = 0;
    add_part(&body, "name=scene", scene, sizeof scene - 1);
    add_part(&body, "name=p; filename=\"p.npy\"", p, p_size);
    add_part(&body, "name=f", f, f_size);
    end_parts(&body);
    struct reply parts = send_parts("/v1/render", &body);
    struct reply lists =
        send_scene("/v1/render", "{" VIEW ",\"meshes\":[{\"positions\":[[-1,-1,0],[1,-1,0.5],[1,1,0.25],"
                                 "[-1,1,0]],\"faces\":[[0,1,2,3]]}]}");
    if (parts.status != 200) fail_msg("%ld: %s", parts.status, parts.body);
    assert_int_equal(lists.status, 200);
    assert_string_equal(reply_header(&parts, "Zraster-Warnings"), "");
    assert_true(reply_is_same(&parts, &lists));
    reply_free(&parts);
    reply_free(&lists);
    free(p);
    free(f);
}

TEST(the_only_part_is_the_body_whatever_its_name)
{
    static const char model[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    static const char *const heads[] = {"name=file; filename=\"part.obj\"\r\nContent-Type: application/octet-stream",
                                        "name=part"};
    static struct body body;
    struct reply alone = send_body("/v1/render?width=16&height=12",
                                   (const char *const[]){"Content-Type: model/obj", NULL}, model, sizeof model - 1);
    for (size_t i = 0; i < 2; i++) {
        body.size = 0;
        add_part(&body, heads[i], model, sizeof model - 1);
        end_parts(&body);
        struct reply reply = send_parts("/v1/render?width=16&height=12", &body);
        if (reply.status != 200) fail_msg("%ld: %s", reply.status, reply.body);
        assert_true(reply_is_same(&reply, &alone));
        reply_free(&reply);
    }
    reply_free(&alone);
}

static void assert_refused(struct reply reply, long status, const char *text)
{
    if (reply.status != status || !strstr(reply.body, text)) fail_msg("%ld: %s", reply.status, reply.body);
    assert_string_equal(reply_header(&reply, "Content-Type"), "application/problem+json");
    reply_free(&reply);
}

TEST(broken_bodies_give_400)
{
    static struct body body;
    assert_refused(send_body("/v1/render", (const char *const[]){"Content-Type: multipart/form-data", NULL}, "x", 1),
                   400, "without a boundary");
    assert_refused(send_body("/v1/render", (const char *const[]){TYPE, NULL}, GOOD_SCENE, strlen(GOOD_SCENE)), 400,
                   "does not contain the boundary");
    body.size = 0;
    add_part(&body, "name=other", GOOD_SCENE, strlen(GOOD_SCENE));
    add_part(&body, "name=another", "x", 1);
    end_parts(&body);
    assert_refused(send_parts("/v1/render", &body), 400, "none of the 2 parts has the name 'scene'");
    body.size = 0;
    add_part(&body, "name=scene\r\nContent-Type: image/png", GOOD_SCENE, strlen(GOOD_SCENE));
    end_parts(&body);
    assert_refused(send_parts("/v1/render", &body), 400, "'image/png', which is none of: application/json, model/obj");
    make_body(&body);
    body.size -= strlen("--" BOUNDARY "--\r\n");
    assert_refused(send_parts("/v1/render", &body), 400, "closing boundary");
}

TEST(faults_of_the_scene_have_their_pointers)
{
    static const char scene[] = "{" VIEW INTO ",\"polygons\":[" SECOND "]}";
    static struct body body;
    body.size = 0;
    add_part(&body, "name=scene", scene, sizeof scene - 1);
    add_part(&body, "name=picture", "GIF89a", 6);
    end_parts(&body);
    assert_refused(send_parts("/v1/render", &body), 422, "\"pointer\":\"/base/windowDepth/asset\"");
    assert_refused(send_scene("/v1/render", scene), 422, "\"pointer\":\"/base/color/asset\"");
    body.size = 0;
    add_part(&body, "name=scene", "{", 1);
    end_parts(&body);
    assert_refused(send_parts("/v1/render", &body), 400, "line 1");
    assert_refused(send_parts("/v1/render?preset=top", &body), 400, "parameter preset");
}

TEST(the_scene_may_be_a_bare_mesh)
{
    static const char mesh[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    static const char *const types[] = {"model/obj; charset=utf-8", "application/octet-stream"};
    static struct body body;
    for (size_t i = 0; i < 2; i++) {
        char headers[100];
        body.size = 0;
        snprintf(headers, sizeof headers, "name=scene\r\nContent-Type: %s", types[i]);
        add_part(&body, headers, mesh, sizeof mesh - 1);
        end_parts(&body);
        struct reply reply = send_parts("/v1/render?preset=top", &body);
        assert_int_equal(reply.status, 200);
        assert_string_equal(reply_header(&reply, "Content-Type"), "image/png");
        reply_free(&reply);
    }
}

TEST(parts_that_nothing_asks_for_are_warned_of)
{
    static struct body body;
    body.size = 0;
    add_part(&body, "name=scene", GOOD_SCENE, strlen(GOOD_SCENE));
    add_part(&body, "name=\"left over\"", "", 0);
    add_part(&body, "name=look", "clay", 4);
    end_parts(&body);
    struct reply reply = send_parts("/v1/render", &body);
    assert_int_equal(reply.status, 200);
    assert_string_equal(reply_header(&reply, "Zraster-Warnings"),
                        "the asset 'left over' is not used by the scene; the asset 'look' is not used by the scene; "
                        "parameters go into the query of the address");
    reply_free(&reply);
}

TEST(warnings_without_room_are_counted_and_none_is_cut)
{
    enum { PARTS = 31, LENGTH = 100 };
    static struct body body;
    body.size = 0;
    add_part(&body, "name=scene", GOOD_SCENE, strlen(GOOD_SCENE));
    for (int i = 0; i < PARTS; i++) {
        char headers[160];
        snprintf(headers, sizeof headers, "name=\"%0*d\"", LENGTH, i);
        add_part(&body, headers, "", 0);
    }
    end_parts(&body);
    struct reply reply = send_parts("/v1/render", &body);
    assert_int_equal(reply.status, 200);
    const char *warnings = reply_header(&reply, "Zraster-Warnings"), *at = warnings;
    int whole = 0, more = 0;
    while (strncmp(at, "the asset '", 11) == 0) {
        const char *end = strstr(at, " is not used by the scene; ");
        assert_non_null(end);
        at = end + strlen(" is not used by the scene; ");
        whole++;
    }
    assert_int_equal(sscanf(at, "and %d more", &more), 1);
    assert_true(whole > 10 && whole + more == PARTS && strlen(warnings) < 2048);
    reply_free(&reply);
}

RUN_TESTS(start, stop)
