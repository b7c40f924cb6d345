/* Requests that two readers could read in two ways, and how much of a header there may be. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "server/support/client.h"
#include "support/tests.h"

#define POST   "POST /v1/render HTTP/1.1\r\nHost: a\r\n" JSON_TYPE "\r\n"
#define SECOND "GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n"

enum { SILENCE_MS = 5000 };

static struct daemon server;

static int start(void **state)
{
    (void)state;
    server = daemon_start((const char *const[]){"--header-timeout-ms=400", "--body-timeout-ms=500",
                                                "--idle-timeout-ms=1500", "--max-per-client=0", NULL});
    return 0;
}

static int stop(void **state)
{
    (void)state;
    daemon_stop(&server);
    return 0;
}

/* Refused with `status` in our words, closed, and what follows on the connection is not answered. */
static void assert_bytes_refused(const char *request, size_t size, int status)
{
    char *text = client_raw(&server, request, size, SILENCE_MS);
    if (raw_status(text) != status || raw_count(text) != 1 || strstr(text, "\"status\":\"ok\"") ||
        !strstr(text, "Content-Type: application/problem+json") || !strstr(text, "X-Request-Id: ") ||
        (strstr(text, "Connection: close") == NULL))
        fail_msg("wanted %d and nothing more for\n%.200s\ngot\n%.400s", status, request, text);
    free(text);
    assert_int_equal(client_get_status(&server, "/healthz"), 200);
}

static void assert_refused(const char *request, int status)
{
    assert_bytes_refused(request, strlen(request), status);
}

TEST(two_content_lengths_are_refused)
{
    assert_refused(POST "Content-Length: 5\r\nContent-Length: 5\r\n\r\nhello" SECOND, 400);
    assert_refused(POST "Content-Length: 5\r\nContent-Length: 42\r\n\r\nhello" SECOND, 400);
    assert_refused("GET /healthz HTTP/1.1\r\nHost: a\r\nContent-Length: 1\r\nContent-Length: 1\r\n\r\na" SECOND, 400);
}

TEST(content_length_with_transfer_encoding_is_refused)
{
    assert_refused(POST "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n" SECOND, 400);
    assert_refused(POST "Transfer-Encoding: chunked\r\nContent-Length: 5\r\n\r\n0\r\n\r\n" SECOND, 400);
}

/* Sends bytes that end with SECOND, and reads to the end of its answer. */
static char *until_second(const char *bytes, size_t size)
{
    const int fd = client_connect(&server);
    assert_true(client_write(fd, bytes, size));
    char *text = client_read(fd, "\"ok\"", SILENCE_MS);
    close(fd);
    return text;
}

TEST(unknown_transfer_encoding_gives_501)
{
    assert_refused(POST "Transfer-Encoding: xchunked\r\n\r\n0\r\n\r\n" SECOND, 501);
    assert_refused(POST "Transfer-Encoding: gzip, chunked\r\n\r\n0\r\n\r\n" SECOND, 501);
}

TEST(two_transfer_encodings_are_refused)
{
    assert_refused(POST "Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n" SECOND, 400);
}

TEST(host_must_come_once)
{
    assert_refused("GET /healthz HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n" SECOND, 400);
    assert_refused("GET /healthz HTTP/1.1\r\n\r\n" SECOND, 400);
}

TEST(host_may_be_missing_in_http_1_0)
{
    static const char REQUEST[] = "GET /healthz HTTP/1.0\r\n\r\n";
    char *text = client_raw(&server, REQUEST, sizeof REQUEST - 1, SILENCE_MS);
    assert_int_equal(raw_status(text), 200);
    free(text);
}

TEST(content_length_that_is_no_number_is_refused)
{
    static const char *const LENGTHS[] = {"5x", "-5", "+5", "0x5", "5, 5", "5 5", "five"};
    char request[256];
    for (size_t i = 0; i < sizeof LENGTHS / sizeof LENGTHS[0]; i++) {
        snprintf(request, sizeof request, POST "Content-Length: %s\r\n\r\nhello" SECOND, LENGTHS[i]);
        assert_refused(request, 400);
    }
}

