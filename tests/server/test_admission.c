/* Work that is refused before it begins: too dear, or no memory for it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "server/support/client.h"
#include "server/support/problems.h"
#include "support/tests.h"

static void write_file(const char *folder, const char *name, const char *text)
{
    char path[300];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    assert_true(fputs(text, out) >= 0);
    assert_int_equal(fclose(out), 0);
}

static void remove_file(const char *folder, const char *name)
{
    char path[300];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    unlink(path);
}

TEST(scene_predicted_over_the_budget_gives_422_with_the_figures)
{
    struct daemon daemon = daemon_start((const char *const[]){"--cost-max-ms=50", NULL});
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, 20000);
    struct reply reply = client_render(&daemon, scene);
    assert_int_equal(reply.status, 422);
    assert_non_null(strstr(reply.body, "costMaxMs, 50 ms"));
    assert_null(strstr(reply_header(&reply, "Server-Timing"), "render;")); /* nothing was drawn */
    reply_free(&reply);
    free(scene);
    assert_int_equal(client_render_status(&daemon, GOOD_SCENE), 200);
    char *line = daemon_wait_for_log(&daemon, "\"status\":200");
    assert_non_null(strstr(line, "\"predictedMs\":"));
    free(line);
    daemon_stop(&daemon);
}

/* A square over most of the window, lit by so many lamps, with more keys of the scene. To be freed. */
static char *scene_of_lamps(unsigned lamps, bool have_shadows, const char *keys)
{
    enum { LAMP_SIZE = 100, REST_SIZE = 600 };
    const size_t size = REST_SIZE + lamps * LAMP_SIZE;
    char *scene = malloc(size);
    assert_non_null(scene);
    int used = snprintf(
        scene, size,
        "{%s,\"view\":{\"preset\":\"front\"},\"polygons\":[{\"vertices\":[[-2,-1,0],[2,-1,0],[2,1,0],[-2,1,0]],"
        "\"shading\":\"pbr\"},{\"vertices\":[[0,0,0],[1,0,0],[0,1,1]]}],\"lights\":[",
        keys);
    for (unsigned i = 0; i < lamps; i++)
        used += snprintf(scene + used, size - (size_t)used,
                         "%s{\"type\":\"directional\",\"direction\":[0,0,-1],\"shadows\":%s}", i ? "," : "",
                         have_shadows ? "true" : "false");
    snprintf(scene + used, size - (size_t)used, "]}");
    return scene;
}

/* A model of nodes that one animation moves, each by a channel of its own. */
static char *model_of_moving_nodes(int count)
{
    static const char BUFFER[] =
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAA=";
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    fprintf(out,
            "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":68,\"uri\":\"data:;base64,%s\"}],"
            "\"bufferViews\":[{\"buffer\":0,\"byteLength\":68}],\"accessors\":["
            "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]},"
            "{\"bufferView\":0,\"byteOffset\":36,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\",\"min\":[0],"
            "\"max\":[1]},{\"bufferView\":0,\"byteOffset\":44,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"}],"
            "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
            "\"animations\":[{\"samplers\":[{\"input\":1,\"output\":2}],\"channels\":[",
            BUFFER);
    for (int i = 0; i < count; i++)
        fprintf(out, "%s{\"sampler\":0,\"target\":{\"node\":%d,\"path\":\"translation\"}}", i ? "," : "", i);
    fprintf(out, "]}],\"nodes\":[");
    for (int i = 0; i < count; i++)
        fprintf(out, "%s{\"mesh\":0}", i ? "," : "");
    fprintf(out, "],\"scenes\":[{\"nodes\":[");
    for (int i = 0; i < count; i++)
        fprintf(out, "%s%d", i ? "," : "", i);
    fprintf(out, "]}]}");
    assert_int_equal(fclose(out), 0);
    return text;
}

TEST(frames_that_read_too_many_nodes_again_are_refused_before_the_first)
{
    static const char *const TYPE[] = {"Content-Type: model/gltf+json", NULL};
    struct daemon daemon = daemon_start(LIST("--cost-max-ms=4000", "--render-timeout-ms=600000"));
    char *many = model_of_moving_nodes(2000), *few = model_of_moving_nodes(2);
    static const char MANY[] = "/v1/render?width=16&height=16&frames=4096",
                      FEW[] = "/v1/render?width=16&height=16&frames=3";
    struct reply reply = client_send(&daemon, "POST", MANY, TYPE, many, strlen(many));
    assert_problem(reply, 422, "objects of the file that frames read again");
    reply = client_send(&daemon, "POST", FEW, TYPE, few, strlen(few));
    assert_int_equal(reply.status, 200);
    reply_free(&reply);
    free(many);
    free(few);
    daemon_stop(&daemon);
}

