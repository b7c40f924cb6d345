/* Whatever is sent, the answer says what is wrong, and the next request is served. */
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>

#include "server/support/client.h"
#include "support/files.h"
#include "support/tests.h"

enum { PATH_SIZE = 1024, LARGE_BODY = 100 * 1000 * 1000 };

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

static void assert_still_serves(void)
{
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
}

/* POSTs and wants a status, and each of `texts` (to NULL) in the answer's body. */
static void assert_refused(const char *type, const char *body, size_t size, int status, const char *const *texts)
{
    struct reply reply = client_send(&server, "POST", "/v1/render", (const char *const[]){type, NULL}, body, size);
    if (reply.status != status) fail_msg("wanted %d, got %ld for %.200s\n%s", status, reply.status, body, reply.body);
    assert_string_equal(reply_header(&reply, "Content-Type"), "application/problem+json");
    for (; texts && *texts; texts++)
        if (!strstr(reply.body, *texts)) fail_msg("'%s' is not in %s", *texts, reply.body);
    reply_free(&reply);
    assert_still_serves();
}

static void assert_scene_refused(const char *scene, int status, const char *const *texts)
{
    assert_refused(JSON_TYPE, scene, strlen(scene), status, texts);
}

#define TEXTS(...)                                                                                                     \
    (const char *const[])                                                                                              \
    {                                                                                                                  \
        __VA_ARGS__, NULL                                                                                              \
    }

/* ---- the JSON test suite ---- */

static void check_suite_file(const char *folder, const char *name)
{
    char path[PATH_SIZE];
    size_t size = 0;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    char *bytes = file_read(path, &size);
    assert_non_null(bytes);
    struct reply reply =
        client_send(&server, "POST", "/v1/render", (const char *const[]){JSON_TYPE, NULL}, bytes, size);
    const bool is_deep = reply.status == 422 && strstr(reply.body, "nested deeper than"); /* judged as soon as it is */
    bool is_right =
        name[0] == 'n' ? reply.status == 400 || is_deep : reply.status > 0 && reply.status != 400 && reply.status < 500;
    if (!is_right) fail_msg("%s: got %ld %s", name, reply.status, reply.body);
    reply_free(&reply);
    free(bytes);
    assert_int_equal(client_get_status(&server, "/healthz"), 200);
}

TEST(json_test_suite_is_told_apart)
{
    const char *data = getenv("ZRASTER_DATA");
    char folder[PATH_SIZE / 2];
    snprintf(folder, sizeof folder, "%s/json-test-suite/test_parsing", data && *data ? data : "../shared/data");
    DIR *listing = opendir(folder);
    if (!listing) {
        fprintf(stderr, "LEFT OUT: json_test_suite_is_told_apart: %s: %s (ZRASTER_DATA names the folder)\n", folder,
                strerror(errno));
        skip();
    }
    int refused = 0, taken = 0;
    for (struct dirent *entry; (entry = readdir(listing));) {
        if (strncmp(entry->d_name, "n_", 2) == 0)
            refused++;
        else if (strncmp(entry->d_name, "y_", 2) == 0)
            taken++;
        else
            continue;
        check_suite_file(folder, entry->d_name);
    }
    closedir(listing);
    assert_true(refused > 100 && taken > 50);
}

/* ---- scenes ---- */

TEST(index_out_of_range_gives_422_with_pointer)
{
    assert_scene_refused("{\"meshes\":[{\"positions\":[[0,0,0],[1,0,0],[0,1,0]],\"faces\":[[0,1,2],[0,1,99]]}]}", 422,
                         TEXTS("\"/meshes/0/faces/1/2\"", "99"));
}

TEST(nan_gives_400)
{
    assert_scene_refused("{\"polygons\":[{\"vertices\":[[NaN,0,0],[1,0,0],[0,1,0]]}]}", 400, NULL);
}

