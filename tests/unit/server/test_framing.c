/* Which bytes of a connection are passed on, and which are refused: whole, and byte by byte. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "http/framing.h"
#include "support/random.h"
#include "support/tests.h"

#define GET    "GET / HTTP/1.1\r\nHost: a\r\n"
#define POST   "POST / HTTP/1.1\r\nHost: a\r\n"
#define SECOND "GET /second HTTP/1.1\r\nHost: a\r\n\r\n"
#define CHUNK  POST "Transfer-Encoding: chunked\r\n\r\n"

enum { COPY_SIZE = 200000 };

/* Scans `text` in pieces of `step` bytes; how many bytes were passed on until one was refused. */
static size_t scan(struct framing *framing, const char *text, size_t size, size_t step)
{
    static char copy[COPY_SIZE];
    size_t passed = 0;
    assert_true(size <= sizeof copy);
    memcpy(copy, text, size);
    *framing = (struct framing){0};
    for (size_t at = 0; at < size && framing->status == 0; at += step) {
        const size_t count = size - at < step ? size - at : step;
        const size_t taken = framing_scan(framing, copy + at, count);
        assert_true(taken <= count);
        passed += taken;
    }
    return passed;
}

/* Refused, whatever the pieces: nothing behind the refused byte passes, and no more requests than `passed`. */
static void assert_refused(const char *text, size_t size, int status, const char *detail, uint64_t passed)
{
    for (size_t step = 1; step <= size; step = step == 1 ? 2 : step == 2 ? 7 : step == size ? size + 1 : size) {
        struct framing framing;
        scan(&framing, text, size, step);
        if (framing.status != status || !strstr(framing.detail, detail))
            fail_msg("wanted %d %s, got %d %s in steps of %zu for\n%s", status, detail, framing.status,
                     framing.detail ? framing.detail : "nothing", step, text);
        assert_int_equal(framing.passed, passed);
        assert_int_equal(framing_scan(&framing, (char[]){"GET /"}, 5), 0);
    }
}

static void assert_passes(const char *text, uint64_t passed)
{
    for (size_t step = 1; step <= strlen(text); step = step == 1 ? 3 : step == 3 ? strlen(text) : step + 1) {
        struct framing framing;
        const size_t taken = scan(&framing, text, strlen(text), step);
        if (framing.status) fail_msg("refused with %d %s:\n%s", framing.status, framing.detail, text);
        assert_true(taken <= strlen(text));
        assert_int_equal(framing.passed, passed);
        assert_true(framing_is_between(&framing));
    }
}

TEST(whole_requests_pass)
{
    assert_passes(GET "\r\n", 1);
    assert_passes(GET "\r\n" SECOND SECOND, 3);
    assert_passes("\r\n" GET "\r\n\r\n" SECOND, 2);
    assert_passes("GET / HTTP/1.0\r\n\r\n", 1);
    assert_passes("HEAD /a%20b?c=d&e=f HTTP/1.1\r\nhost:a\r\nX: \t y \t z \t\r\nEmpty:\r\n\r\n", 1);
    assert_passes(POST "Content-Length: 5\r\n\r\nhello" SECOND, 2);
    assert_passes(POST "Content-Length:\t05 \r\n\r\nGET /" SECOND, 2);
    assert_passes(POST "Content-Length: 0\r\n\r\n" SECOND, 2);
    assert_passes(POST "Expect: 100-Continue\r\nContent-Length: 1\r\n\r\na", 1);
    assert_passes(CHUNK "0\r\n\r\n" SECOND, 2);
    assert_passes(CHUNK "5\r\nhello\r\n00A\r\n0123456789\r\n0\r\n\r\n" SECOND, 2);
    assert_passes(CHUNK "5;a=\"b;c\"\r\nhello\r\n0;x\r\nTrailer: x\r\nContent-Length: 9\r\n\r\n" SECOND, 2);
    assert_passes(POST "transfer-encoding: CHUNKED \r\n\r\n3\r\n\r\n\r\r\n0\r\n\r\n", 1);
    assert_passes("GET /\xc3\xa9 HTTP/1.1\r\nHost: a\r\nX: \xff\xfe\r\n\r\n", 1);
    assert_passes(GET "Accept: a\r\nAccept: b\r\nForwarded: for=a\r\nForwarded: for=b\r\nX: y\r\nX: y\r\n\r\n", 1);
}

