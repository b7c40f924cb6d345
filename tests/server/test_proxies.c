/* Proxies that name their clients, and strangers who pretend to be one. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cjson/cJSON.h>

#include "server/support/client.h"
#include "support/sanitized.h"
#include "support/tests.h"

enum { SILENCE_MS = 5000, FLOOD_BYTES = 10 << 20 };

#define SIGN "\r\n\r\n\0\r\nQUIT\n"
#define REST " HTTP/1.1\r\nHost: a\r\nConnection: close\r\n"

/* shy: trusts nobody. mild: believes the headers of this machine. strict: asks it for PROXY headers. */
static struct daemon shy, mild, strict;

static int start(void **state)
{
    (void)state;
    shy = daemon_start(NULL);
    mild = daemon_start(LIST("--trusted-proxies=127.0.0.0/29", "--max-per-client=1", ANY_COST));
    strict = daemon_start(LIST("--trusted-proxies=loopback", "--proxy-protocol=on", "--header-timeout-ms=400",
                               "--max-per-client=1", "--client-header=forwarded", ANY_COST));
    return 0;
}

static int stop(void **state)
{
    (void)state;
    daemon_stop(&shy);
    daemon_stop(&mild);
    daemon_stop(&strict);
    return 0;
}

/* Returns the line of the log with `mark`, parsed. */
static cJSON *log_with(const struct daemon *daemon, const char *mark)
{
    char *line = daemon_wait_for_log(daemon, mark);
    cJSON *root = cJSON_ParseWithOpts(line, NULL, 1);
    if (!root) fail_msg("%s", line);
    free(line);
    return root;
}

static void assert_logged(const struct daemon *daemon, const char *mark, const char *name, const char *value)
{
    cJSON *root = log_with(daemon, mark);
    const char *found = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, name));
    if (strcmp(found ? found : "", value) != 0) fail_msg("%s: %s is '%s' instead of '%s'", mark, name, found, value);
    cJSON_Delete(root);
}

/* Sends raw bytes whose answer has this status. */
static void assert_status(const struct daemon *daemon, const char *bytes, size_t size, int status, const char *detail)
{
    char *text = client_raw(daemon, bytes, size, SILENCE_MS);
    if (raw_status(text) != status || !strstr(text, detail)) fail_msg("not %d with '%s': %s", status, detail, text);
    free(text);
}

#define STATUS(daemon, bytes, status, detail) assert_status(daemon, bytes, sizeof(bytes) - 1, status, detail)

/* Sends GET /healthz?MARK with `headers` and checks the client in the log. */
static void assert_client(const struct daemon *daemon, const char *before, const char *headers, const char *mark,
                          const char *client)
{
    char request[2048];
    const int size = snprintf(request, sizeof request, "%sGET /healthz?%s" REST "%s\r\n", before, mark, headers);
    assert_status(daemon, request, (size_t)size, 200, "");
    assert_logged(daemon, mark, "client", client);
    assert_logged(daemon, mark, "remote", "127.0.0.1");
}

/* ---- headers ---- */

TEST(headers_of_strangers_are_ignored)
{
    assert_client(&shy, "", "X-Forwarded-For: 8.8.8.8\r\nForwarded: for=8.8.8.8\r\n", "stranger", "127.0.0.1");
}

TEST(large_headers_of_strangers_are_ignored)
{
    static char headers[1500];
    size_t used = (size_t)sprintf(headers, "X-Forwarded-For: ");
    memset(headers + used, '1', 1400);
    strcpy(headers + used + 1400, "\r\n");
    assert_client(&shy, "", headers, "long-stranger", "127.0.0.1");
    assert_client(&mild, "", headers, "long-proxy", "127.0.0.1");
}

TEST(trusted_proxies_name_their_client)
{
    assert_client(&mild, "", "X-Forwarded-For: 8.8.8.8\r\n", "xff-one", "8.8.8.8");
    assert_client(&mild, "", "X-Forwarded-For: 1.1.1.1, 8.8.8.8, 127.0.0.3\r\n", "xff-chain", "8.8.8.8");
    assert_client(&mild, "",
                  "x-forwarded-for: 1.1.1.1\r\nX-Forwarded-For: 2001:db8::1\r\nX-FORWARDED-FOR: 127.0.0.2\r\n",
                  "xff-lines", "2001:db8::1");
    assert_client(&mild, "", "X-Forwarded-For: 8.8.8.8, unknown\r\n", "xff-unknown", "127.0.0.1");
    assert_client(&mild, "", "X-Forwarded-For: 8.8.8.8\\u0022,\"}\r\n", "xff-none", "127.0.0.1");
    assert_client(&mild, "", "Forwarded: for=8.8.8.8\r\n", "forwarded-unread", "127.0.0.1");
}

