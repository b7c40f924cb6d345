/* Small requests beside large ones, and memory when all is over. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "server/support/client.h"
#include "support/sanitized.h"
#include "support/tests.h"

enum { LARGE = 6, SMALL = 20 };

#define LET_IN ANY_COST, "--render-timeout-ms=600000", "--max-per-client=0"

/* A scene that takes seconds at the very least, drawn by one of the textbook's algorithms, for those are never
 * in a hurry. Its body may look small. */
static char *scene_large(bool small_body)
{
    char *scene = scene_slow(SLOW_ALGORITHM, small_body ? 2 * SLOW_SIDE : SLOW_SIDE, small_body ? 1000 : 4000);
    assert_true((strlen(scene) < 64 << 10) == small_body);
    return scene;
}

/* One by one: each is at work, or waits among the large ones, before the next comes. */
static void begin_large(const struct daemon *server, int workers, const char *scene, int *clients, int count)
{
    for (int i = 0; i < count; i++) {
        char line[64];
        if (i < workers)
            snprintf(line, sizeof line, "zraster_workers_busy %d", i + 1);
        else
            snprintf(line, sizeof line, "zraster_queue_length{queue=\"large\"} %d", i + 1 - workers);
        clients[i] = client_begin_render(server, scene);
        client_wait_for_metric(server, "", line);
    }
}

/* None has been answered. */
static void end_large(const int *clients, int count)
{
    for (int i = 0; i < count; i++) {
        char byte;
        assert_true(recv(clients[i], &byte, 1, MSG_DONTWAIT) < 0 && (errno == EAGAIN || errno == EWOULDBLOCK));
        close(clients[i]);
    }
}

TEST(small_requests_are_served_while_large_ones_run_and_wait)
{
    for (int small_body = 0; small_body < 2; small_body++) {
        struct daemon server = daemon_start((const char *const[]){LET_IN, "--workers=2", "--queue=8", NULL});
        int clients[LARGE];
        char *scene = scene_large(small_body);
        begin_large(&server, 2, scene, clients, LARGE);
        for (int i = 0; i < SMALL; i++)
            assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
        end_large(clients, LARGE);
        free(scene);
        daemon_stop(&server);
    }
}

TEST(small_requests_are_served_while_no_more_large_ones_are)
{
    struct daemon server = daemon_start((const char *const[]){LET_IN, "--workers=1", "--queue=1", NULL});
    int clients[2];
    char *scene = scene_large(true);
    begin_large(&server, 1, scene, clients, 2); /* one is worked on, one waits */
    struct reply reply = client_render(&server, scene);
    assert_int_equal(reply.status, 503);
    assert_true(atoi(reply_header(&reply, "Retry-After")) >= 1);
    reply_free(&reply);
    assert_int_equal(client_get_status(&server, "/readyz"), 503);
    reply = client_get(&server, "/metrics");
    assert_non_null(strstr(reply.body, "\nzraster_ready 0\n"));
    reply_free(&reply);
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
    end_large(clients, 2);
    free(scene);
    daemon_stop(&server);
}

/* A request that the express puts back, at the moment when all has to end. */
TEST(large_request_behind_another_is_answered_when_the_daemon_ends)
{
    struct daemon server = daemon_start((const char *const[]){LET_IN, "--workers=1", "--drain-timeout-ms=100", NULL});
    int clients[3];
    char *scene = scene_large(true);
    for (int i = 0; i < 3; i++)
        clients[i] = client_begin_render(&server, scene);
    daemon_stop(&server);
    for (int i = 0; i < 3; i++) {
        char *text = client_read(clients[i], NULL, 5000);
        assert_int_equal(raw_status(text), 503);
        free(text);
        close(clients[i]);
    }
    free(scene);
}

/* ---- memory ---- */

/* A window of 25 million pixels, then an answer of some megabytes. */
TEST(memory_goes_back_to_the_system_when_nothing_happens)
{
    enum { LARGE_KIB = 64 << 10, SPARE_KIB = 24 << 10, WAIT_MS = 20000, TICK_MS = 100 };
#define WITH(side, output)                                                                                             \
    "{\"window\":{\"width\":" side ",\"height\":" side "},\"outputs\":[" output                                        \
    "],\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]]}]}"
    static const char *const large[] = {WITH("5000", "{\"channel\":\"color\"}"),
                                        WITH("1024", "{\"channel\":\"depth\",\"encoding\":\"npy\"}")};
#undef WITH
    struct daemon server = daemon_start((const char *const[]){LET_IN, NULL});
    for (int i = 0; i < 4; i++)
        assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
    long before = daemon_memory_kib(&server, "VmRSS:");
    for (int i = 0; i < 2; i++)
        assert_int_equal(client_render_status(&server, large[i]), 200);
    assert_true(daemon_memory_kib(&server, "VmHWM:") > before + LARGE_KIB);
#if !IS_SANITIZED /* whose allocators keep what is freed */
    long after = 0;
    for (int waited = 0; waited < WAIT_MS; waited += TICK_MS) {
        after = daemon_memory_kib(&server, "VmRSS:");
        if (after < before + SPARE_KIB) break;
        usleep(TICK_MS * 1000);
    }
    assert_true(after < before + SPARE_KIB);
#endif
    daemon_stop(&server);
}

TEST(what_is_announced_and_has_not_come_takes_no_memory)
{
    enum { BODIES = 16, SENT = 4 << 20, SENT_KIB = BODIES * SENT >> 10, SPARE_KIB = 24 << 10, TICKS = 100 };
    static const char HEADER[] =
        "POST /v1/render HTTP/1.1\r\nHost: a\r\n" JSON_TYPE "\r\nContent-Length: 50000000\r\n\r\n";
    static char spaces[SENT];
    struct daemon server = daemon_start((const char *const[]){LET_IN, NULL});
    const long before = daemon_memory_kib(&server, "VmRSS:");
    int senders[BODIES];
    memset(spaces, ' ', sizeof spaces);
    for (int i = 0; i < BODIES; i++) {
        senders[i] = client_connect(&server);
        assert_true(client_write(senders[i], HEADER, sizeof HEADER - 1) && client_write(senders[i], spaces, SENT));
    }
    long grown = 0;
    for (int tick = 0; tick < TICKS && grown < SENT_KIB; tick++, usleep(100000))
        grown = daemon_memory_kib(&server, "VmRSS:") - before;
    assert_true(grown >= SENT_KIB);
    grown = daemon_memory_kib(&server, "VmRSS:") - before;
#if !IS_SANITIZED
    assert_true(grown < SENT_KIB + SPARE_KIB);
#endif
    for (int i = 0; i < BODIES; i++)
        close(senders[i]);
    daemon_stop(&server);
}

RUN_TESTS(clients_setup, clients_teardown)
