/* Streams whose readers stop: their memory, until the daemon cuts them off. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "server/support/streamed.h"
#include "support/sanitized.h"
#include "support/tests.h"

/* Whether a small render is answered with `status` within some seconds. */
static bool is_answered(const struct daemon *server, long status, int seconds)
{
    for (int tries = 0; tries < 50 * seconds; tries++) {
        if (client_render_status(server, GOOD_SCENE) == status) return true;
        usleep(20 * 1000);
    }
    return false;
}

/* Two views of 2 MB, then views of 12 MB: a reader that goes on makes its stream need more memory. */
TEST(memory_of_streams_that_wait_counts_as_that_of_answers_until_their_readers_are_cut_off)
{
    enum { READERS = 12, BUFFER = 1 << 16 };
    static const char SMALL[] = "\"window\":{\"width\":400,\"height\":400}";
    char scene[1024];
    int streams = 0;
    struct streamed readers[READERS];
    struct daemon server = daemon_start(LIST("--render-timeout-ms=600000", ANY_COST, "--answer-memory-bytes=64000000",
                                             "--workers=2", "--threads=2", "--queue=64"));
    const long before = daemon_memory_kib(&server, "VmRSS:");
    snprintf(scene, sizeof scene,
             "{\"window\":{\"width\":1024,\"height\":1024},\"meshes\":[{\"heights\":[[0,1,0],[1,2,1],[0,1,3]]}],"
             "\"outputs\":[{\"channel\":\"position\"}],"
             "\"views\":[{%s},{\"name\":\"b\",%s},\"top\",\"front\",\"left\",\"right\"]}",
             SMALL, SMALL);
    for (int i = 0; i < READERS; i++)
        readers[i] = streamed_begin(&server, scene, BUFFER);
    assert_true(is_answered(&server, 503, 10));
    struct reply reply = client_render(&server, GOOD_SCENE);
    assert_int_equal(reply.status, 503);
    assert_non_null(strstr(reply.body, "answerMemoryBytes"));
    assert_string_not_equal(reply_header(&reply, "Retry-After"), "");
    reply_free(&reply);
    assert_int_equal(client_get_status(&server, "/healthz"), 200);
    for (int i = 0; i < READERS; i++) {
        assert_true(streamed_read(&readers[i]));
        streams += readers[i].status == 200;
        while (readers[i].status == 200 && readers[i].size < (3 << 20))
            assert_true(streamed_read(&readers[i]));
    }
    const double begun = client_seconds();
    assert_true(is_answered(&server, 503, 10));
    const long grown = daemon_memory_kib(&server, "VmHWM:") - before;
    assert_true(is_answered(&server, 200, 60));
    print_message("# %d streams, %ld KiB more; answers again after %.1f s\n", streams, grown, client_seconds() - begun);
    assert_true(streams <= 6); /* two whose larger views fill the ceiling, and two for each worker */
    if (!IS_SANITIZED) assert_true(grown < 300 * 1024); /* up to the ceiling, and one more of each worker */
    for (int i = 0; i < READERS; i++)
        streamed_end(&readers[i]);
    daemon_stop(&server);
}

RUN_TESTS(NULL, NULL)