/* RFC 9112, 5: it is none of the value. */
TEST(space_behind_a_length_or_an_encoding_is_passed_over)
{
    static const char *const REQUESTS[] = {POST "Content-Length: 5 \t \r\n\r\nhello" SECOND,
                                           POST "Transfer-Encoding: chunked \t\r\n\r\n5\r\nhello\r\n0\r\n\r\n" SECOND};
    for (size_t i = 0; i < sizeof REQUESTS / sizeof REQUESTS[0]; i++) {
        char *text = until_second(REQUESTS[i], strlen(REQUESTS[i]));
        assert_int_equal(raw_status(text), 400);
        assert_non_null(strstr(text, "\"status\":\"ok\""));
        free(text);
    }
}

TEST(space_behind_an_expectation_is_passed_over)
{
    static const char HEAD[] = POST "Expect: 100-continue \r\nContent-Length:\t5\r\n\r\n", REST[] = "hello" SECOND;
    int fd = client_connect(&server);
    assert_true(client_write(fd, HEAD, sizeof HEAD - 1));
    char *text = client_read(fd, "\r\n\r\n", SILENCE_MS);
    assert_int_equal(raw_status(text), 100);
    free(text);
    assert_true(client_write(fd, REST, sizeof REST - 1));
    text = client_read(fd, "\"ok\"", SILENCE_MS);
    assert_int_equal(raw_status(text), 400);
    assert_non_null(strstr(text, "\"status\":\"ok\""));
    free(text);
    close(fd);
}

/* libmicrohttpd would keep it beside the header. */
TEST(a_trailer_has_room_beside_any_header)
{
    static char request[40000];
    int used = snprintf(request, sizeof request, POST "Transfer-Encoding: chunked\r\n");
    for (int trailer = 0; trailer < 2; trailer++) {
        for (int i = 0; i < 96; i++)
            used += snprintf(request + used, sizeof request - (size_t)used, "n%063d: v\r\n", i);
        if (!trailer) used += snprintf(request + used, sizeof request - (size_t)used, "%s", "\r\n5\r\nhello\r\n0\r\n");
    }
    used += snprintf(request + used, sizeof request - (size_t)used, "\r\n" SECOND);
    char *text = until_second(request, (size_t)used);
    assert_int_equal(raw_status(text), 400);
    assert_non_null(strstr(text, "\"status\":\"ok\""));
    free(text);
}

/* Its answer was made already: another takes its place. */
TEST(a_refused_body_that_comes_too_slowly_has_one_answer)
{
    static const char SLOW[] = "DELETE /healthz HTTP/1.1\r\nHost: a\r\nContent-Length: 5\r\n\r\na";
    char *text = client_raw(&server, SLOW, sizeof SLOW - 1, SILENCE_MS);
    assert_int_equal(raw_status(text), 408);
    const char *type = strstr(text, "\r\nContent-Type:");
    assert_non_null(type);
    assert_null(strstr(type + 1, "\r\nContent-Type:"));
    assert_null(strstr(text, "Allow"));
    free(text);
}

/* The header's time is 400 ms here. */
TEST(an_empty_line_begins_no_request)
{
    const int client = client_connect(&server);
    assert_true(client_write(client, SECOND, strlen(SECOND)));
    free(client_read(client, "ok\"}", SILENCE_MS));
    assert_true(client_write(client, "\r\n", 2));
    usleep(700000);
    assert_true(client_write(client, SECOND, strlen(SECOND)));
    char *text = client_read(client, "ok\"}", SILENCE_MS);
    assert_int_equal(raw_status(text), 200);
    free(text);
    close(client);
}

TEST(bad_bytes_in_headers_are_refused)
{
    assert_refused("GET /healthz HTTP/1.1\r\nHost: a\r\nX-A : b\r\n\r\n" SECOND, 400);
    assert_refused("GET /healthz HTTP/1.1\r\nHost: a\r\nX(A): b\r\n\r\n" SECOND, 400);
    assert_refused("GET /healthz HTTP/1.1\r\nHost: a\r\nX-A: b\x01\r\n\r\n" SECOND, 400);
    assert_refused("GET /heal thz HTTP/1.1\r\nHost: a\r\n\r\n" SECOND, 400);
    assert_refused("GET /healthz?a b HTTP/1.1\r\nHost: a\r\n\r\n" SECOND, 400);
}

