/* Several views, each sent as soon as it is drawn. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "mcp/unzip.h"
#include "server/support/streamed.h"
#include "support/sanitized.h"
#include "support/tests.h"

#define LET_IN "--render-timeout-ms=600000", ANY_COST

#define GEOMETRY "\"meshes\":[{\"heights\":[[0,1,0],[1,2,1],[0,1,3]]}]"
#define COLOR    "{\"channel\":\"color\"}"
#define DEPTH    "{\"channel\":\"depth\",\"encoding\":\"npy\"}"

/* A turntable; in buffers of the test's own, so that there may be two. */
static const char *scene_of(char scene[1024], int frames, int side, const char *outputs)
{
    snprintf(scene, 1024,
             "{\"look\":\"studio\",\"window\":{\"width\":%d,\"height\":%d}," GEOMETRY
             ",\"outputs\":[%s],\"turntable\":{\"frames\":%d}}",
             side, side, outputs, frames);
    return scene;
}

/* By the clock of the log. */
static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- views as they are drawn alone ---- */

TEST(each_part_is_the_file_of_the_archive_and_the_first_comes_before_the_last_is_drawn)
{
    enum { VIEWS = IS_SANITIZED ? 40 : 200, SIDE = IS_SANITIZED ? 64 : 200 };
    char scene[1024];
    struct daemon server = daemon_start(LIST(LET_IN));
    scene_of(scene, VIEWS, SIDE, COLOR ",{\"channel\":\"depth\",\"encoding\":\"png16\"}");
    struct reply archive = client_render(&server, scene);
    assert_int_equal(archive.status, 200);
    assert_string_equal(reply_header(&archive, "Content-Type"), "application/zip");
    assert_string_equal(reply_header(&archive, "Vary"), "Accept");
    const double begun = seconds();
    struct streamed streamed = streamed_begin(&server, scene, 0);
    streamed_read_part(&streamed);
    const double first = seconds() - begun;
    streamed_read_all(&streamed);
    const double last = seconds() - begun;
    print_message("# first view after %.0f ms, last after %.0f ms\n", 1e3 * first, 1e3 * last);
    assert_true(first < 0.25 * last);

    struct streamed_parts parts = streamed_parts(&streamed);
    struct unzip unzip = {(const unsigned char *)archive.body, (const unsigned char *)archive.body + archive.size};
    struct streamed_part part;
    struct unzip_file file;
    int count = 0;
    for (; unzip_next(&unzip, &file); count++) {
        assert_true(streamed_next(&parts, &part));
        assert_string_equal(part.name, file.name);
        assert_string_equal(part.type, "image/png");
        assert_int_equal(part.size, file.size);
        assert_memory_equal(part.bytes, file.data, file.size);
    }
    assert_int_equal(count, 2 * VIEWS);
    assert_true(streamed_is_final(&parts));
    free(parts.body);
    streamed_end(&streamed);
    reply_free(&archive);
    daemon_stop(&server);
}

/* In an archive, arrays of all views are one, and an apng has all of them. */
TEST(no_files_are_joined)
{
    static const char SCENE[] = "{\"window\":{\"width\":20,\"height\":10}," GEOMETRY ",\"outputs\":[%s]%s}";
    static const char *const OUTPUTS[] = {DEPTH, "{\"channel\":\"color\",\"encoding\":\"apng\"}"};
    static const char *const NAMES[] = {"a.depth.npy", "a.color.apng"};
    struct daemon server = daemon_start(NULL);
    for (int i = 0; i < 2; i++) {
        char alone[512], several[512];
        struct streamed_part part;
        snprintf(alone, sizeof alone, SCENE, OUTPUTS[i], ",\"view\":{\"preset\":\"top\"}");
        snprintf(several, sizeof several, SCENE, OUTPUTS[i],
                 ",\"views\":[{\"name\":\"a\",\"view\":{\"preset\":\"top\"}},\"front\"]");
        struct reply reply = client_render(&server, alone);
        struct streamed streamed = streamed_begin(&server, several, 0);
        streamed_read_all(&streamed);
        struct streamed_parts parts = streamed_parts(&streamed);
        assert_true(streamed_next(&parts, &part));
        assert_string_equal(part.name, NAMES[i]);
        assert_int_equal(reply.status, 200);
        assert_int_equal(part.size, reply.size);
        assert_memory_equal(part.bytes, reply.body, part.size);
        free(parts.body);
        streamed_end(&streamed);
        reply_free(&reply);
    }
    daemon_stop(&server);
}

TEST(what_is_no_set_of_views_or_cannot_be_drawn_is_answered_as_ever)
{
    static const char *const SCENES[] = {GOOD_SCENE, "{\"views\":[\"top\",{\"view\":{\"eye\":1}}]," GEOMETRY "}"};
    static const char *const TYPES[] = {"\r\nContent-Type: image/png\r\n",
                                        "\r\nContent-Type: application/problem+json\r\n"};
    static const int STATUSES[] = {200, 422};
    struct daemon server = daemon_start(NULL);
    for (int i = 0; i < 2; i++) {
        struct streamed streamed = streamed_begin(&server, SCENES[i], 0);
        assert_true(streamed_read(&streamed));
        assert_int_equal(streamed.status, STATUSES[i]);
        assert_non_null(strstr(streamed.bytes, TYPES[i]));
        streamed_end(&streamed);
    }
    daemon_stop(&server);
}

