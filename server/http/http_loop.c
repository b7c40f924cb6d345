#include "http_loop.h"

#include <errno.h>
#include <stdio.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "clock.h"
#include "gate/gate.h"
#include "http_exchange.h"
#include "http_receive.h"
#include "http_room.h"
#include "http_work.h"
#include "log/log.h"

enum {
    EVENTS = 256,
    ACCEPTS = 64,     /* per turn; so many connections may exceed the limit until libmicrohttpd has closed others */
    CANCEL_MS = 2000, /* after the drain timeout: for cancelled work to be answered */
    GRACE_MS = 1000,  /* at the beginning of a drain: for requests that are on their way */
    REST_MS = 50      /* of the listener, if no descriptor or no place is free */
};

static bool watch(const struct http *http, int fd, uint32_t events, void *of)
{
    struct epoll_event event = {.events = events, .data.ptr = of};
    return epoll_ctl(http->epoll_fd, EPOLL_CTL_ADD, fd, &event) == 0;
}

bool http_loop_open(struct http *http)
{
    const union MHD_DaemonInfo *info = MHD_get_daemon_info(http->daemon, MHD_DAEMON_INFO_EPOLL_FD);
    if (!info) return false;
    http->library_fd = info->epoll_fd;
    return watch(http, http->listen_fd, EPOLLIN, &http->listen_fd) &&
           watch(http, http->wake_fd, EPOLLIN, &http->wake_fd) &&
           watch(http, http->library_fd, EPOLLIN, &http->library_fd);
}

void http_loop_wake(struct http *http)
{
    static const uint64_t ONE = 1;
    (void)!write(http->wake_fd, &ONE, sizeof ONE);
}

/* ---- new connections ---- */

/* Ends a connection early. libmicrohttpd closes it in its next run. */
static void push_out(struct http *http, struct connection *connection)
{
    if (connection->phase == PHASE_HEADER || connection->phase == PHASE_BODY)
        http_refuse(http, connection, 503, "the connection was closed to make room for another one");
    connections_enter(&http->connections, connection, PHASE_REFUSED);
    shutdown(connection->fd, SHUT_RDWR);
}

/* Refuses a new connection for lack of a place. */
static void turn_away(struct http *http, struct connection *connection, const char *why)
{
    /* Otherwise closing would reset the connection before the answer is read. */
    http_receive_nothing(connection->fd);
    http_refuse(http, connection, 503, why);
    const int fd = connection->fd;
    connections_remove(&http->connections, connection);
    close(fd);
}

/* Place for one more connection. PLACE_SOON: the only candidates have just entered their phase; they may have sent a
 * request that is not read yet, and are kept. */
enum place { PLACE_FREE, PLACE_SOON, PLACE_NONE };

static enum place find_place(const struct http *http, struct connection **in_the_way)
{
    const struct connections *connections = &http->connections;
    bool soon;
    *in_the_way = NULL;
    if (connections->count < http->config->max_connections) return PLACE_FREE;
    *in_the_way = connections_replaceable(connections, clock_ms(), &soon);
    return *in_the_way ? PLACE_FREE : soon ? PLACE_SOON : PLACE_NONE;
}

/* Loopback has extra places, so that a health check on this machine succeeds. */
static bool may_exceed(const struct http *http, const struct connection *fresh)
{
    return fresh->client->is_loopback &&
           http->connections.count <= http->config->max_connections + HTTP_LOOPBACK_CONNECTIONS;
}

/* Adds an accepted socket, or refuses it. */
static void admit(struct http *http, int fd, const struct sockaddr *address, socklen_t size, bool has_place)
{
    struct connection *connection = connections_add(&http->connections, fd, address);
    if (!connection) {
        answer_send(&(struct answer){.is_broken = true}, fd);
        close(fd);
    } else if (!has_place && !may_exceed(http, connection)) {
        turn_away(http, connection, "all connections are busy");
    } else if (!watch(http, fd, EPOLLRDHUP | EPOLLET, connection) ||
               MHD_add_connection(http->daemon, fd, address, size) != MHD_YES) {
        /* libmicrohttpd may not have reported its end. */
        struct connection *left = connections_find(&http->connections, fd);
        if (left) connections_remove(&http->connections, left);
    }
}

static void rest_listener(struct http *http, bool rest)
{
    struct epoll_event event = {.events = rest ? 0 : EPOLLIN, .data.ptr = &http->listen_fd};
    if (http->listener_rests == rest) return;
    http->listener_rests = rest;
    epoll_ctl(http->epoll_fd, EPOLL_CTL_MOD, http->listen_fd, &event);
}