struct fault {
    const char *text;
    int status;
    const char *detail;
    uint64_t passed;
};

TEST(faults_are_refused_with_status_and_reason)
{
    static const struct fault FAULTS[] = {
        /* the request line */
        {"GET /\r\n", 400, "no version", 0},
        {"GET / HTTP/1.1\n", 400, "LF alone", 0},
        {"GET  / HTTP/1.1\r\n", 400, "request line", 0},
        {"GET / a HTTP/1.1\r\n", 400, "space", 0},
        {"GET / HTTP/1.1 \r\n", 400, "space", 0},
        {"GET / http/1.1\r\n", 400, "version", 0},
        {"GET / HTTP/1\r\n", 400, "version", 0},
        {"GET / HTTP/2.0\r\n", 505, "1.1 and 1.0", 0},
        {"GET / HTTP/1.2\r\n", 505, "1.1 and 1.0", 0},
        {"GET /\x01 HTTP/1.1\r\n", 400, "control", 0},
        {"GET /\x7f HTTP/1.1\r\n", 400, "control", 0},
        {"GET\t/ HTTP/1.1\r\n", 400, "request line", 0},
        {"G@T / HTTP/1.1\r\n", 400, "request line", 0},
        {" GET / HTTP/1.1\r\n", 400, "request line", 0},
        {"\n" GET "\r\n", 400, "request line", 0},
        {"\r" GET "\r\n", 400, "CR without LF", 0},
        {"AAAAAAAAAAAAAAAAAAAAAAAAAAAA / HTTP/1.1\r\n", 501, "method", 0},
        {"\x16\x03\x01", 400, "TLS", 0},
        {"GET / HTTP/1.1\rHost: a\r\n", 400, "CR without LF", 0},
        /* header lines */
        {GET "A: b\n\r\n", 400, "LF alone", 0},
        {GET "A: b\r\n\n", 400, "LF alone", 0},
        {GET "A: b\rC: d\r\n", 400, "CR without LF", 0},
        {GET "\rA", 400, "CR without LF", 0},
        {GET "A: b\r\n c\r\n", 400, "folded", 0},
        {GET " A: b\r\n", 400, "folded", 0},
        {GET "\tA: b\r\n", 400, "folded", 0},
        {GET "A b\r\n", 400, "token", 0},
        {GET "A\r\n", 400, "colon", 0},
        {GET "A : b\r\n", 400, "token", 0},
        {GET ": b\r\n", 400, "token", 0},
        {GET "A(: b\r\n", 400, "token", 0},
        {GET "A: b\x01\r\n", 400, "control", 0},
        {GET "A: b\x7f\r\n", 400, "control", 0},
        {GET "A: \v\r\n", 400, "control", 0},
        /* who and what */
        {"GET / HTTP/1.1\r\n\r\n", 400, "Host", 0},
        {GET "Host: a\r\n\r\n", 400, "Host", 0},
        {"GET / HTTP/1.0\r\nHost: a\r\nHost: a\r\n\r\n", 400, "Host", 0},
        {POST "Content-Type: a\r\nContent-Type: b\r\n\r\n", 400, "Content-Type", 0},
        {POST "Expect: 200-ok\r\n\r\n", 417, "100-continue", 0},
        {POST "Expect: 100-continue\r\nExpect: 100-continue\r\n\r\n", 400, "more than one Expect", 0},
        {GET "Authorization: a\r\nAuthorization: a\r\n\r\n", 400, "more than one Authorization", 0},
        {GET "authorization:\r\nX: y\r\nAUTHORIZATION: b\r\n\r\n", 400, "more than one Authorization", 0},
        {POST "Sec-Fetch-Site: none\r\nSec-Fetch-Site: cross-site\r\n\r\n", 400, "more than one Sec-Fetch-Site", 0},
        {POST "Origin: a\r\nOrigin: b\r\n\r\n", 400, "more than one Origin", 0},
        {POST "Content-Encoding: gzip\r\nContent-Encoding: gzip\r\n\r\n", 400, "more than one Content-Encoding", 0},
        {GET "If-None-Match: a\r\nIf-None-Match: b\r\n\r\n", 400, "more than one If-None-Match", 0},
        {POST "MCP-Protocol-Version: a\r\nMcp-Protocol-Version: b\r\n\r\n", 400, "more than one MCP-Protocol", 0},
        {POST "Mcp-Method: a\r\nMcp-Method: b\r\n\r\n", 400, "more than one Mcp-Method", 0},
        {POST "Mcp-Name: a\r\nMcp-Name: b\r\n\r\n", 400, "more than one Mcp-Name", 0},
        /* how long the body is */
        {POST "Content-Length: 5\r\nContent-Length: 5\r\n\r\n", 400, "more than one Content-Length", 0},
        {POST "content-length: 5\r\nX: y\r\nCONTENT-LENGTH: 6\r\n\r\n", 400, "more than one Content-Length", 0},
        {POST "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n", 400, "both", 0},
        {POST "Transfer-Encoding: chunked\r\nContent-Length: 5\r\n\r\n", 400, "both", 0},
        {POST "Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n\r\n", 400, "more than one Transfer", 0},
        {POST "Transfer-Encoding: identity\r\nTransfer-Encoding: chunked\r\n\r\n", 400, "more than one Transfer", 0},
        {POST "Transfer-Encoding: xchunked\r\n\r\n", 501, "chunked", 0},
        {POST "Transfer-Encoding: chunkedchunkedchunkedchunked\r\n\r\n", 501, "chunked", 0},
        {POST "Transfer-Encoding: gzip, chunked\r\n\r\n", 501, "chunked", 0},
        {POST "Transfer-Encoding: chunked, chunked\r\n\r\n", 501, "chunked", 0},
        {POST "Transfer-Encoding: chunked;q=1\r\n\r\n", 501, "chunked", 0},
        {POST "Transfer-Encoding:\r\n\r\n", 501, "chunked", 0},
        {"POST / HTTP/1.0\r\nTransfer-Encoding: chunked\r\n\r\n", 400, "HTTP/1.0", 0},
        {POST "Content-Length:\r\n\r\n", 400, "not a number", 0},
        {POST "Content-Length: +5\r\n\r\n", 400, "not a number", 0},
        {POST "Content-Length: -5\r\n\r\n", 400, "not a number", 0},
        {POST "Content-Length: 0x5\r\n\r\n", 400, "not a number", 0},
        {POST "Content-Length: 5 5\r\n\r\n", 400, "not a number", 0},
        {POST "Content-Length: 5, 5\r\n\r\n", 400, "not a number", 0},
        {POST "Content-Length: 5;\r\n\r\n", 400, "not a number", 0},
        {POST "Content-Length: 18446744073709551616\r\n\r\n", 400, "not a number", 0},
        {POST "Content-Length: 0000000000000000000000000000005\r\n\r\n", 400, "not a number", 0},
        /* chunks: the header has passed where the pieces are small, and so only whole pieces are tried here */
        {GET "\r\n" POST "Content-Length: 5\r\nContent-Length: 5\r\n\r\n", 400, "more than one", 1},
        {GET "\r\n" SECOND "\x01", 400, "request line", 2},
    };
    for (size_t i = 0; i < sizeof FAULTS / sizeof FAULTS[0]; i++)
        assert_refused(FAULTS[i].text, strlen(FAULTS[i].text), FAULTS[i].status, FAULTS[i].detail, FAULTS[i].passed);
}

