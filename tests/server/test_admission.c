/* Work that is refused before it begins: too dear, or no memory for it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "client.h"
#include "support/cmocka_all.h"

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

static void scene_predicted_over_the_budget_gives_422_with_the_figures(void **state)
{
    (void)state;
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

static void control_group_nearly_full_gives_503_until_it_is_not(void **state)
{
    (void)state;
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scene_predicted_over_the_budget_gives_422_with_the_figures),
        cmocka_unit_test(control_group_nearly_full_gives_503_until_it_is_not),
    };
    return cmocka_run_group_tests_name("admission", tests, NULL, NULL);
}
