/* Clients that are slow, and connections that are kept. */
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "server/support/client.h"
#include "support/tests.h"

#define POST   "POST /v1/render HTTP/1.1\r\nHost: a\r\n" JSON_TYPE "\r\n"
#define HEALTH "GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n"

enum { SILENCE_MS = 5000 };

static struct daemon server;

static int start(void **state)
{
    (void)state;
    server = daemon_start(LIST("--header-timeout-ms=400", "--body-timeout-ms=500", "--idle-timeout-ms=1500"));
    return 0;
}

static int stop(void **state)
{
    (void)state;
    daemon_stop(&server);
    return 0;
}

/* Sends a byte every 50 ms, so that the connection is never silent. */
static void assert_dripping_ends_with_408(const char *begin, double within_s)
{
    struct timespec begun, now;
    clock_gettime(CLOCK_MONOTONIC, &begun);
    int fd = client_connect(&server);
    assert_true(fd >= 0);
    assert_true(write(fd, begin, strlen(begin)) > 0);
    char *text = NULL;
    for (int i = 0; i < 60; i++) {
        free(text);
        text = client_read(fd, NULL, 50);
        if (*text) break;
        assert_int_equal(write(fd, "a", 1), 1);
    }
    clock_gettime(CLOCK_MONOTONIC, &now);
    assert_int_equal(raw_status(text), 408);
    double took = (double)(now.tv_sec - begun.tv_sec) + (double)(now.tv_nsec - begun.tv_nsec) / 1e9;
    assert_true(took < within_s);
    free(text);
    close(fd);
}

TEST(slow_header_gives_408)
{
    assert_dripping_ends_with_408("GET /healthz HTTP/1.1\r\nX-A: ", 1.5);
}

TEST(slow_body_gives_408)
{
    assert_dripping_ends_with_408(POST "Content-Length: 1000\r\n\r\n", 1.8);
}

TEST(body_below_its_least_speed_gives_408)
{
    static const char REQUEST[] = POST "Content-Length: 1000\r\n\r\n";
    struct daemon other = daemon_start((const char *const[]){"--body-timeout-ms=60000", NULL});
    int fd = client_connect(&other);
    assert_true(write(fd, REQUEST, sizeof REQUEST - 1) > 0);
    char *text = client_read(fd, NULL, 15000);
    assert_int_equal(raw_status(text), 408);
    free(text);
    close(fd);
    daemon_stop(&other);
}

TEST(slow_header_on_kept_connection_ends_it)
{
    int fd = client_connect(&server);
    assert_true(write(fd, HEALTH, strlen(HEALTH)) > 0);
    char *text = client_read(fd, "ok\"}", SILENCE_MS);
    assert_int_equal(raw_status(text), 200);
    free(text);
    assert_true(write(fd, "GET /", 5) == 5);
    text = client_read(fd, NULL, SILENCE_MS);
    assert_int_equal(raw_status(text), 408);
    free(text);
    close(fd);
}

TEST(idle_connection_outlives_header_timeout_and_ends)
{
    int fd = client_connect(&server);
    assert_true(write(fd, HEALTH, strlen(HEALTH)) > 0);
    free(client_read(fd, "ok\"}", SILENCE_MS));
    usleep(900 * 1000);
    assert_true(write(fd, HEALTH, strlen(HEALTH)) > 0);
    char *text = client_read(fd, "ok\"}", SILENCE_MS);
    assert_int_equal(raw_status(text), 200);
    free(text);
    text = client_read(fd, NULL, SILENCE_MS);
    assert_string_equal(text, "");
    free(text);
    close(fd);
}

TEST(slow_clients_are_logged)
{
    free(daemon_wait_for_log(&server, "\"status\":408"));
}

RUN_TESTS(start, stop)