TEST(too_many_named_clients_give_431)
{
    static char request[8192];
    size_t used = (size_t)sprintf(request, "GET /healthz" REST "X-Forwarded-For: ");
    while (used < 6000)
        used += (size_t)sprintf(request + used, "1.1.1.1, ");
    strcpy(request + used, "8.8.8.8\r\n\r\n");
    assert_status(&mild, request, strlen(request), 431, "larger than 4096 bytes");
}

/* Sends a render that takes seconds; returns its connection. */
static int begin_slow(const struct daemon *daemon, const char *before, const char *header)
{
    char *scene = scene_slow(SLOW_ALGORITHM, SLOW_SIDE, 2000), *request = malloc(strlen(scene) + 1024);
    assert_non_null(request);
    const int size =
        sprintf(request, "%sPOST /v1/render HTTP/1.1\r\nHost: a\r\n" JSON_TYPE "\r\n%sContent-Length: %zu\r\n\r\n%s",
                before, header, strlen(scene), scene);
    const int fd = client_connect(daemon);
    assert_true(fd >= 0 && client_write(fd, request, (size_t)size));
    free(request);
    free(scene);
    return fd;
}

static void assert_render(const struct daemon *daemon, const char *before, const char *header, int status,
                          const char *detail)
{
    char request[1024];
    const int size =
        snprintf(request, sizeof request, "%sPOST /v1/render" REST JSON_TYPE "\r\n%sContent-Length: %zu\r\n\r\n%s",
                 before, header, strlen(GOOD_SCENE), GOOD_SCENE);
    assert_status(daemon, request, (size_t)size, status, detail);
}

TEST(each_client_behind_a_proxy_has_its_own_budget)
{
    const int fd = begin_slow(&mild, "", "X-Forwarded-For: 8.8.8.8\r\n");
    client_wait_for_metric(&mild, "", ONE_AT_WORK);
    assert_render(&mild, "", "X-Forwarded-For: 1.2.3.4, 8.8.8.8\r\n", 429,
                  "maxPerClient allows 1 requests in flight from 8.8.8.8");
    assert_render(&mild, "", "X-Forwarded-For: 8.8.8.8, 9.9.9.9\r\n", 200, "");
    assert_render(&mild, "", "", 200, "");
    close(fd);
    free(daemon_wait_for_log(&mild, "the client left"));
    assert_render(&mild, "", "X-Forwarded-For: 8.8.8.8\r\n", 200, "");
}

/* ---- PROXY headers ---- */

TEST(proxy_headers_of_strangers_are_refused_and_say_why)
{
    STATUS(&shy, "PROXY TCP4 8.8.8.8 10.0.0.1 1 2\r\nGET /healthz" REST "\r\n", 400, "--trusted-proxies does not name");
    STATUS(&shy, SIGN "\x21\x11\x00\x0c\x08\x08\x08\x08\x0a\x00\x00\x01\x00\x01\x00\x02", 400,
           "--trusted-proxies does not name");
    STATUS(&mild, "PROXY TCP4 8.8.8.8 10.0.0.1 1 2\r\nGET /healthz" REST "\r\n", 400, "--proxy-protocol=on");
    assert_int_equal(client_get_status(&shy, "/healthz"), 200);
}

TEST(proxy_headers_name_the_client)
{
    assert_client(&strict, "PROXY TCP4 8.8.8.8 10.0.0.1 1 2\r\n", "", "proxy-four", "8.8.8.8");
    assert_client(&strict, "PROXY TCP6 2001:db8::7 ::1 1 2\r\n", "", "proxy-six", "2001:db8::7");
    assert_client(&strict, "PROXY UNKNOWN\r\n", "", "proxy-unknown", "127.0.0.1");
    /* A client has no say; a proxy before the load balancer has. */
    assert_client(&strict, "PROXY TCP4 8.8.8.8 10.0.0.1 1 2\r\n", "Forwarded: for=9.9.9.9\r\n", "proxy-spoof",
                  "8.8.8.8");
    assert_client(&strict, "PROXY TCP4 127.0.0.7 10.0.0.1 1 2\r\n",
                  "Forwarded: for=1.1.1.1, for=\"9.9.9.9:80\";proto=https\r\n", "proxy-chain", "9.9.9.9");
    assert_client(&strict, "PROXY UNKNOWN\r\n", "X-Forwarded-For: 9.9.9.9\r\n", "proxy-xff-unread", "127.0.0.1");
    /* The load balancer passes on what its client wrote. */
    assert_client(&strict, "PROXY UNKNOWN\r\n", "Forwarded: for=9.9.9.9\r\n", "proxy-unknown-spoof", "127.0.0.1");
    STATUS(&strict,
           SIGN "\x21\x11\x00\x0f\x08\x08\x04\x04\x0a\x00\x00\x01\x00\x01\x00\x02\x04\x00\x00GET /healthz?v2-four" REST
                "\r\n",
           200, "");
    assert_logged(&strict, "v2-four", "client", "8.8.4.4");
    STATUS(&strict, SIGN "\x20\x00\x00\x00GET /healthz?v2-local" REST "\r\n", 200, "");
    assert_logged(&strict, "v2-local", "client", "127.0.0.1");
}