TEST(a_zero_byte_is_refused_wherever_it_stands_before_a_body)
{
    static const char REQUEST[] = POST "Content-Length: 5\r\nTransfer: chunked\r\n\r\n";
    for (size_t at = 0; at < sizeof REQUEST - 1; at++) {
        char text[sizeof REQUEST + 1];
        memcpy(text, REQUEST, at);
        text[at] = '\0';
        memcpy(text + at + 1, REQUEST + at, sizeof REQUEST - at);
        struct framing framing;
        assert_int_equal(scan(&framing, text, sizeof text - 1, sizeof text - 1), 0);
        assert_true(framing.status == 400);
    }
}

TEST(faults_in_chunks_are_those_of_a_body)
{
    static const struct fault FAULTS[] = {
        {"x\r\n", 400, "hexadecimal", 1},
        {"\r\n", 400, "hexadecimal", 1},
        {" 5\r\n", 400, "hexadecimal", 1},
        {"5 \r\n", 400, "hexadecimal", 1},
        {"0x5\r\n", 400, "hexadecimal", 1},
        {"-1\r\n", 400, "hexadecimal", 1},
        {"5\nhello", 400, "hexadecimal", 1},
        {"5\rhello", 400, "CR without LF", 1},
        {"5;a\nhello", 400, "LF alone", 1},
        {"5;\x01\r\n", 400, "control", 1},
        {"00000000000000001\r\n", 400, "digits", 1},
        {"5\r\nhello!\r\n", 400, "longer than its size", 1},
        {"5\r\nhello\n", 400, "longer than its size", 1},
        {"5\r\nhello\r0", 400, "CR without LF", 1},
        {"0\r\nTrailer : x\r\n", 400, "token", 1},
        {"0\r\n\n", 400, "LF alone", 1},
    };
    for (size_t i = 0; i < sizeof FAULTS / sizeof FAULTS[0]; i++) {
        struct framing framing = {0};
        char header[] = CHUNK, rest[64];
        assert_int_equal(framing_scan(&framing, header, sizeof header - 1), sizeof header - 1);
        const size_t size = (size_t)snprintf(rest, sizeof rest, "%s", FAULTS[i].text);
        framing_scan(&framing, rest, size);
        if (framing.status != FAULTS[i].status || !strstr(framing.detail, FAULTS[i].detail))
            fail_msg("%s: %d %s", FAULTS[i].text, framing.status, framing.detail ? framing.detail : "");
        assert_true(framing.refused_body);
        assert_int_equal(framing.passed, 1);

        /* All at once, its header is held back with it. */
        char all[sizeof header + sizeof rest];
        snprintf(all, sizeof all, CHUNK "%s", FAULTS[i].text);
        assert_int_equal(scan(&framing, all, strlen(all), strlen(all)), 0);
        assert_false(framing.refused_body);
        assert_int_equal(framing.passed, 0);
    }
}