/* Returns true if more connections may be waiting. */
static bool accept_some(struct http *http)
{
    struct sockaddr_storage address;
    for (int i = 0; i < ACCEPTS; i++) {
        socklen_t size = sizeof address;
        struct connection *in_the_way;
        const enum place place = find_place(http, &in_the_way);
        if (place == PLACE_SOON && !atomic_load(&http->draining)) {
            rest_listener(http, true);
            return false;
        }
        const int fd = accept4(http->listen_fd, (struct sockaddr *)&address, &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
        if (fd < 0 && (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM)) {
            bool soon;
            struct connection *other = connections_replaceable(&http->connections, clock_ms(), &soon);
            if (other) push_out(http, other);
            rest_listener(http, true);
            return false;
        }
        if (fd < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINVAL || errno == EBADF)) return false;
        if (fd >= 0 && in_the_way) push_out(http, in_the_way);
        if (fd >= 0) admit(http, fd, (const struct sockaddr *)&address, size, place == PLACE_FREE);
    }
    return true;
}

/* ---- what happened ---- */

static void client_left(struct http *http, struct connection *connection)
{
    connection->has_left = true;
    if (connection->phase == PHASE_WORK && !connection->exchange->client_left)
        http_abandon_work(http, connection->exchange);
    if (connection->exchange && http_is_streaming(connection->exchange)) {
        connection->exchange->client_left = true;
        http_cut_stream(connection->exchange);
    }
    if (connection->phase == PHASE_REFUSED) shutdown(connection->fd, SHUT_RDWR);
}

static void take_events(struct http *http, const struct epoll_event *events, int count)
{
    /* Connections first: they are valid until libmicrohttpd runs or a new one replaces them. */
    for (int i = 0; i < count; i++) {
        void *of = events[i].data.ptr;
        if (of != &http->listen_fd && of != &http->wake_fd && of != &http->library_fd) client_left(http, of);
    }
    for (int i = 0; i < count; i++) {
        uint64_t times;
        if (events[i].data.ptr == &http->wake_fd) (void)!read(http->wake_fd, &times, sizeof times);
        if (events[i].data.ptr == &http->listen_fd && !atomic_load(&http->draining)) accept_some(http);
    }
}

/* ---- what takes too long ---- */

/* Returns true if the client has closed its sending half, within a request or after its last answer, and all its bytes
 * are read. libmicrohttpd may have missed it, since the end came with the last bytes. */
static bool has_ended(const struct connection *connection)
{
    const bool is_idle = connection->phase == PHASE_IDLE && connection->answered == connection->framing.passed;
    const bool is_sending = connection->phase == PHASE_HEADER || connection->phase == PHASE_BODY;
    char byte;
    return connection->has_left && (is_idle || is_sending) &&
           recvfrom(connection->fd, &byte, 1, MSG_PEEK | MSG_DONTWAIT, NULL, NULL) == 0;
}

/* Returns true if the file of the answer has become shorter than its Content-Length: its end would never come. */
static bool is_cut_off(const struct connection *connection)
{
    const struct exchange *exchange = connection->exchange;
    struct stat info;
    return connection->phase == PHASE_WRITE && exchange && exchange->file > 0 && fstat(exchange->file, &info) == 0 &&
           (uint64_t)info.st_size < exchange->answer.size;
}

/* Ends work that took too long while its answer is streamed. Returns true if the reader waits for bytes. */
static bool stream_rests(const struct connection *connection, int64_t now)
{
    struct exchange *exchange = connection->exchange;
    if (!exchange || !http_is_streaming(exchange)) return false;
    if (now >= http_work_deadline_ms(exchange)) http_cancel_work(exchange);
    return exchange->is_suspended;
}

static void end_overdue(struct http *http, struct connection *connection, int64_t now)
{
    /* Most clients read their refusal while they send, and leave. Others send to the end: their bytes are discarded
     * here, some milliseconds later, since under overload that takes more time than a refusal. */
    if (connection->phase == PHASE_REFUSED) http_receive_nothing(connection->fd);
    if (has_ended(connection) || is_cut_off(connection))
        shutdown(connection->fd, SHUT_RDWR); /* recv() or send() reports it to libmicrohttpd */
    if (connection->phase == PHASE_WORK) connection->deadline_ms = http_work_deadline_ms(connection->exchange);
    if (stream_rests(connection, now)) return;
    enum overdue overdue = connections_overdue(&http->connections, connection, now);
    if (overdue == OVERDUE_CLOSE && connections_is_within_proxy(connection) && connection->phase == PHASE_IDLE) {
        http_refuse(http, connection, 408, "the PROXY header came too slowly");
        return;
    }
    switch (overdue) {
    case OVERDUE_NO:
        break;
    case OVERDUE_408:
        http_refuse(http, connection, 408,
                    connection->phase == PHASE_HEADER ? "the header came too slowly" : "the body came too slowly");
        break;
    case OVERDUE_CANCEL:
        http_cancel_work(connection->exchange);
        break;
    case OVERDUE_READER:
        if (connection->exchange) connection->exchange->was_slow = true;
        /* fall through */
    case OVERDUE_CLOSE:
        shutdown(connection->fd, SHUT_RDWR);
        connection->deadline_ms = INT64_MAX;
        break;
    }
}