TEST(proxy_headers_hold_for_all_requests_of_a_connection)
{
    static const char BYTES[] = "PROXY TCP4 8.8.8.8 10.0.0.1 1 2\r\nGET /healthz?kept-one HTTP/1.1\r\nHost: a\r\n\r\n"
                                "GET /healthz?kept-two" REST "\r\n";
    char *text = client_raw(&strict, BYTES, sizeof BYTES - 1, SILENCE_MS);
    assert_int_equal(raw_count(text), 2);
    free(text);
    assert_logged(&strict, "kept-one", "client", "8.8.8.8");
    assert_logged(&strict, "kept-two", "client", "8.8.8.8");
}

TEST(proxy_headers_may_come_in_pieces)
{
    static const char BYTES[] = "PROXY TCP4 8.8.8.8 10.0.0.1 1 2\r\nGET /healthz?pieces" REST "\r\n";
    const int fd = client_connect(&strict);
    for (size_t i = 0; i < sizeof BYTES - 1; i++, usleep(1000))
        assert_true(client_write(fd, BYTES + i, 1));
    char *text = client_read(fd, NULL, SILENCE_MS);
    assert_int_equal(raw_status(text), 200);
    free(text);
    close(fd);
    assert_logged(&strict, "pieces", "client", "8.8.8.8");
}

TEST(what_is_no_proxy_header_is_refused)
{
    STATUS(&strict, "GET /healthz" REST "\r\n", 400, "begins without a PROXY header");
    STATUS(&strict, "PROXY TCP4 8.8.8.8\x1b[31m 10.0.0.1 1 2\r\nGET /healthz" REST "\r\n", 400, "malformed");
    STATUS(&strict, "PROXY TCP4 8.8.8.8 10.0.0.1 1 2\r\nPROXY TCP4 8.8.8.8 10.0.0.1 1 2\r\n", 400, "");
    STATUS(&strict, SIGN "\x21\x11\xff\xff", 400, "longer than 4096 bytes");
    free(daemon_wait_for_log(&strict, "\"detail\":\"the connection begins without a PROXY header\""));
    assert_client(&strict, "PROXY TCP4 8.8.8.8 10.0.0.1 1 2\r\n", "", "after-garbage", "8.8.8.8");
}

TEST(slow_and_broken_proxy_headers_end_and_are_logged)
{
    int fd = client_connect(&strict);
    char *text = NULL;
    for (int i = 0; i < 40 && (!text || !*text); i++) {
        free(text);
        client_write(fd, i < 6 ? &"PROXY "[i] : "a", 1);
        text = client_read(fd, NULL, 50);
    }
    assert_int_equal(raw_status(text), 408);
    free(text);
    close(fd);
    free(daemon_wait_for_log(&strict, "the PROXY header came too slowly"));
    fd = client_connect(&strict);
    assert_true(client_write(fd, "PROXY TCP4", 10));
    usleep(50000);
    close(fd);
    free(daemon_wait_for_log(&strict, "the connection ended within its PROXY header"));
}

/* As HAProxy does with check-send-proxy, without httpchk. */
TEST(health_checks_without_a_request_leave_no_line)
{
    char *before = daemon_log(&strict), *after;
    const int fd = client_connect(&strict);
    assert_true(client_write(fd, SIGN "\x20\x00\x00\x00", 16));
    usleep(50000);
    close(fd);
    usleep(100000);
    after = daemon_log(&strict);
    assert_string_equal(before, after);
    free(before);
    free(after);
}