#define BYTES(text, status) assert_bytes_refused(text, sizeof(text) - 1, status)

TEST(a_zero_byte_smuggles_nothing)
{
    BYTES(POST "Content-Length: 5\0\r\n\r\nhello" SECOND, 400);
    BYTES(POST "Content-Length: 5\0junk\r\n\r\nhello" SECOND, 400);
    BYTES(POST "Transfer-Encoding: chunked\0\r\n\r\n0\r\n\r\n" SECOND, 400);
    BYTES(POST "Content-Length\0: 5\r\n\r\nhello" SECOND, 400);
    BYTES("GET /healthz\0 HTTP/1.1\r\nHost: a\r\n\r\n" SECOND, 400);
    BYTES("GET /healthz HTTP/1.1\r\nHost: a\r\nX: \0\r\n\r\n" SECOND, 400);
    BYTES("\0GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n" SECOND, 400);
}

TEST(line_ends_other_than_crlf_are_refused)
{
    assert_refused("GET /healthz HTTP/1.1\nHost: a\n\n" SECOND, 400);
    assert_refused("GET /healthz HTTP/1.1\r\nHost: a\nX: y\r\n\r\n" SECOND, 400);
    assert_refused("GET /healthz HTTP/1.1\r\nHost: a\rX: y\r\n\r\n" SECOND, 400);
    assert_refused("GET /healthz HTTP/1.1\r\nHost: a\r\n\n" SECOND, 400);
    assert_refused("GET /healthz HTTP/1.1\r\nHost: a\r\nX: y\r\n folded\r\n\r\n" SECOND, 400);
    assert_refused(POST "Transfer-Encoding: chunked\r\n\r\n5\nhello\r\n0\r\n\r\n" SECOND, 400);
    assert_refused(POST "Transfer-Encoding: chunked\r\n\r\n5\r\nhello\n0\r\n\r\n" SECOND, 400);
    assert_refused(POST "Transfer-Encoding: chunked\r\n\r\n0\r\n\n" SECOND, 400);
}

TEST(request_lines_that_are_none_are_refused)
{
    assert_refused("GET /healthz\r\n\r\n" SECOND, 400);
    assert_refused("GET /healthz HTTP/2.0\r\nHost: a\r\n\r\n" SECOND, 505);
    assert_refused("GET /healthz HTTP/1.1 x\r\nHost: a\r\n\r\n" SECOND, 400);
    assert_refused("GET /healthz\x01 HTTP/1.1\r\nHost: a\r\n\r\n" SECOND, 400);
    assert_refused("G(T /healthz HTTP/1.1\r\nHost: a\r\n\r\n" SECOND, 400);
    assert_refused("\x16\x03\x01\x02", 400);
}

TEST(two_content_types_are_refused)
{
    assert_refused(POST "Content-Type: model/obj\r\nContent-Length: 2\r\n\r\n{}" SECOND, 400);
}

/* What a fault is found in has been passed on by then, or the requests before it are still to be answered. */
TEST(a_fault_behind_good_requests_or_in_small_pieces_is_refused)
{
    static const char *const FAULTS[] = {"GET /healthz HTTP/1.1\r\nHost: a\r\nX : y\r\n\r\n" SECOND,
                                         POST "Transfer-Encoding: chunked\r\n\r\n3\r\nabc\r\n-\r\n" SECOND};
    for (size_t i = 0; i < sizeof FAULTS / sizeof FAULTS[0]; i++)
        for (int good = 0; good < 3; good++)
            for (int in_pieces = 0; in_pieces < 2; in_pieces++) {
                char request[1000] = "";
                for (int j = 0; j < good; j++)
                    strcat(request, SECOND);
                strcat(request, FAULTS[i]);
                int fd = client_connect(&server);
                const size_t size = strlen(request), step = in_pieces ? 1 : size;
                for (size_t at = 0; at < size && client_write(fd, request + at, step); at += step)
                    if (in_pieces) usleep(200);
                char *text = client_read(fd, NULL, SILENCE_MS);
                if (raw_count(text) != good + 1 || !strstr(text, "HTTP/1.1 400 "))
                    fail_msg("%d good, then\n%s\ngave\n%s", good, FAULTS[i], text);
                free(text);
                close(fd);
            }
}

