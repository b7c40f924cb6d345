/* Model files that the daemon keeps as read. No answer depends on them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "server/support/assets.h"
#include "support/tests.h"

static struct folder folder;
static struct daemon server;

static int start(void **state)
{
    (void)state;
    folder = folder_make();
    server = assets_start(&folder, (const char *const[]){NULL});
    return 0;
}

static int stop(void **state)
{
    (void)state;
    daemon_stop(&server);
    folder_remove(&folder);
    return 0;
}

/* A sheet of triangles as OBJ, of some 200 KB. Free it. */
static char *write_sheet(size_t *size)
{
    enum { SIDE = 70 };
    char *text;
    FILE *out = open_memstream(&text, size);
    for (int i = 0; i < SIDE * SIDE; i++)
        fprintf(out, "v %d %d %d\n", i % SIDE, i / SIDE, i * i % 7);
    for (int i = 0; i < SIDE * (SIDE - 1); i++)
        if (i % SIDE < SIDE - 1)
            fprintf(out, "f %d %d %d\nf %d %d %d\n", i + 1, i + 2, i + SIDE + 2, i + 1, i + SIDE + 2, i + SIDE + 1);
    fclose(out);
    return text;
}

static long count_meshes(const struct daemon *daemon, const char *which)
{
    char key[40];
    struct reply reply = client_get(daemon, "/healthz");
    const char *meshes = strstr(reply.body, "\"meshes\":{");
    snprintf(key, sizeof key, "\"%s\":", which);
    const char *at = meshes ? strstr(meshes, key) : NULL;
    assert_non_null(at);
    const long count = strtol(at + strlen(key), NULL, 10);
    reply_free(&reply);
    return count;
}

static struct reply draw_moved(const struct daemon *daemon, const char *name, int x)
{
    char scene[400];
    snprintf(scene, sizeof scene,
             "{\"window\":{\"width\":64,\"height\":48},\"meshes\":[{\"asset\":\"sha256:%s\"}],\"nodes\":"
             "[{\"mesh\":0,\"rotation\":[0,0,%d,1]}]}",
             name, x);
    return client_render(daemon, scene);
}

static struct reply draw_sent(const struct daemon *daemon, const char *target, const char *bytes, size_t size)
{
    return client_send(daemon, "POST", target, LIST("Content-Type: model/obj"), bytes, size);
}

static void assert_same_reply(struct reply got, struct reply want)
{
    assert_int_equal(got.status, want.status);
    assert_true(reply_is_same(&got, &want));
    static char warnings[4096];
    snprintf(warnings, sizeof warnings, "%s", reply_header(&want, "Zraster-Warnings"));
    assert_string_equal(reply_header(&got, "Zraster-Warnings"), warnings);
    reply_free(&got);
    reply_free(&want);
}

TEST(models_are_read_once_and_answers_do_not_tell)
{
    size_t size;
    char *sheet = write_sheet(&size);
    struct folder other = folder_make();
    struct daemon none = assets_start(&other, LIST("--keep-mesh-bytes=0"));
    const struct asset_name name = asset_post(&server, sheet, size, 201);
    asset_post(&none, sheet, size, 201);
    assert_int_equal(count_meshes(&server, "count"), 0);
    for (int x = 0; x < 4; x++)
        assert_same_reply(draw_moved(&server, name.text, x), draw_moved(&none, name.text, x));
    assert_int_equal(count_meshes(&server, "count"), 1);
    assert_int_equal(count_meshes(&server, "misses"), 2);
    assert_int_equal(count_meshes(&server, "hits"), 2);
    assert_true(count_meshes(&server, "bytes") > (long)size / 2);
    static const char *const targets[] = {"/v1/render?width=40&height=40&azimuth=10",
                                          "/v1/render?width=50&height=40&azimuth=20",
                                          "/v1/render?width=50&height=40&look=textbook", "/v1/render?channel=info",
                                          "/v1/render?width=50&height=40&animation=walk"};
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++)
        assert_same_reply(draw_sent(&server, targets[i], sheet, size), draw_sent(&none, targets[i], sheet, size));
    assert_int_equal(count_meshes(&server, "count"), 2);
    assert_int_equal(count_meshes(&none, "misses"), 0);
    daemon_stop(&none);
    folder_remove(&other);
    free(sheet);
}

/* Else it would depend on what others have asked for whether a scene is drawn. */
TEST(a_kept_model_is_not_drawn_once_it_is_stored_no_more)
{
    size_t size;
    char *sheet = write_sheet(&size);
    sheet[2] = '1'; /* another one */
    const struct asset_name name = asset_post(&server, sheet, size, 201);
    for (int x = 0; x < 3; x++) {
        struct reply reply = draw_moved(&server, name.text, x);
        assert_int_equal(reply.status, 200);
        reply_free(&reply);
    }
    const struct folder file = folder_file(&folder, name.text);
    assert_int_equal(unlink(file.path), 0);
    struct reply reply = draw_moved(&server, name.text, 3);
    assert_int_equal(reply.status, 422);
    assert_non_null(strstr(reply.body, "no asset is kept under the hash"));
    assert_non_null(strstr(reply.body, "/meshes/0/asset"));
    reply_free(&reply);
    free(sheet);
}

RUN_TESTS(start, stop)