/* `prefix`, `count` bytes of `filler`, and `suffix`. */
static int status_of_long(const char *prefix, char filler, size_t count, const char *suffix)
{
    static char text[COPY_SIZE];
    struct framing framing;
    size_t used = (size_t)sprintf(text, "%s", prefix);
    memset(text + used, filler, count);
    used += count;
    used += (size_t)sprintf(text + used, "%s", suffix);
    scan(&framing, text, used, 1000);
    return framing.status;
}

TEST(limits_hold_to_the_byte)
{
    static char text[COPY_SIZE];
    struct framing framing;
    assert_int_equal(status_of_long("GET /", 'a', FRAMING_TARGET_MAX - 1, " HTTP/1.1\r\nHost: a\r\n\r\n"), 0);
    assert_int_equal(status_of_long("GET /", 'a', FRAMING_TARGET_MAX, " HTTP/1.1\r\nHost: a\r\n\r\n"), 414);
    /* "Host: a\r\n", "X:", "\r\n" and the CR of the last line are header bytes, too. */
    assert_int_equal(status_of_long(GET "X:", 'a', FRAMING_HEADERS_MAX - 14, "\r\n\r\n"), 0);
    assert_int_equal(status_of_long(GET "X:", 'a', FRAMING_HEADERS_MAX - 13, "\r\n\r\n"), 431);
    assert_int_equal(status_of_long(GET, 'a', FRAMING_NAME_MAX, ":b\r\n\r\n"), 0);
    assert_int_equal(status_of_long(GET, 'a', FRAMING_NAME_MAX + 1, ":b\r\n\r\n"), 431);
    /* " a" of the Host. */
    assert_int_equal(status_of_long(GET "Authorization:", 'a', FRAMING_VALUES_MAX - 2, "\r\n\r\n"), 0);
    assert_int_equal(status_of_long(GET "Authorization:", 'a', FRAMING_VALUES_MAX - 1, "\r\n\r\n"), 431);
    assert_int_equal(status_of_long("GET /?", '&', FRAMING_PARAMETERS_MAX, " HTTP/1.1\r\nHost: a\r\n\r\n"), 0);
    assert_int_equal(status_of_long("GET /?", '&', FRAMING_PARAMETERS_MAX + 1, " HTTP/1.1\r\nHost: a\r\n\r\n"), 400);
    assert_int_equal(status_of_long(CHUNK "0;", 'a', FRAMING_EXTENSION_MAX, "\r\n\r\n"), 0);
    assert_int_equal(status_of_long(CHUNK "0;", 'a', FRAMING_EXTENSION_MAX + 1, "\r\n\r\n"), 400);
    assert_int_equal(status_of_long(CHUNK "0\r\nX:", 'a', FRAMING_HEADERS_MAX, "\r\n\r\n"), 431);
    for (int fields = FRAMING_FIELDS_MAX; fields <= FRAMING_FIELDS_MAX + 1; fields++) {
        size_t used = (size_t)sprintf(text, GET);
        for (int i = 1; i < fields; i++)
            used += (size_t)sprintf(text + used, "A:\r\n");
        used += (size_t)sprintf(text + used, "\r\n");
        scan(&framing, text, used, used);
        assert_int_equal(framing.status, fields <= FRAMING_FIELDS_MAX ? 0 : 431);
    }
}