TEST(light_that_takes_too_long_is_refused_beforehand)
{
    static const struct {
        unsigned lamps;
        bool have_shadows;
        const char *keys;
        bool is_refused;
    } cases[] = {
        {50, true, "\"samples\":64,\"window\":{\"width\":1920,\"height\":1080}", true},
        {1024, false, "\"samples\":64,\"window\":{\"width\":1920,\"height\":1080}", true},
        {50, true, "\"samples\":1,\"window\":{\"width\":64,\"height\":32}", false},
        {1024, false, "\"samples\":64,\"window\":{\"width\":64,\"height\":32}", false},
        {1, true, "\"samples\":16,\"window\":{\"width\":640,\"height\":480}", false},
    };
    struct daemon daemon = daemon_start(NULL);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char *scene = scene_of_lamps(cases[i].lamps, cases[i].have_shadows, cases[i].keys);
        struct reply reply = client_render(&daemon, scene);
        assert_int_equal(reply.status, cases[i].is_refused ? 422 : 200);
        assert_int_equal(strstr(reply.body, "costMaxMs") != NULL, cases[i].is_refused);
        assert_int_equal(strstr(reply_header(&reply, "Server-Timing"), "render;") == NULL, cases[i].is_refused);
        reply_free(&reply);
        free(scene);
    }
    daemon_stop(&daemon);
}

TEST(window_that_takes_too_much_memory_is_refused_beforehand)
{
    static const struct {
        const char *keys;
        bool is_refused;
    } cases[] = {
        {"\"look\":\"studio\",\"window\":{\"width\":8192,\"height\":4096}", true},
        {"\"look\":\"technical\",\"window\":{\"width\":8192,\"height\":4096}", true},
        {"\"samples\":64,\"algorithm\":\"scanline\",\"window\":{\"width\":2048,\"height\":2048}", true},
        {"\"window\":{\"width\":200,\"height\":100}", false},
        {"\"look\":\"technical\",\"window\":{\"width\":200,\"height\":100}", false},
    };
    struct daemon daemon = daemon_start((const char *const[]){ANY_COST, NULL});
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char *scene = scene_of_lamps(1, false, cases[i].keys);
        struct reply reply = client_render(&daemon, scene);
        assert_int_equal(reply.status, cases[i].is_refused ? 422 : 200);
        assert_int_equal(strstr(reply.body, "requestMemoryBytes") != NULL, cases[i].is_refused);
        assert_int_equal(strstr(reply_header(&reply, "Server-Timing"), "render;") == NULL, cases[i].is_refused);
        reply_free(&reply);
        free(scene);
    }
    daemon_stop(&daemon);
}

TEST(lamps_that_take_too_much_memory_are_named_beforehand)
{
    struct daemon daemon = daemon_start((const char *const[]){ANY_COST, NULL});
    char *scene = scene_of_lamps(140, true, "\"window\":{\"width\":64,\"height\":64}");
    struct reply reply = client_render(&daemon, scene);
    assert_problem(reply, 422, "140 lamps with shadows");
    free(scene);
    scene = scene_of_lamps(100, true, "\"look\":\"studio\",\"window\":{\"width\":8192,\"height\":4096}");
    reply = client_render(&daemon, scene);
    assert_int_equal(reply.status, 422);
    assert_null(strstr(reply.body, "lamps")); /* its pixels alone are too many */
    reply_free(&reply);
    free(scene);
    daemon_stop(&daemon);
}

static void assert_busy(const struct daemon *daemon)
{
    struct reply reply = client_render(daemon, GOOD_SCENE);
    assert_int_equal(reply.status, 503);
    assert_string_not_equal(reply_header(&reply, "Retry-After"), "");
    assert_non_null(strstr(reply.body, "memory"));
    reply_free(&reply);
    assert_int_equal(client_get_status(daemon, "/readyz"), 503);
    assert_int_equal(client_get_status(daemon, "/healthz"), 200);
}

static void assert_well(const struct daemon *daemon)
{
    assert_int_equal(client_render_status(daemon, GOOD_SCENE), 200);
    assert_int_equal(client_get_status(daemon, "/readyz"), 200);
}

TEST(control_group_nearly_full_gives_503_until_it_is_not)
{
    char folder[] = "/tmp/zraster-cgroup.XXXXXX";
    assert_non_null(mkdtemp(folder));
    struct daemon daemon = daemon_start((const char *const[]){"--cgroup", folder, NULL});
    assert_well(&daemon); /* no such group */
    write_file(folder, "memory.max", "max\n");
    write_file(folder, "memory.current", "99999999999\n");
    assert_well(&daemon); /* no limit */
    write_file(folder, "memory.max", "1000000\n");
    write_file(folder, "memory.current", "930000\n");
    assert_busy(&daemon);
    write_file(folder, "memory.stat", "anon 5\ninactive_file 20000\n"); /* cache that can go */
    assert_well(&daemon);
    write_file(folder, "memory.current", "990000\n");
    assert_busy(&daemon);
    daemon_stop(&daemon);
    const char *const names[] = {"memory.max", "memory.current", "memory.stat"};
    for (int i = 0; i < 3; i++)
        remove_file(folder, names[i]);
    rmdir(folder);
}

RUN_TESTS(NULL, NULL)
