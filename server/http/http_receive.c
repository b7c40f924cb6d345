#include "http_receive.h"

#include <arpa/inet.h>
#include <errno.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "clock.h"
#include "http_exchange.h"

/* DISCARDS: per call, so that no client delays the others. */
enum { DISCARD_BYTES = 1 << 20, DISCARDS = 16, SELF_TEST_MS = 2000 };

/* libmicrohttpd cannot show bytes before it parses them, but it calls recv(), and the linker binds that to the function
 * below. The thread determines the daemon, since recv() has no argument for it. */
static _Thread_local struct http *receiver;

void http_receive_for(struct http *http)
{
    receiver = http;
}

static ssize_t fail_with(int error)
{
    errno = error;
    return -1;
}

ssize_t http_receive_nothing(int fd)
{
    for (int i = 0; i < DISCARDS; i++) {
        const ssize_t count = recvfrom(fd, NULL, DISCARD_BYTES, MSG_TRUNC | MSG_DONTWAIT, NULL, NULL);
        if (count <= 0) return count;
    }
    return fail_with(EAGAIN);
}

/* Handles the end within a request. ECONNRESET makes libmicrohttpd end the exchange at once; otherwise it would wait.
 */
static ssize_t end_within_request(struct connection *connection)
{
    if (connection->exchange) connection->exchange->client_left = true;
    return fail_with(ECONNRESET);
}

/* libmicrohttpd calls again only if the buffer was filled, or more bytes arrive. So if some bytes do not pass, this
 * receives more into the free room. */
static ssize_t receive(struct http *http, struct connection *connection, char *bytes, size_t size, int flags)
{
    struct framing *framing = &connection->framing;
    const uint64_t known = framing->passed;
    size_t passed = 0;
    if (connection->phase == PHASE_REFUSED) return fail_with(connection->has_left ? ECONNRESET : EAGAIN);
    for (bool is_more = true; is_more && passed < size && framing->status == 0;) {
        const size_t room = size - passed;
        const ssize_t count = recvfrom(connection->fd, bytes + passed, room, flags, NULL, NULL);
        if (count <= 0 && passed > 0) break; /* reported by the next call */
        if (count == 0 && !framing_is_between(framing)) return end_within_request(connection);
        if (count == 0) return 0;
        if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return -1;
        if (count < 0) return end_within_request(connection);
        is_more = (size_t)count == room;
        const size_t left = connections_take_proxy(&http->connections, connection, bytes + passed, (size_t)count);
        passed += framing_scan(framing, bytes + passed, left);
        const bool is_request = !framing_is_between(framing) || framing->passed > known; /* not just an empty line */
        if (connection->phase == PHASE_IDLE && is_request)
            connections_enter(&http->connections, connection, PHASE_HEADER);
    }
    http_refuse_framing(http, connection); /* or later, once the requests before are answered */
    return passed > 0 ? (ssize_t)passed : fail_with(EAGAIN);
}

/* Replaces the system's recv() for libmicrohttpd, so it is visible with any compiler flags. In threads without a
 * daemon, and for other sockets, it acts as the system's. */
__attribute__((visibility("default"))) ssize_t recv(int fd, void *bytes, size_t size, int flags)
{
    struct connection *connection = receiver ? connections_find(&receiver->connections, fd) : NULL;
    return connection ? receive(receiver, connection, bytes, size, flags)
                      : recvfrom(fd, bytes, size, flags, NULL, NULL);
}

/* ---- the test at start ---- */

/* Returns true if the answer to `request` begins with `status`. */
static bool answers(struct http *http, const char *request, size_t size, const char *status)
{
    const struct sockaddr_in address = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    int fds[2];
    char text[64] = "";
    bool found = false;
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, fds) != 0) return false;
    if (connections_add(&http->connections, fds[0], (const struct sockaddr *)&address) &&
        MHD_add_connection(http->daemon, fds[0], (const struct sockaddr *)&address, sizeof address) == MHD_YES &&
        write(fds[1], request, size) == (ssize_t)size) {
        const int64_t until = clock_ms() + SELF_TEST_MS;
        ssize_t count = -1;
        while (count < 0 && clock_ms() < until) {
            MHD_run(http->daemon);
            count = recvfrom(fds[1], text, sizeof text - 1, 0, NULL, NULL);
        }
        found = count > 0 && strncmp(text, status, strlen(status)) == 0;
    }
    close(fds[1]);
    for (int i = 0; i < 100 && http->connections.count > 0; i++)
        MHD_run(http->daemon);
    return found && http->connections.count == 0;
}

bool http_receive_works(struct http *http)
{
    static const char GOOD[] = "GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n";
    /* A request that every version of libmicrohttpd accepts in its least strict mode. */
    static const char BAD[] = "GET /healthz HTTP/1.1\r\nHost: a\r\nContent-Length: 0\r\nContent-Length: 0\r\n\r\n";
    const bool asks_for_proxy = http->connections.asks_for_proxy;
    http->is_self_test = true;
    http->connections.asks_for_proxy = false;
    const bool works = answers(http, GOOD, sizeof GOOD - 1, "HTTP/1.1 200 ") &&
                       answers(http, BAD, sizeof BAD - 1, "HTTP/1.1 400 Bad Request\r\nConnection: close\r\n");
    http->is_self_test = false;
    http->connections.asks_for_proxy = asks_for_proxy;
    return works;
}