TEST(infinite_number_gives_422)
{
    assert_scene_refused("{\"polygons\":[{\"vertices\":[[1e999,0,0],[1,0,0],[0,1,0]]}]}", 422, TEXTS("/polygons/0"));
}

TEST(empty_body_gives_400)
{
    assert_scene_refused("", 400, NULL);
}

TEST(scene_without_geometry_gives_422)
{
    assert_scene_refused("{\"polygons\":[]}", 422, NULL);
}

TEST(window_too_large_gives_422_with_limit_and_value)
{
    assert_scene_refused("{\"window\":{\"width\":100000,\"height\":100000},"
                         "\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]}",
                         422, TEXTS("100000", "8192"));
}

TEST(unknown_key_gives_422_with_pointer)
{
    assert_scene_refused("{\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]],\"colr\":\"#ffffff\"}]}", 422,
                         TEXTS("\"/polygons/0/colr\""));
}

TEST(more_faults_than_are_listed_are_said_to_be)
{
    char scene[1024];
    for (int faults = 19; faults <= 21; faults++) {
        int used = snprintf(scene, sizeof scene, "{\"polygons\":[{\"vertices\":[[0,0,0]");
        for (int i = 0; i < faults; i++)
            used += snprintf(scene + used, sizeof scene - (size_t)used, ",[0,0,\"x\"]");
        snprintf(scene + used, sizeof scene - (size_t)used, "]}]}");
        struct reply reply = client_render(&server, scene);
        assert_int_equal(reply.status, 422);
        cJSON *problem = cJSON_Parse(reply.body);
        assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(problem, "errors")), faults < 20 ? faults : 20);
        assert_int_equal(cJSON_IsTrue(cJSON_GetObjectItem(problem, "truncated")), faults >= 20);
        cJSON_Delete(problem);
        reply_free(&reply);
    }
}

TEST(wrong_type_gives_422_with_pointer)
{
    assert_scene_refused("{\"polygons\":[{\"vertices\":\"many\"}]}", 422, TEXTS("\"/polygons/0/vertices\""));
}

TEST(deep_json_is_refused)
{
    char scene[4096];
    memset(scene, '[', 2000);
    memset(scene + 2000, ']', 2000);
    scene[4000] = '\0';
    assert_scene_refused(scene, 422, NULL);
}

/* ---- hierarchies ---- */

#define CORNER "\"meshes\":[{\"positions\":[[0,0,0],[1,0,0],[0,1,0]],\"faces\":[[0,1,2]]}]"

static void assert_nodes_refused(const char *nodes, const char *const *texts)
{
    char scene[4096];
    snprintf(scene, sizeof scene, "{" CORNER ",\"nodes\":[%s]}", nodes);
    assert_scene_refused(scene, 422, texts);
    assert_int_equal(client_get_status(&server, "/healthz"), 200);
}

TEST(nodes_in_a_circle_give_422_with_pointer)
{
    assert_nodes_refused("{\"mesh\":0,\"children\":[0]}", TEXTS("\"/nodes/0/children/0\"", "cycle"));
    assert_nodes_refused("{\"mesh\":0,\"children\":[1]},{\"children\":[2]},{\"children\":[1]}",
                         TEXTS("\"/nodes/2/children/0\"", "cycle"));
}

TEST(nodes_with_huge_matrices_give_422_with_pointer)
{
    assert_nodes_refused("{\"mesh\":0,\"matrix\":[1e300,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}",
                         TEXTS("\"/nodes/0/matrix/0\""));
    assert_nodes_refused("{\"matrix\":[9e14,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],\"children\":[1]},"
                         "{\"mesh\":0,\"scale\":[2,1,1]}",
                         TEXTS("\"/nodes/1\"", "world space"));
    /* Within the limits one by one, but no view holds it. */
    assert_nodes_refused("{\"mesh\":0,\"matrix\":[9e14,0,0,0,0,9e14,0,0,0,0,9e14,0,9e14,9e14,9e14,1]},{\"mesh\":0}",
                         TEXTS("\"/view\""));
}

