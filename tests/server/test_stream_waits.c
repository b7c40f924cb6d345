/* A reader of a stream that stops for 20 s. */
#include <string.h>
#include <unistd.h>

#include "server/support/streamed.h"
#include "support/sanitized.h"
#include "support/tests.h"

/* Much more than systems hold: 40 MB. */
#define LARGE                                                                                                          \
    "{\"window\":{\"width\":512,\"height\":512},\"meshes\":[{\"heights\":[[0,1,0],[1,2,1],[0,1,3]]}],\"outputs\":["    \
    "{\"channel\":\"depth\",\"encoding\":\"npy\"}],\"turntable\":{\"frames\":40}}"

/* BUFFER: with less, systems do not say at once that there is room again. */
enum { BUFFER = 1 << 18, STOP_S = 20, SMALL_MS = 1000, MORE_KIB = 4096 };

TEST(a_reader_that_stops_for_20_s_loses_nothing_and_costs_others_nothing)
{
    struct daemon server =
        daemon_start(LIST("--workers=1", ANY_COST, "--render-timeout-ms=600000", "--write-timeout-ms=600000"));
    struct streamed whole = streamed_begin(&server, LARGE, 0);
    streamed_read_all(&whole);
    struct streamed stopped = streamed_begin(&server, LARGE, BUFFER);
    streamed_read_part(&stopped);
    const double begun = client_seconds();
    double most = 0.0;
    long before = 0;
    while (client_seconds() - begun < STOP_S) {
        const double since = client_seconds();
        assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
        if (client_seconds() - since > most) most = client_seconds() - since;
        if (since - begun < 2.0) before = daemon_memory_kib(&server, "VmRSS:"); /* until each thread has had one */
        usleep(100 * 1000);
    }
    const long after = daemon_memory_kib(&server, "VmRSS:");
    print_message("# others waited %.1f ms at most; %ld KiB before, %ld after\n", 1e3 * most, before, after);
    assert_true(1e3 * most < SMALL_MS);
    if (!IS_SANITIZED) assert_true(after < before + MORE_KIB);
    streamed_read_all(&stopped);

    struct streamed_parts a = streamed_parts(&whole), b = streamed_parts(&stopped);
    struct streamed_part p, q;
    int count = 0;
    for (; streamed_next(&a, &p); count++) {
        assert_true(streamed_next(&b, &q));
        assert_string_equal(p.name, q.name);
        assert_int_equal(p.size, q.size);
        assert_memory_equal(p.bytes, q.bytes, p.size);
    }
    assert_int_equal(count, 40);
    assert_true(streamed_is_final(&a) && streamed_is_final(&b));
    free(a.body);
    free(b.body);
    streamed_end(&whole);
    streamed_end(&stopped);
    daemon_stop(&server);
}

RUN_TESTS(NULL, NULL)