/* ---- ends ---- */

TEST(work_that_takes_too_long_ends_with_a_problem_and_no_final_delimiter)
{
    char scene[1024];
    struct daemon server =
        daemon_start(LIST(IS_SANITIZED ? "--render-timeout-ms=8000" : "--render-timeout-ms=1000", ANY_COST));
    struct streamed streamed = streamed_begin(&server, scene_of(scene, 1000, 512, COLOR), 0);
    struct streamed_part part = {.size = 0};
    int count = 0;
    streamed_read_all(&streamed);
    struct streamed_parts parts = streamed_parts(&streamed);
    for (; streamed_next(&parts, &part); count++)
        continue;
    assert_true(count > 1 && count < 1000);
    assert_string_equal(part.type, "application/problem+json");
    assert_string_equal(part.name, "");
    assert_non_null(strstr(part.bytes, "\"status\":504"));
    assert_int_equal(parts.at, parts.size);
    assert_false(parts.is_whole);
    char *line = daemon_wait_for_log(&server, "renderTimeoutMs");
    assert_non_null(strstr(line, "\"status\":200,\"aborted\":true"));
    free(line);
    free(parts.body);
    streamed_end(&streamed);
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
    daemon_stop(&server);
}

/* Returns the time until the line of the log, which is written once no thread works on the request. */
static double time_of_leaving_ms(bool waits)
{
    char scene[1024];
    struct daemon server = daemon_start(LIST(LET_IN));
    struct streamed streamed = streamed_begin(&server, scene_of(scene, 1000, 512, waits ? COLOR "," DEPTH : COLOR), 0);
    struct tm time = {0};
    streamed_read_part(&streamed);
    if (waits) usleep(1000 * 1000);
    const double begun = seconds();
    streamed_end(&streamed);
    char *line = daemon_wait_for_log(&server, "the client left");
    const char *rest = strptime(line + strlen("{\"time\":\""), "%Y-%m-%dT%H:%M:%S", &time);
    assert_non_null(rest);
    const double ended = (double)timegm(&time) + atof(rest);
    free(line);
    daemon_stop(&server);
    return 1e3 * (ended - begun);
}

TEST(work_ends_within_100_ms_after_its_client_has_left)
{
    for (int waits = 0; waits < 2; waits++) { /* the thread draws, or waits for the reader */
        double least_ms = time_of_leaving_ms(waits);
        for (int i = 0; i < 4 && least_ms >= 100.0; i++) /* the machine may be busy */
            least_ms = fmin(least_ms, time_of_leaving_ms(waits));
        print_message("# ended %.0f ms after its client left\n", least_ms);
        if (!IS_SANITIZED) assert_true(least_ms < 100.0);
    }
}

/* ---- readers that do not read ---- */

TEST(streams_are_counted_and_one_that_waits_holds_no_worker)
{
    char scene[1024], small[1024];
    struct daemon server = daemon_start(LIST(LET_IN, "--workers=1", "--max-streams=1", "--drain-timeout-ms=100"));
    struct streamed streamed = streamed_begin(&server, scene_of(scene, 200, 512, DEPTH), 1 << 18);
    streamed_read_part(&streamed);
    usleep(300 * 1000); /* until it waits */
    scene_of(small, 10, 64, COLOR);
    struct reply large = client_render(&server, scene_of(scene, 20, 64, COLOR));
    assert_int_equal(large.status, 200);
    assert_string_equal(reply_header(&large, "Content-Type"), "application/zip");
    reply_free(&large);
    struct streamed second = streamed_begin(&server, small, 0);
    assert_true(streamed_read(&second));
    assert_int_equal(second.status, 503);
    streamed_end(&second);
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
    daemon_stop(&server); /* while it waits */
    streamed_end(&streamed);
}

static long peak_of(int views)
{
    char scene[1024];
    struct daemon server = daemon_start(LIST(LET_IN));
    struct streamed streamed = streamed_begin(&server, scene_of(scene, views, 64, COLOR), 0);
    streamed_read_all(&streamed);
    struct streamed_parts parts = streamed_parts(&streamed);
    struct streamed_part part;
    int count = 0;
    while (streamed_next(&parts, &part))
        count++;
    assert_int_equal(count, views);
    assert_true(streamed_is_final(&parts));
    free(parts.body);
    streamed_end(&streamed);
    const long peak = daemon_memory_kib(&server, "VmHWM:");
    daemon_stop(&server);
    return peak;
}

TEST(memory_does_not_grow_with_the_number_of_views)
{
    enum { FEW = 10, MANY = IS_SANITIZED ? 100 : 1000 };
    const long few = peak_of(FEW), many = peak_of(MANY);
    print_message("# %d views: %ld KiB, %d views: %ld KiB\n", FEW, few, MANY, many);
    if (!IS_SANITIZED) assert_true(5 * many <= 6 * few);
}

RUN_TESTS(NULL, NULL)
