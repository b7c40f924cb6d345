/* Flags, variables, and what the binary does besides serving. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/isa.h"
#include "server/support/client.h"
#include "support/tests.h"

/* Runs with `arguments` (to NULL); its exit status and `texts` (to NULL) in its output must be these. */
static void assert_run(const char *const *arguments, int status, const char *const *texts)
{
    char *output = NULL;
    int got = daemon_run(arguments, &output);
    if (got != status) fail_msg("wanted exit status %d, got %d: %s", status, got, output);
    for (; *texts; texts++)
        if (!strstr(output, *texts)) fail_msg("'%s' is not in: %s", *texts, output);
    free(output);
}

TEST(help_lists_every_flag)
{
    assert_run(LIST("--help"), 0,
               LIST("--address", "--port", "--workers", "--threads", "--queue", "--max-per-client", "--max-connections",
                    "--body-max-bytes", "--upload-memory-bytes", "--header-timeout-ms", "--idle-timeout-ms",
                    "--body-timeout-ms", "--body-min-bytes-per-second", "--write-timeout-ms", "--render-timeout-ms",
                    "--drain-delay-ms", "--drain-timeout-ms", "--request-memory-bytes", "--keep-memory-bytes",
                    "--token", "--json-depth-max", "--window-side-max", "--window-pixels-max", "--polygon-vertices-max",
                    "--assets-dir", "--assets-max-bytes", "--instances-max", "--image-pixels-max", "--coordinate-max",
                    "--isa", "--health", "--version", "ZRASTER_"));
}

TEST(help_does_not_show_the_token)
{
    char *output = NULL;
    setenv("ZRASTER_TOKEN", "hidden-token", 1);
    assert_int_equal(daemon_run(LIST("--help"), &output), 0);
    unsetenv("ZRASTER_TOKEN");
    assert_null(strstr(output, "hidden-token"));
    free(output);
}

TEST(version_is_printed)
{
    assert_run(LIST("--version"), 0, LIST("zrasterd 0."));
}

TEST(help_and_version_are_given_beside_what_is_wrong)
{
    setenv("ZRASTER_WORKERS", "many", 1);
    assert_run(LIST("--help"), 0, LIST("usage: zrasterd"));
    assert_run(LIST("--prot=80", "--version"), 0, LIST("zrasterd 0."));
    assert_run(LIST("--port=0"), 2, LIST("ZRASTER_WORKERS", "'many'"));
    unsetenv("ZRASTER_WORKERS");
}

TEST(service_link_of_kubernetes_is_no_port)
{
    setenv("ZRASTER_PORT", "tcp://10.0.0.1:8080", 1);
    struct daemon daemon = daemon_start(NULL);
    struct reply reply = client_get(&daemon, "/healthz");
    assert_int_equal(reply.status, 200);
    reply_free(&reply);
    daemon_stop(&daemon);
    unsetenv("ZRASTER_PORT");
    setenv("ZRASTER_WORKERS", "tcp://10.0.0.1:8080", 1);
    assert_run(LIST("--port=0"), 2, LIST("ZRASTER_WORKERS"));
    unsetenv("ZRASTER_WORKERS");
}

TEST(unknown_flag_exits_2_and_is_named)
{
    assert_run(LIST("--prot=80"), 2, LIST("'--prot'", "did you mean --port?"));
    assert_run(LIST("serve"), 2, LIST("'serve'", "--help lists"));
    assert_run(LIST("--"), 2, LIST("'--'"));
}

TEST(bad_value_exits_2_and_says_what_is_allowed)
{
    assert_run(LIST("--port=65536"), 2, LIST("--port", "'65536'", "0 to 65535"));
    assert_run(LIST("--port", "-1"), 2, LIST("--port", "'-1'"));
    assert_run(LIST("--port="), 2, LIST("--port"));
    assert_run(LIST("--workers=many"), 2, LIST("--workers", "'many'", "0 to 256"));
    assert_run(LIST("--body-max-bytes=99999999999999999999"), 2, LIST("--body-max-bytes"));
    assert_run(LIST("--render-timeout-ms"), 2, LIST("--render-timeout-ms", "missing"));
    assert_run(LIST("--address=localhost"), 2, LIST("--address", "'localhost'", "numeric"));
    assert_run(LIST("--window-side-max=8193"), 2, LIST("--window-side-max", "1 to 8192"));
}

TEST(bad_variable_exits_2_and_is_named)
{
    setenv("ZRASTER_QUEUE", "x", 1);
    assert_run(LIST("--port=0"), 2, LIST("ZRASTER_QUEUE", "'x'"));
    unsetenv("ZRASTER_QUEUE");
}