static void assert_pieces_refused(const char *front, size_t filler, const char *middle, int chunks, const char *back,
                                  int status)
{
    enum { ROOM = 1 << 17 };
    char *text = malloc(ROOM);
    assert_non_null(text);
    int used = snprintf(text, ROOM, "%s", front);
    memset(text + used, 'y', filler);
    used += (int)filler;
    used += snprintf(text + used, ROOM - (size_t)used, "%s", middle);
    for (int i = 0; i < chunks; i++)
        used += snprintf(text + used, ROOM - (size_t)used, "1\r\na\r\n");
    used += snprintf(text + used, ROOM - (size_t)used, "%s" SECOND, back);
    assert_bytes_refused(text, (size_t)used, status);
    free(text);
}

/* The fault is there before libmicrohttpd has said that it has the header: nothing more will come then. */
TEST(a_fault_close_behind_a_header_is_refused)
{
    assert_pieces_refused(POST "Transfer-Encoding: chunked\r\n\r\n2\r\n{}\r\n0\r\nX: ", 33000, "\r\n\r\n", 0, "", 431);
    assert_pieces_refused("POST /v1/render HTTP/1.1\r\nHost: a\r\nX: ", 32000,
                          "\r\n" JSON_TYPE "\r\nTransfer-Encoding: chunked\r\n\r\n", 120, "ZZ\r\n", 400);
    assert_pieces_refused("POST /v1/render HTTP/1.1\r\nHost: a\r\nX: ", 0,
                          "\r\n" JSON_TYPE "\r\nTransfer-Encoding: chunked\r\n\r\n", 6000, "ZZ\r\n", 400);
}

/* What is refused in the body of the second request is no fault of the first. */
TEST(a_fault_in_a_later_body_leaves_earlier_answers)
{
    static const char REQUESTS[] = SECOND POST "Transfer-Encoding: chunked\r\n\r\n2\r\n{}\r\nZZ\r\n";
    char *text = client_raw(&server, REQUESTS, sizeof REQUESTS - 1, SILENCE_MS);
    assert_int_equal(raw_status(text), 200);
    assert_int_equal(raw_count(text), 2);
    assert_non_null(strstr(text, "HTTP/1.1 400 "));
    free(text);
}

TEST(many_empty_lines_are_refused)
{
    static const char EMPTY[] = "\r\n\r\n\r\n\r\n\r\n\r\n\r\n\r\n\r\n\r\n\r\n\r\n\r\n\r\n\r\n\r\n";
    char text[256];
    snprintf(text, sizeof text, "%s\r\n" SECOND, EMPTY);
    assert_refused(text, 400);
    snprintf(text, sizeof text, "%s" SECOND, EMPTY);
    char *answer = until_second(text, strlen(text));
    assert_int_equal(raw_status(answer), 200);
    free(answer);
}

TEST(a_refusal_of_head_has_no_body)
{
    static const char REQUEST[] = "HEAD /healthz HTTP/1.1\r\nHost: a\r\nContent-Length: 99999999999\r\n\r\n";
    char *text = client_raw(&server, REQUEST, sizeof REQUEST - 1, SILENCE_MS);
    assert_int_equal(raw_status(text), 413);
    const char *end = strstr(text, "\r\n\r\n");
    assert_true(end && end[4] == '\0');
    free(text);
}

/* Bytes after the last request are no request. */
TEST(bytes_after_the_last_request_get_no_answer)
{
    static const char *const LAST[] = {"GET /healthz HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\nBAD\r\n\r\n",
                                       "GET /healthz HTTP/1.0\r\n\r\nBAD\r\n\r\n"};
    for (size_t i = 0; i < sizeof LAST / sizeof LAST[0]; i++) {
        char *text = client_raw(&server, LAST[i], strlen(LAST[i]), SILENCE_MS);
        assert_int_equal(raw_status(text), 200);
        assert_int_equal(raw_count(text), 1);
        free(text);
    }
}