static void end_all_overdue(struct http *http, int64_t now)
{
    http->connections.is_short = http_room_is_short(http);
    for (struct connection *c = http->connections.first, *next; c; c = next) {
        next = c->next;
        end_overdue(http, c, now);
    }
    rest_listener(http, false);
}

/* ---- the end ---- */

/* Accepts the connections that wait in the kernel: closing the socket would reset them. */
static void begin_drain(struct http *http, int64_t now)
{
    while (accept_some(http))
        MHD_run(http->daemon); /* closes the connections that others replaced */
    epoll_ctl(http->epoll_fd, EPOLL_CTL_DEL, http->listen_fd, NULL);
    close(http->listen_fd);
    http->listen_fd = -1;
    http->drain_began_ms = now;
}

static void cut_short(struct http *http, int64_t now)
{
    log_event("warn", "drain-timeout", "requests in flight are cancelled");
    atomic_store(&http->cut_short, true);
    http->cut_ms = now;
    for (struct connection *c = http->connections.first; c; c = c->next) {
        if (c->phase == PHASE_WORK || (c->exchange && http_is_streaming(c->exchange))) http_cancel_work(c->exchange);
        if (c->phase == PHASE_BODY) http_refuse(http, c, 503, "the daemon is shutting down");
    }
}

/* Load balancers look at /readyz and turn to other daemons, before this one refuses connections. */
static bool delay_has_passed(struct http *http, int64_t now)
{
    if (http->leave_began_ms == 0) http->leave_began_ms = now;
    if (now - http->leave_began_ms < (int64_t)http->config->drain_delay_ms) return false;
    atomic_store(&http->draining, true);
    return true;
}

/* Returns true once all requests are finished. A request that a client sent before it could know of the end is still
 * read for GRACE_MS, and then counts as in flight. */
static bool drain(struct http *http, int64_t now)
{
    if (!delay_has_passed(http, now)) return false;
    if (http->drain_began_ms == 0) begin_drain(http, now);
    const int64_t elapsed = now - http->drain_began_ms;
    if (http->in_flight == 0 && (http->connections.count == 0 || elapsed >= GRACE_MS)) return true;
    if (http->cut_ms == 0 && elapsed >= (int64_t)http->config->drain_timeout_ms && http->in_flight > 0)
        cut_short(http, now);
    if (http->cut_ms == 0 || now - http->cut_ms < CANCEL_MS) return false;
    if (!http->sockets_cut)
        for (struct connection *c = http->connections.first; c; c = c->next) {
            if (c->exchange && http_is_streaming(c->exchange)) http_cut_stream(c->exchange);
            shutdown(c->fd, SHUT_RDWR);
        }
    http->sockets_cut = true;
    return now - http->cut_ms >= 2 * CANCEL_MS;
}

/* ---- the loop ---- */

/* Takes the gate that http_change_gate has left, before further requests are read. */
static void take_gate(struct http *http)
{
    char text[160];
    struct gate *const next = atomic_load(&http->next_gate) ? atomic_exchange(&http->next_gate, NULL) : NULL;
    struct gate *const before = http->service->gate;
    if (!next) return;
    gate_describe(next, before, text, sizeof text);
    http->service->gate = next;
    gate_free(before);
    log_event("info", "reload", text);
}

static int smaller_wait(int a, int b)
{
    return a < 0 || (b >= 0 && b < a) ? b : a;
}

/* Returns the time between two checks of all connections, in ms. A resting listener resumes at the next check, even
 * without connections. */
static int tick_ms(const struct http *http)
{
    const int tick = connections_wait_ms(&http->connections);
    return http->listener_rests ? smaller_wait(tick, REST_MS) : tick;
}

static int wait_ms(struct http *http)
{
    int wait = tick_ms(http);
    MHD_UNSIGNED_LONG_LONG library_ms;
    if (MHD_get_timeout(http->daemon, &library_ms) == MHD_YES)
        wait = smaller_wait(wait, library_ms > INT32_MAX ? INT32_MAX : (int)library_ms);
    if (atomic_load(&http->leaving)) wait = smaller_wait(wait, REST_MS);
    return wait;
}

void http_loop_run(struct http *http)
{
    struct epoll_event events[EVENTS];
    int64_t checked_ms = clock_ms();
    for (;;) {
        const int tick = tick_ms(http);
        const int count = epoll_wait(http->epoll_fd, events, EVENTS, wait_ms(http));
        take_events(http, events, count);
        take_gate(http);
        http_take_reports(http);
        MHD_run(http->daemon);
        const int64_t now = clock_ms();
        if (tick >= 0 && now - checked_ms >= tick) {
            end_all_overdue(http, now);
            checked_ms = now;
        }
        if (atomic_load(&http->leaving) && drain(http, now)) return;
    }
}