/* x86 has no neon, and ARM no avx2; both have scalar. */
TEST(isa_that_is_unknown_or_not_there_exits_2_and_says_what_there_is)
{
    assert_run(LIST("--isa=mmx"), 2, LIST("--isa", "'mmx'", "auto, scalar"));
    assert_run(LIST("--isa="), 2, LIST("--isa", "''"));
    assert_run(LIST("--isa", "AVX2"), 2, LIST("--isa", "'AVX2'"));
#if defined __aarch64__
    assert_run(LIST("--isa=avx2"), 2, LIST("--isa", "'avx2'", "neon"));
#else
    assert_run(LIST("--isa=neon"), 2, LIST("--isa", "'neon'", "scalar"));
#endif
    setenv("ZRASTER_ISA", "mmx", 1);
    assert_run(LIST("--port=0"), 2, LIST("ZRASTER_ISA", "'mmx'"));
    unsetenv("ZRASTER_ISA");
}

static void assert_renders_with(const char *const *arguments, const char *isa)
{
    char line[64];
    struct daemon server = daemon_start(arguments);
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
    snprintf(line, sizeof line, "\"rendering with %s\"", isa);
    free(daemon_wait_for_log(&server, line)); /* it may come behind the answer */
    daemon_stop(&server);
}

TEST(isa_is_named_at_the_start_and_auto_is_the_best)
{
    assert_renders_with(NULL, zr_isa_name(zr_isa_best()));
    assert_renders_with(LIST("--isa=auto"), zr_isa_name(zr_isa_best()));
    for (int i = 0; i < ZR_ISA_COUNT; i++)
        if (zr_isa_is_available((enum zr_isa)i))
            assert_renders_with(LIST("--isa", zr_isa_name((enum zr_isa)i)), zr_isa_name((enum zr_isa)i));
    setenv("ZRASTER_ISA", "scalar", 1);
    assert_renders_with(NULL, "scalar");
    assert_renders_with(LIST("--isa=auto"), zr_isa_name(zr_isa_best()));
    unsetenv("ZRASTER_ISA");
}

TEST(port_in_use_exits_1)
{
    struct daemon server = daemon_start(NULL);
    char port[16];
    snprintf(port, sizeof port, "%u", server.port);
    assert_run(LIST("--port", port), 1, LIST("cannot listen", port));
    daemon_stop(&server);
}

/* The value that /v1/limits shows. */
static void assert_limit(const struct daemon *server, const char *text)
{
    struct reply reply = client_get(server, "/v1/limits");
    if (!strstr(reply.body, text)) fail_msg("'%s' is not in %s", text, reply.body);
    reply_free(&reply);
}

TEST(variable_is_read_and_flag_beats_it)
{
    setenv("ZRASTER_BODY_MAX_BYTES", "50", 1);
    setenv("ZRASTER_QUEUE", "7", 1);
    setenv("ZRASTER_WORKERS", "", 1);
    struct daemon server = daemon_start(LIST("--queue", "9"));
    unsetenv("ZRASTER_BODY_MAX_BYTES");
    unsetenv("ZRASTER_QUEUE");
    unsetenv("ZRASTER_WORKERS");
    assert_limit(&server, "\"bodyMaxBytes\":\t50");
    assert_limit(&server, "\"queue\":\t9");
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 413);
    daemon_stop(&server);
}

TEST(queue_defaults_to_256_a_worker)
{
    struct daemon server = daemon_start(LIST("--workers=3"));
    assert_limit(&server, "\"queue\":\t768");
    daemon_stop(&server);
}

TEST(limits_of_the_renderer_are_settings)
{
    struct daemon server = daemon_start(LIST("--window-side-max=100"));
    struct reply reply = client_render(&server, GOOD_SCENE); /* 640 x 480 */
    assert_int_equal(reply.status, 422);
    assert_non_null(strstr(reply.body, "100"));
    reply_free(&reply);
    daemon_stop(&server);
}

TEST(health_tells_whether_a_daemon_answers)
{
    struct daemon server = daemon_start(LIST("--token=anything"));
    char port[16];
    snprintf(port, sizeof port, "%u", server.port);
    assert_run(LIST("--health", "--port", port), 0, LIST(""));
    assert_run(LIST("--address=0.0.0.0", "--port", port, "--health"), 0, LIST(""));
    daemon_stop(&server);
    assert_run(LIST("--health", "--port", port), 1, LIST(""));
}

RUN_TESTS(NULL, NULL)