/* What is promised fits into the memory that libmicrohttpd has for a connection. */
TEST(headers_as_large_as_they_may_be_are_answered)
{
    static char request[80000];
    /* Targets, names and values of 8192, 64 and 4096 bytes, a hundred lines, 32 parameters more than one. */
    size_t used = (size_t)sprintf(request, "GET /nowhere?");
    for (int i = 0; i < 32; i++)
        used += (size_t)sprintf(request + used, "a=b&");
    memset(request + used, 'a', 8030);
    used += 8030;
    used += (size_t)sprintf(request + used,
                            " HTTP/1.1\r\nHost: a\r\nConnection: close\r\nAuthorization: Bearer %04000d\r\n", 1);
    for (int i = 0; i < 97; i++)
        used += (size_t)sprintf(request + used, "X-%062d: %0160d\r\n", i, i);
    sprintf(request + used, "\r\n");
    char *text = client_raw(&server, request, strlen(request), SILENCE_MS);
    assert_int_equal(raw_status(text), 404);
    free(text);
}

TEST(large_cookies_are_answered)
{
    static char request[40000];
    for (int kind = 0; kind < 2; kind++) {
        size_t used = (size_t)sprintf(request, "GET /healthz HTTP/1.1\r\nHost: a\r\nConnection: close\r\nCookie: ");
        for (int i = 0; i < 8000; i++)
            used += (size_t)sprintf(request + used, kind ? "a=b;" : "abcd");
        sprintf(request + used, "\r\n\r\n");
        char *text = client_raw(&server, request, strlen(request), SILENCE_MS);
        assert_int_equal(raw_status(text), 200);
        free(text);
    }
}

/* `prefix`, `count` times 'a', the end of a header. */
static void assert_large_refused(const char *prefix, size_t count, const char *suffix, int status)
{
    char *request = malloc(strlen(prefix) + count + strlen(suffix) + 1);
    assert_non_null(request);
    strcpy(request, prefix);
    memset(request + strlen(prefix), 'a', count);
    strcpy(request + strlen(prefix) + count, suffix);
    assert_refused(request, status);
    free(request);
}

TEST(header_too_large_gives_431)
{
    assert_large_refused("GET /healthz HTTP/1.1\r\nHost: a\r\nX-A: ", 33000, "\r\n\r\n", 431);
    assert_large_refused("GET /healthz HTTP/1.1\r\nHost: a\r\nX-A: ", 300000, "\r\n\r\n", 431);
}

TEST(uri_too_large_gives_414)
{
    assert_large_refused("GET /", 33000, " HTTP/1.1\r\nHost: a\r\n\r\n", 414);
    assert_large_refused("GET /healthz?a=", 33000, " HTTP/1.1\r\nHost: a\r\n\r\n", 414);
    assert_large_refused("GET /", 300000, " HTTP/1.1\r\nHost: a\r\n\r\n", 414);
}

TEST(kept_connection_answers_pipelined_requests)
{
    static const char REQUESTS[] = SECOND SECOND "POST /nowhere HTTP/1.1\r\nHost: a\r\nContent-Length: 3\r\n\r\nabc"
                                                 "GET /healthz HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n";
    char *text = client_raw(&server, REQUESTS, sizeof REQUESTS - 1, SILENCE_MS);
    assert_int_equal(raw_count(text), 4);
    free(text);
}

TEST(every_refusal_is_logged_with_its_status)
{
    static const char *const DETAILS[] = {
        "\"status\":400,\"bytesIn\":0,\"bytesOut\":97", /* more than one Content-Length */
        "\"status\":501",
        "\"status\":431",
        "\"status\":414",
    };
    for (size_t i = 0; i < sizeof DETAILS / sizeof DETAILS[0]; i++)
        free(daemon_wait_for_log(&server, DETAILS[i]));
}

RUN_TESTS(start, stop)
