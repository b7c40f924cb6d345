/* Allocations fail, each in turn, and many: answers are whole, or say that there is no memory; nothing is lost. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <zlib.h>

#include "server/support/assets.h"
#include "server/support/client.h"
#include "support/failing_malloc.h"
#include "support/tests.h"

enum { TURNS_MAX = 2000, WAIT_MS = 10000, NAMES_MAX = 12 };

static struct failing_malloc *control;
static struct daemon server;
static struct folder assets;

/* A request, and what is in its answer while there is memory. */
struct request {
    const char *name, *head; /* without Content-Length and the empty line */
    char *body;
    size_t size;
    int status;
    char names[NAMES_MAX][32]; /* of its headers */
    size_t name_count;
};

static int start(void **state)
{
    char path[64];
    const int fd = memfd_create("failing-malloc", 0);
    (void)state;
    if (fd < 0 || ftruncate(fd, sizeof *control) != 0) return -1;
    control = mmap(NULL, sizeof *control, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (control == MAP_FAILED) return -1;
    snprintf(path, sizeof path, "/proc/%d/fd/%d", (int)getpid(), fd);
    char library[4096];
    const char *binary = daemon_binary(), *slash = strrchr(binary, '/');
    snprintf(library, sizeof library, "%.*s/failing_malloc.so", slash ? (int)(slash - binary) : 1,
             slash ? binary : ".");
    setenv("FAILING_MALLOC", path, 1);
    setenv("LD_PRELOAD", library, 1);
    const char *options = getenv("ASAN_OPTIONS");
    char with_ours[512];
    snprintf(with_ours, sizeof with_ours, "%s%sverify_asan_link_order=0:allocator_may_return_null=1",
             options ? options : "", options ? ":" : "");
    setenv("ASAN_OPTIONS", with_ours, 1);
    assets = folder_make();
    server = assets_start(&assets, LIST("--workers=1", "--threads=1"));
    unsetenv("LD_PRELOAD");
    return 0;
}

/* Its exit status must be 0: under a sanitizer nothing has been lost. */
static int stop(void **state)
{
    (void)state;
    atomic_store(&control->first, 0);
    daemon_stop(&server);
    folder_remove(&assets);
    return 0;
}

/* ---- one request on an open connection ---- */

static int connection = -1;

/* The answer, whole; "" where the connection ended. */
static char *ask(const struct request *request)
{
    char bytes[4096]; /* sent at once: the second of two small writes would wait for an acknowledgement */
    const size_t length =
        (size_t)snprintf(bytes, sizeof bytes, "%sHost: a\r\nContent-Length: %zu\r\n\r\n", request->head, request->size);
    assert_true(length + request->size < sizeof bytes);
    if (request->size > 0) memcpy(bytes + length, request->body, request->size);
    client_write(connection, bytes, length + request->size);
    return client_read(connection, "\r\n\r\n", WAIT_MS);
}

/* Closed, so that the next begins afresh, and read to its end. */
static void end_connection(void)
{
    if (connection >= 0) close(connection);
    connection = -1;
}

/* Another, that libmicrohttpd knows already. */
static void begin_connection(void)
{
    end_connection();
    connection = client_connect(&server);
    static const char HEALTH[] = "GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n";
    assert_true(client_write(connection, HEALTH, sizeof HEALTH - 1));
    free(client_read(connection, "ok\"}\n", WAIT_MS));
}

static void learn(struct request *request)
{
    begin_connection();
    char *text = ask(request), *save = NULL;
    request->status = raw_status(text);
    request->name_count = 0;
    char *end = strstr(text, "\r\n\r\n");
    assert_non_null(end);
    *end = '\0';
    strtok_r(text, "\r\n", &save);
    for (char *line; (line = strtok_r(NULL, "\r\n", &save)) && request->name_count < NAMES_MAX;)
        snprintf(request->names[request->name_count++], 32, "%.*s:", (int)strcspn(line, ":"), line);
    free(text);
}

/* Whole as it was learned, or a 503 that says when to come again. */
static void assert_whole_or_busy(const struct request *request, const char *text, unsigned turn)
{
    const int status = raw_status(text);
    if (status == 503) {
        if (!strstr(text, "Retry-After: ") || !strstr(text, "application/problem+json"))
            fail_msg("%s, allocation %u: a 503 that says little:\n%s", request->name, turn, text);
        return;
    }
    if (status != request->status)
        fail_msg("%s, allocation %u: status %d, not %d:\n%.400s", request->name, turn, status, request->status, text);
    for (size_t i = 0; i < request->name_count; i++)
        if (!strstr(text, request->names[i]))
            fail_msg("%s, allocation %u: no %s in\n%.400s", request->name, turn, request->names[i], text);
}

static unsigned run(const struct request *request, unsigned first, unsigned every)
{
    begin_connection();
    failing_malloc_arm(control, first, every);
    char *text = ask(request);
    atomic_store(&control->first, 0);
    assert_whole_or_busy(request, text, first);
    free(text);
    return atomic_load(&control->failed);
}

/* ---- the requests ---- */

#define RENDER(type) "POST /v1/render HTTP/1.1\r\nContent-Type: " type "\r\n"
#define SCENE                                                                                                          \
    "{\"window\":{\"width\":40,\"height\":30},\"polygons\":[{\"vertices\":[[0,0,0],[1,0,0],[0,1,0]],\"color\":\"#"     \
    "cc3333\"}]"

static char *gzipped(const char *text, size_t *size)
{
    z_stream stream = {0};
    char *out = malloc(1000);
    deflateInit2(&stream, 9, Z_DEFLATED, 31, 8, Z_DEFAULT_STRATEGY);
    stream.next_in = (Bytef *)(uintptr_t)text;
    stream.avail_in = (uInt)strlen(text);
    stream.next_out = (Bytef *)out;
    stream.avail_out = 1000;
    deflate(&stream, Z_FINISH);
    *size = stream.total_out;
    deflateEnd(&stream);
    return out;
}

static struct request with_text(const char *name, const char *head, const char *text)
{
    return (struct request){.name = name, .head = head, .body = strdup(text), .size = strlen(text)};
}

static size_t make_requests(struct request *out)
{
    size_t count = 0;
    out[count++] = with_text("a picture", RENDER("application/json"), SCENE "}");
    out[count++] = with_text("all outputs", RENDER("application/json"),
                             SCENE ",\"outputs\":[{\"channel\":\"color\"},{\"channel\":\"depth\",\"encoding\":\"npy\"},"
                                   "{\"channel\":\"faceId\",\"encoding\":\"npy\"},{\"channel\":\"info\"}]}");
    out[count++] = with_text("a warning", RENDER("application/json"), SCENE ",\"nodes\":[],\"lights\":[]}");
    out[count++] = with_text("a wrong scene", RENDER("application/json"), SCENE ",\"polygon\":1,\"x\":2,\"y\":3}");
    out[count++] =
        with_text("many faults", RENDER("application/json"),
                  SCENE ",\"a\":1,\"b\":1,\"c\":1,\"d\":1,\"e\":1,\"f\":1,\"g\":1,\"h\":1,\"i\":1,\"j\":1,\"k\":1,"
                        "\"l\":1,\"m\":1,\"n\":1,\"o\":1,\"p\":1,\"q\":1,\"r\":1,\"s\":1,\"t\":1}");
    out[count++] = with_text("a bare mesh", RENDER("model/obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    out[count++] = with_text("a mesh of text", RENDER("model/stl"),
                             "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                             "0\nendloop\nendfacet\nendsolid a\n");
    out[count++] = with_text("parts", RENDER("multipart/form-data; boundary=b"),
                             "--b\r\nContent-Disposition: form-data; name=\"scene\"\r\n\r\n" SCENE "}\r\n--b--\r\n");
    out[count++] = (struct request){.name = "gzip", .head = RENDER("application/json") "Content-Encoding: gzip\r\n"};
    out[count - 1].body = gzipped(SCENE "}", &out[count - 1].size);
    out[count++] =
        with_text("a query", "POST /v1/render?channel=info HTTP/1.1\r\nContent-Type: application/json\r\n", SCENE "}");
    out[count++] = with_text("limits", "GET /v1/limits HTTP/1.1\r\n", "");
    out[count++] = with_text("no such path", "GET /nowhere HTTP/1.1\r\nX-Request-Id: mine\r\n", "");
    out[count++] = with_text("no such type", RENDER("text/plain"), "a");
    out[count++] = with_text("an asset", "POST /v1/assets HTTP/1.1\r\n", "abc");
    out[count++] = with_text("health", "GET /healthz HTTP/1.1\r\n", "");
    return count;
}

static unsigned run_all(unsigned every)
{
    struct request requests[20] = {0};
    const size_t count = make_requests(requests);
    unsigned failed = 0;
    for (size_t i = 0; i < count; i++) {
        learn(&requests[i]);
        learn(&requests[i]); /* a stored asset has another status */
        unsigned turn = 1;
        while (turn < TURNS_MAX && run(&requests[i], turn, every) > 0) {
            failed++;
            turn = every == 0 && turn < 400 ? turn + 1 : turn + 37;
        }
        assert_true(turn < TURNS_MAX);
        run(&requests[i], 0, 0);
        free(requests[i].body);
    }
    end_connection();
    assert_int_equal(client_render_status(&server, GOOD_SCENE), 200);
#if defined __clang__ && defined __has_feature
#if __has_feature(address_sanitizer)
    if (failed == 0) skip(); /* its runtime is in the program itself, before all that is preloaded */
#endif
#endif
    return failed;
}

TEST(each_allocation_fails_in_turn)
{
    assert_true(run_all(0) > 100);
}

TEST(many_allocations_fail_in_a_request)
{
    static const unsigned EVERY[] = {1, 2, 3, 7};
    for (size_t i = 0; i < sizeof EVERY / sizeof EVERY[0]; i++)
        assert_true(run_all(EVERY[i]) > 20);
}

/* ---- tools of agents ---- */

#define CALL(tool, more)                                                                                               \
    "{\"jsonrpc\":\"2.0\",\"id\":7,\"method\":\"tools/call\",\"params\":{\"name\":\"" tool                             \
    "\",\"arguments\":{\"scene\":" SCENE "}" more "}}}"

/* Fails unless the answer is that with memory, or an error of memory. Returns true for an internal error. */
static bool assert_same_or_none(const struct request *request, const char *wanted, const char *text, unsigned turn)
{
    const char *body = strstr(text, "\r\n\r\n"), *whole = strstr(wanted, "\r\n\r\n");
    const int status = raw_status(text);
    const bool is_internal = status == 500 && strstr(text, "\"code\":-32603");
    if (is_internal || status == 503) return is_internal;
    if (status == 200 && body && strcmp(body, whole) == 0) return false;
    if (status == 200 && strstr(text, "memory") && strstr(text, "\"isError\":true")) return false;
    fail_msg("%s, allocation %u:\n%.900s", request->name, turn, text);
    return false;
}

TEST(a_tool_without_memory_says_so)
{
    struct request requests[] = {
        with_text("facts", "POST /mcp HTTP/1.1\r\nContent-Type: application/json\r\n", CALL("facts", "")),
        with_text("render", "POST /mcp HTTP/1.1\r\nContent-Type: application/json\r\n",
                  CALL("render", ",\"views\":[\"front\",\"left\"]")),
        with_text("pick", "POST /mcp HTTP/1.1\r\nContent-Type: application/json\r\n",
                  CALL("pick", ",\"sheet\":\"threeView\",\"x\":10,\"y\":9")),
        with_text("list", "POST /mcp HTTP/1.1\r\nContent-Type: application/json\r\n",
                  "{\"jsonrpc\":\"2.0\",\"id\":7,\"method\":\"tools/list\"}")};
    unsigned internal = 0, failed = 0;
    for (size_t i = 0; i < sizeof requests / sizeof *requests; i++) {
        begin_connection();
        char *wanted = ask(&requests[i]);
        assert_int_equal(raw_status(wanted), 200);
        for (unsigned turn = 1, more = 1; turn < TURNS_MAX && more > 0; turn++) {
            begin_connection();
            failing_malloc_arm(control, turn, turn % 2 ? 0 : 3);
            char *text = ask(&requests[i]);
            more = atomic_load(&control->failed);
            atomic_store(&control->first, 0);
            internal += assert_same_or_none(&requests[i], wanted, text, turn);
            failed += more;
            free(text);
        }
        free(wanted);
        free(requests[i].body);
    }
    end_connection();
#if defined __clang__ && defined __has_feature
#if __has_feature(address_sanitizer)
    if (failed == 0) skip();
#endif
#endif
    assert_true(internal > 20 && failed > 100);
}

RUN_TESTS(start, stop)