TEST(values_that_nobody_reads_go_no_further)
{
    static const char REQUEST[] = POST
        "Cookie: a=b; c\r\nX-Request-Id: i\r\nhosts: d\r\ncontent-TYPE: e\r\nContent-Length: 4 \t\r\n\r\nA: b" CHUNK
        "0\r\nTrailer: a\r\nHost: b\r\n\r\n" SECOND;
    static const char WANTED[] =
        POST "Cookie:\r\nX-Request-Id: i\r\nhosts:\r\ncontent-TYPE: e\r\nContent-Length: 4\r\n\r\nA: b" CHUNK
             "0\r\n\r\n" SECOND;
    for (size_t step = 1; step <= sizeof REQUEST - 1; step++) {
        char text[sizeof REQUEST], out[sizeof REQUEST] = "";
        struct framing framing = {0};
        size_t used = 0;
        memcpy(text, REQUEST, sizeof text);
        for (size_t at = 0; at < sizeof text - 1; at += step) {
            const size_t passed =
                framing_scan(&framing, text + at, sizeof text - 1 - at < step ? sizeof text - 1 - at : step);
            memcpy(out + used, text + at, passed);
            used += passed;
        }
        assert_string_equal(out, WANTED);
        assert_int_equal(framing.passed, 3);
    }
}

TEST(good_bytes_before_a_fault_pass_and_none_behind_it)
{
    static const char TEXT[] = SECOND SECOND GET "A : b\r\n\r\n" SECOND;
    struct framing framing;
    assert_int_equal(scan(&framing, TEXT, sizeof TEXT - 1, sizeof TEXT - 1), 2 * strlen(SECOND));
    assert_int_equal(framing.passed, 2);
}

/* Whatever the bytes and however they are cut: the same verdict, and the same number of requests where nothing is
 * refused. */
TEST(random_bytes_get_the_same_verdict_in_any_pieces)
{
    static const char *const PARTS[] = {GET,
                                        POST,
                                        "\r\n",
                                        "\r",
                                        "\n",
                                        "Content-Length: 3\r\n",
                                        "Transfer-Encoding: chunked\r\n",
                                        "3\r\nabc\r\n",
                                        "0\r\n",
                                        "A: b\r\n",
                                        " ",
                                        "\t",
                                        "abc",
                                        "Host: b\r\n",
                                        ":",
                                        ";",
                                        "\x01",
                                        "Cookie: c\r\n"};
    struct random random = random_seeded(20);
    int refused = 0, fine = 0;
    for (int round = 0; round < 200000; round++) {
        char text[400] = GET;
        size_t used = strlen(text);
        for (uint32_t parts = random_below(&random, 8); parts > 0; parts--) {
            const char *part = PARTS[random_below(&random, sizeof PARTS / sizeof PARTS[0])];
            used += (size_t)sprintf(text + used, "%s", part);
        }
        struct framing whole, cut;
        scan(&whole, text, used, used);
        scan(&cut, text, used, 1 + random_below(&random, 9));
        assert_int_equal(whole.status, cut.status);
        assert_ptr_equal(whole.detail, cut.detail);
        if (whole.status == 0) assert_true(whole.passed == cut.passed && whole.state == cut.state);
        refused += whole.status != 0;
        fine += whole.status == 0 && framing_is_between(&whole);
    }
    assert_true(refused > 10000 && fine > 1000);
}

RUN_TESTS(NULL, NULL)
