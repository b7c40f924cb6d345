/* Readers that do not read, of one and of many addresses: their streams cost other clients nothing. READER_REQUESTS=400
 * sends so many requests of another client, and bounds their times. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "server/support/streamed.h"
#include "support/sanitized.h"
#include "support/tests.h"

enum { MIB = 1 << 20, ANSWERS = 16 * MIB, STREAMS = 8, READERS_MAX = 64, BUFFER = 1 << 16, P99_MS = 150 };

#define SETTINGS                                                                                                       \
    "--render-timeout-ms=600000", ANY_COST, "--workers=2", "--threads=2", "--queue=128", "--max-streams=8",            \
        "--answer-memory-bytes=16777216"

/* Views of 5 MB each: a stream that waits holds a view's file and its values, more than half of ANSWERS. */
#define SCENE                                                                                                          \
    "{\"window\":{\"width\":640,\"height\":640},\"meshes\":[{\"heights\":[[0,1,0],[1,2,1],[0,1,3]]}],"                 \
    "\"outputs\":[{\"channel\":\"position\"}],\"turntable\":{\"frames\":40}}"

static struct daemon seen_from(const struct daemon *daemon, unsigned address)
{
    struct daemon other = *daemon;
    other.client = address;
    return other;
}

/* Begins streams and reads what shows whether they are served. Returns how many are. */
static int begin_all(const struct daemon *daemon, struct streamed *readers, int count, bool of_many)
{
    int served = 0;
    for (int i = 0; i < count; i++) {
        const struct daemon from = seen_from(daemon, of_many ? 10 + (unsigned)i : 2);
        readers[i] = streamed_begin(&from, SCENE, BUFFER);
    }
    for (int i = 0; i < count; i++) {
        assert_true(streamed_read(&readers[i]));
        assert_true(readers[i].status == 200 || readers[i].status == 503);
        served += readers[i].status == 200;
    }
    return served;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void assert_others_are_served(const struct daemon *daemon)
{
    const int more = getenv("READER_REQUESTS") ? atoi(getenv("READER_REQUESTS")) : 0, count = more > 0 ? more : 20;
    double *times_ms = calloc((size_t)count, sizeof *times_ms);
    assert_non_null(times_ms);
    for (int i = 0; i < count; i++) {
        const double begun = client_seconds();
        assert_int_equal(client_render_status(daemon, GOOD_SCENE), 200);
        times_ms[i] = 1e3 * (client_seconds() - begun);
        assert_int_equal(client_get_status(daemon, "/readyz"), 200);
    }
    qsort(times_ms, (size_t)count, sizeof *times_ms, compare);
    print_message("# %d requests of another client: 99 %% within %.1f ms\n", count, times_ms[(count * 99 - 1) / 100]);
    if (more) assert_true(times_ms[(count * 99 - 1) / 100] <= P99_MS);
    free(times_ms);
}

TEST(streams_that_wait_cost_other_clients_nothing)
{
    static const int COUNTS[] = {3, 8, READERS_MAX};
    struct streamed readers[READERS_MAX];
    for (int i = 0; i < 6; i++) {
        const int count = COUNTS[i / 2];
        const bool of_many = i % 2 != 0;
        struct daemon server = daemon_start(LIST(SETTINGS));
        const long before = daemon_memory_kib(&server, "VmRSS:");
        const int served = begin_all(&server, readers, count, of_many);
        assert_others_are_served(&server);
        const long grown = daemon_memory_kib(&server, "VmHWM:") - before;
        print_message("# %d readers of %s: %d streams, %ld KiB more\n", count, of_many ? "many addresses" : "one",
                      served, grown);
        assert_true(served > 0);
        if (!IS_SANITIZED) assert_true(grown < 6 * ANSWERS / 1024);
        for (int k = 0; k < count; k++)
            streamed_end(&readers[k]);
        daemon_stop(&server);
    }
}

TEST(a_client_whose_answers_wait_is_refused_by_its_share_and_no_other_one)
{
    struct streamed readers[2];
    struct daemon server = daemon_start(LIST(SETTINGS)), slow = seen_from(&server, 2);
    begin_all(&server, readers, 2, false);
    struct reply reply = client_render(&slow, GOOD_SCENE);
    for (int tries = 0; tries < 500 && reply.status != 503; tries++) { /* until a stream waits */
        reply_free(&reply);
        usleep(20 * 1000);
        reply = client_render(&slow, GOOD_SCENE);
    }
    assert_int_equal(reply.status, 503);
    assert_non_null(strstr(reply.body, "this client fill its half of answerMemoryBytes"));
    assert_string_not_equal(reply_header(&reply, "Retry-After"), "");
    reply_free(&reply);
    assert_int_equal(client_get_status(&slow, "/healthz"), 200);
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
    free(daemon_wait_for_log(&server, "\"refused\":\"share\""));
    for (int i = 0; i < 2; i++)
        streamed_end(&readers[i]);
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
    daemon_stop(&server);
}

/* 4096 bytes every 2 s are twice the minimum of 1024 bytes/s, and less than that while streams are short. */
TEST(a_slow_reader_is_cut_off_early_while_streams_are_short)
{
    struct streamed readers[STREAMS];
    char bytes[4096];
    ssize_t count = 1;
    struct daemon server = daemon_start(LIST(SETTINGS, "--write-timeout-ms=600000"));
    assert_true(begin_all(&server, readers, STREAMS, true) > 0);
    for (int tries = 0; tries < 60 && count > 0; tries++) {
        count = read(readers[0].fd, bytes, sizeof bytes);
        usleep(2000 * 1000);
        char *log = daemon_log(&server);
        if (strstr(log, "the answer was read too slowly")) count = 0;
        free(log);
    }
    assert_true(count <= 0);
    for (int i = 0; i < STREAMS; i++)
        streamed_end(&readers[i]);
    daemon_stop(&server);
}

RUN_TESTS(NULL, NULL)