TEST(health_asks_as_a_proxy_does)
{
    char port[16], *output;
    snprintf(port, sizeof port, "%u", strict.port);
    assert_int_equal(
        daemon_run(LIST("--health", "--port", port, "--trusted-proxies=loopback", "--proxy-protocol=on"), &output), 0);
    free(output);
    assert_int_equal(daemon_run(LIST("--health", "--port", port), &output), 1);
    free(output);
}

TEST(each_client_of_a_proxy_header_has_its_own_budget)
{
    const int fd = begin_slow(&strict, "PROXY TCP4 8.8.8.8 10.0.0.1 1 2\r\n", "");
    client_wait_for_metric(&strict, "PROXY UNKNOWN\r\n", ONE_AT_WORK);
    assert_render(&strict, "PROXY TCP4 8.8.8.8 10.0.0.1 1 2\r\n", "", 429, "from 8.8.8.8");
    assert_render(&strict, "PROXY TCP4 9.9.9.9 10.0.0.1 1 2\r\n", "", 200, "");
    close(fd);
}

TEST(wrong_settings_exit_2)
{
    static const struct {
        const char *flag, *text;
    } CASES[] = {
        {"--trusted-proxies=10.0.0.0/33", "'10.0.0.0/33' is no list of addresses and networks"},
        {"--trusted-proxies=proxy.example", "is no list of addresses and networks"},
        {"--client-header=x-real-ip", "'x-real-ip' is none of x-forwarded-for, forwarded and none"},
        {"--proxy-protocol=v2", "is neither on nor off"},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        char *output;
        assert_int_equal(daemon_run(LIST("--port=0", CASES[i].flag), &output), 2);
        if (!strstr(output, CASES[i].text)) fail_msg("%s", output);
        free(output);
    }
}

/* ---- the log ---- */

TEST(traces_are_taken_and_given_on)
{
    static const char ID[] = "0af7651916cd43dd8448eb211c80319c", PARENT[] = "b7ad6b7169203331";
    static const char *const headers[] = {"traceparent: cc-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01-more",
                                          "tracestate: a=b", "X-Request-Id: traced", NULL};
    struct reply reply = client_send(&shy, "GET", "/healthz", headers, NULL, 0);
    char answer[64];
    cJSON *root = log_with(&shy, "\"traced\"");
    const char *span = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "spanId"));
    assert_non_null(span);
    snprintf(answer, sizeof answer, "00-%s-%s-01", ID, span);
    assert_string_equal(reply_header(&reply, "traceresponse"), answer);
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "traceId")), ID);
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "parentSpanId")), PARENT);
    assert_true(cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(root, "sampled")));
    cJSON_Delete(root);
    reply_free(&reply);
}

TEST(requests_without_a_valid_trace_have_none)
{
    static const char *const headers[] = {"traceparent: 00-00000000000000000000000000000000-b7ad6b7169203331-01",
                                          "X-Request-Id: traceless", NULL};
    struct reply reply = client_send(&shy, "GET", "/healthz", headers, NULL, 0);
    assert_string_equal(reply_header(&reply, "traceresponse"), "");
    assert_logged(&shy, "\"traceless\"", "traceId", "");
    reply_free(&reply);
}

TEST(secrets_do_not_reach_the_log)
{
    STATUS(&shy,
           "GET /healthz?mark=secrets&signature=hunter2&%54oken=hunter2" REST "Authorization: Bearer hunter2\r\n\r\n",
           200, "");
    assert_logged(&shy, "mark=secrets", "query", "mark=secrets&signature=-&%54oken=-");
    char *log = daemon_log(&shy);
    assert_null(strstr(log, "hunter2"));
    free(log);
}

/* Whatever requests hold, each line is one object, without bytes that a terminal obeys. */
static void assert_log_is_clean(const struct daemon *daemon)
{
    char *log = daemon_log(daemon), *save = NULL;
    for (char *line = strtok_r(log, "\n", &save); line; line = strtok_r(NULL, "\n", &save)) {
        cJSON *root = cJSON_ParseWithOpts(line, NULL, 1);
        if (!cJSON_IsObject(root) || !cJSON_GetObjectItemCaseSensitive(root, "time")) fail_msg("%s", line);
        cJSON_Delete(root);
        if (strpbrk(line, "\x1b\x7f\r\x9b\b")) fail_msg("%s", line);
        if (strstr(line, "\xe2\x80\xa8") || strstr(line, "\xe2\x80\xae")) fail_msg("%s", line);
        if (strlen(line) >= 32 << 10) fail_msg("a line of %zu bytes", strlen(line));
    }
    free(log);
}