/* `length` nodes, each with the next for a child `times` times; the last has a mesh. */
static void assert_chain_refused(int length, int times, const char *const *texts)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    fputs("{" CORNER ",\"nodes\":[", out);
    for (int i = 1; i < length; i++) {
        fprintf(out, "{\"children\":[%d", i);
        for (int k = 1; k < times; k++)
            fprintf(out, ",%d", i);
        fputs("]},", out);
    }
    fputs("{\"mesh\":0}]}", out);
    assert_int_equal(fclose(out), 0);
    assert_refused(JSON_TYPE, text, size, 422, texts);
    assert_int_equal(client_get_status(&server, "/healthz"), 200);
    free(text);
}

TEST(nodes_that_multiply_give_422)
{
    assert_chain_refused(41, 2, TEXTS("\"/nodes\"", "100000 instances"));
    assert_chain_refused(65, 2, TEXTS("\"/nodes\"", "100000 instances"));
    assert_chain_refused(6, 1000, TEXTS("\"/nodes\"", "100000 instances"));
}

TEST(nodes_in_a_deep_chain_give_422)
{
    assert_chain_refused(100000, 1, TEXTS("nested too deep"));
}

/* ---- bodies ---- */

TEST(large_body_with_length_gives_413)
{
    char *body = malloc(LARGE_BODY);
    assert_non_null(body);
    memset(body, ' ', LARGE_BODY);
    assert_refused(JSON_TYPE, body, LARGE_BODY, 413, TEXTS("bodyMaxBytes"));
    free(body);
}

TEST(large_body_without_expect_gives_413)
{
    static const char HEAD[] =
        "POST /v1/render HTTP/1.1\r\nHost: a\r\n" JSON_TYPE "\r\nContent-Length: 100000000\r\n\r\n";
    char *request = malloc(sizeof HEAD - 1 + LARGE_BODY);
    assert_non_null(request);
    memcpy(request, HEAD, sizeof HEAD - 1);
    memset(request + sizeof HEAD - 1, ' ', LARGE_BODY);
    char *text = client_raw(&server, request, sizeof HEAD - 1 + LARGE_BODY, 5000);
    assert_int_equal(raw_status(text), 413);
    free(text);
    text = client_raw(&server, request, sizeof HEAD - 1, 5000); /* the header alone must do */
    assert_int_equal(raw_status(text), 413);
    free(text);
    free(request);
    assert_still_serves();
}

TEST(large_chunked_body_gives_413)
{
    struct reply reply = client_send_chunked(&server, "/v1/render", LARGE_BODY);
    assert_int_equal(reply.status, 413);
    reply_free(&reply);
    assert_still_serves();
}

TEST(truncated_stl_gives_400)
{
    /* The header, a count of 2 triangles, and half of one. */
    char stl[80 + 4 + 25] = "binary";
    stl[80] = 2;
    assert_refused("Content-Type: model/stl", stl, sizeof stl, 400, NULL);
}

TEST(text_that_is_no_model_gives_400)
{
    static const char TEXT[] = "Dear server, please draw a house.\n";
    assert_refused("Content-Type: model/stl", TEXT, sizeof TEXT - 1, 400, NULL);
    assert_refused("Content-Type: model/obj", TEXT, sizeof TEXT - 1, 400, NULL);
}

TEST(broken_chunks_are_refused)
{
    static const char REQUEST[] = "POST /v1/render HTTP/1.1\r\nHost: a\r\n" JSON_TYPE
                                  "\r\nTransfer-Encoding: chunked\r\n\r\nZZ\r\n{}\r\n0\r\n\r\n";
    char *text = client_raw(&server, REQUEST, sizeof REQUEST - 1, 5000);
    assert_int_equal(raw_status(text), 400);
    free(text);
    assert_still_serves();
}

RUN_TESTS(start, stop)