TEST(no_request_forges_a_line)
{
#define FORGED "\",\"forged\":true}%0d%0a{\"time\":\"forged\"}"
    static const char *const REQUESTS[] = {
        "GET /" FORGED REST "\r\n",
        "GET /a%00\xe2\x80\xa8\xe2\x80\xae\xc2\x9b" REST "\r\n",
        "GET /?" FORGED "\\\"\xff\xfe\xed\xa0\x80" REST "\r\n",
        "GET /healthz" REST "X-Request-Id: \",\"forged\":true}\r\n\r\n",
        "GET /healthz" REST "X-Request-Id: \xe2\x80\xa8\r\n\r\n",
        "GET /healthz" REST "X-Forwarded-For: \",\"forged\":true}\r\n\r\n",
        "GET /healthz" REST "traceparent: \",\"forged\":true}\r\n\r\n",
        "GET /\x1b[31m" REST "\r\n",
        "GET /healthz" REST "X-A: a\rb\r\n\r\n",
        "G\"ET /healthz" REST "\r\n",
        "POST /v1/render?channel=" FORGED REST "Content-Length: 2\r\n\r\n{}",
        "POST /v1/render" REST "Content-Encoding: " FORGED "\r\nContent-Length: 2\r\n\r\n{}",
        "POST /v1/render" REST "Content-Type: " FORGED "\xe2\x80\xa8\r\nContent-Length: 2\r\n\r\n{}",
        "PROXY TCP4 " FORGED " 1 2 3\r\n",
    };
    struct daemon *const daemons[] = {&shy, &mild, &strict};
    for (size_t k = 0; k < 3; k++) {
        for (size_t i = 0; i < sizeof REQUESTS / sizeof REQUESTS[0]; i++) {
            char request[512];
            const int size = snprintf(request, sizeof request, "%s%s",
                                      k == 2 ? "PROXY TCP4 8.8.8.8 10.0.0.1 1 2\r\n" : "", REQUESTS[i]);
            char *text = client_raw(daemons[k], request, (size_t)size, SILENCE_MS);
            if (raw_status(text) == 0) fail_msg("no answer to %s", REQUESTS[i]);
            free(text);
        }
        char *log = daemon_log(daemons[k]);
        assert_null(strstr(log, ",\"forged\":true"));
        free(log);
        assert_log_is_clean(daemons[k]);
    }
}

/* ---- floods ---- */

/* `begin`, `piece` until there are FLOOD_BYTES, `end`. */
static void assert_flood(const char *begin, const char *piece, const char *end, int status, const char *detail)
{
    char *flood = malloc(FLOOD_BYTES + 256);
    assert_non_null(flood);
    const size_t length = strlen(piece);
    size_t used = (size_t)sprintf(flood, "%s", begin);
    for (; used < FLOOD_BYTES; used += length)
        memcpy(flood + used, piece, length);
    used += (size_t)sprintf(flood + used, "%s", end);
    for (int k = 0; k < 2; k++) {
        assert_status(k ? &mild : &shy, flood, used, status, detail);
        assert_int_equal(client_get_status(k ? &mild : &shy, "/healthz"), 200);
    }
    free(flood);
}

TEST(floods_get_clear_answers_and_cost_no_other_request)
{
    const long before = daemon_memory_kib(&shy, "VmHWM:");
    assert_flood("GET /healthz?a=", "a", REST "\r\n", 414, "longer than 8192 bytes");
    assert_flood("GET /v1/renders/0?", "a=1&", REST "\r\n", 400, "too many parameters");
    assert_flood("GET /healthz" REST "X-Forwarded-For: ", "1.1.1.1, ", "8.8.8.8\r\n\r\n", 431, "larger than");
    assert_flood("GET /healthz" REST, "X-A: b\r\n", "\r\n", 431, "more than 100 headers");
    assert_flood("GET /healthz" REST, "X-Forwarded-For: 1.1.1.1\r\n", "\r\n", 431, "more than 100 headers");
    assert_flood("GET /healthz" REST "X-A: ", "a", "\r\n\r\n", 431, "larger than 32768 bytes");
    assert_flood("GET /healthz" REST, "a", ": b\r\n\r\n", 431, "longer than 64 bytes");
    assert_flood("", "\r\n", "GET /healthz" REST "\r\n", 400, "empty lines");
    assert_flood("", "G", " / HTTP/1.1\r\n\r\n", 501, "the name of the method");
    const long after = daemon_memory_kib(&shy, "VmHWM:");
    assert_true(IS_SANITIZED || after - before < 4 << 10); /* whose allocators keep what is freed */
}

RUN_TESTS(start, stop)
