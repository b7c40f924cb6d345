#include "http.h"

#include <errno.h>
#include <netdb.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "clock.h"
#include "http_exchange.h"
#include "http_work.h"
#include "log.h"

/* Up to 0.9.75 strictness 1 adds two checks, a missing Host and a space in the
 * URI, and answers with its header sent twice or not at all: http_guard.c makes
 * both. Later versions refuse more with it, and properly. */
enum { STRICTNESS = MHD_VERSION > 0x00097599 ? 1 : 0 };

enum {
    BACKLOG = 512,
    CONNECTION_MEMORY = 128 << 10, /* headers of 32 KiB, parsed, and an answer's, with room to spare */
    THREAD_STACK = 512 << 10,
    QUEUE_CALM_MS = 2000,
    CANCEL_MS = 2000, /* after a drain that took too long: for cancelled work to be answered */
    GRACE_MS = 1000,  /* at its begin: for what is on its way already to be read */
    GRACE_STEP_MS = 5
};

static int listen_on(const struct config *config, unsigned *port, char *message, size_t message_size)
{
    struct addrinfo hints = {.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM};
    hints.ai_flags = AI_PASSIVE | AI_NUMERICHOST | AI_NUMERICSERV;
    struct addrinfo *address = NULL;
    char service[16];
    snprintf(service, sizeof service, "%u", (unsigned)config->port);
    if (getaddrinfo(config->address, service, &hints, &address) != 0) {
        snprintf(message, message_size, "--address: '%.100s' is not a numeric IPv4 or IPv6 address", config->address);
        return -1;
    }
    int on = 1;
    struct sockaddr_storage bound;
    socklen_t size = sizeof bound;
    int fd = socket(address->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd < 0 || setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
        bind(fd, address->ai_addr, address->ai_addrlen) != 0 || listen(fd, BACKLOG) != 0 ||
        getsockname(fd, (struct sockaddr *)&bound, &size) != 0) {
        snprintf(message, message_size, "cannot listen on %.100s port %s: %s", config->address, service,
                 strerror(errno));
        if (fd >= 0) close(fd);
        fd = -1;
    } else if (bound.ss_family == AF_INET6) {
        *port = ntohs(((struct sockaddr_in6 *)(void *)&bound)->sin6_port);
    } else {
        *port = ntohs(((struct sockaddr_in *)(void *)&bound)->sin_port);
    }
    freeaddrinfo(address);
    return fd;
}

static struct MHD_Daemon *start_daemon(struct http *http)
{
    /* No MHD_OPTION_CONNECTION_TIMEOUT: the watchdog has absolute deadlines for everything. */
    return MHD_start_daemon(MHD_USE_EPOLL | MHD_USE_INTERNAL_POLLING_THREAD | MHD_ALLOW_SUSPEND_RESUME, 0, NULL, NULL,
                            http_on_request, http, MHD_OPTION_LISTEN_SOCKET, http->listen_fd,
                            MHD_OPTION_STRICT_FOR_CLIENT, STRICTNESS, MHD_OPTION_CONNECTION_LIMIT,
                            (unsigned)http->config->max_connections, MHD_OPTION_CONNECTION_MEMORY_LIMIT,
                            (size_t)CONNECTION_MEMORY, MHD_OPTION_THREAD_STACK_SIZE, (size_t)THREAD_STACK,
                            MHD_OPTION_SIGPIPE_HANDLED_BY_APP, 1, MHD_OPTION_URI_LOG_CALLBACK, http_on_request_line,
                            http, MHD_OPTION_NOTIFY_COMPLETED, http_on_completed, http, MHD_OPTION_NOTIFY_CONNECTION,
                            http_on_connection, http, MHD_OPTION_END);
}

static void free_http(struct http *http)
{
    queue_destroy(http->queue);
    watchdog_destroy(http->watchdog);
    if (http->listen_fd >= 0) close(http->listen_fd);
    pthread_cond_destroy(&http->exchange_ended);
    pthread_mutex_destroy(&http->lock);
    free(http);
}

struct http *http_start(const struct config *config, struct api *api, char *message, size_t message_size)
{
    snprintf(message, message_size, "cannot start: out of memory or threads");
    struct http *http = calloc(1, sizeof *http);
    if (!http) return NULL;
    http->config = config;
    http->api = api;
    http->uploads.body_max = (size_t)config->body_max_bytes;
    http->uploads.memory_max = (size_t)config->upload_memory_bytes;
    pthread_mutex_init(&http->lock, NULL);
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_cond_init(&http->exchange_ended, &attributes);
    pthread_condattr_destroy(&attributes);
    http->listen_fd = listen_on(config, &http->port, message, message_size);
    if (http->listen_fd >= 0) {
        http->queue = queue_create(&(struct queue_options){
            .workers = (size_t)config->workers,
            .capacity = (size_t)config->queue,
            .request_memory_bytes = (size_t)config->request_memory_bytes,
            .keep_memory_bytes = (size_t)config->keep_memory_bytes,
            .calm_ms = QUEUE_CALM_MS,
        });
        http->watchdog = watchdog_create(config, &HTTP_WATCHDOG_CALLS, http);
        if (http->queue && http->watchdog) http->daemon = start_daemon(http);
    }
    if (http->daemon) return http;
    free_http(http);
    return NULL;
}

unsigned http_port(const struct http *http)
{
    return http->port;
}

/* True once every exchange has ended; false when `timeout_ms` were not enough. */
static bool wait_for_exchanges(struct http *http, uint64_t timeout_ms)
{
    const struct timespec until = clock_after_ms(timeout_ms);
    int timed_out = 0;
    pthread_mutex_lock(&http->lock);
    while (http->in_flight > 0 && !timed_out)
        timed_out = pthread_cond_timedwait(&http->exchange_ended, &http->lock, &until);
    bool all_ended = http->in_flight == 0;
    pthread_mutex_unlock(&http->lock);
    return all_ended;
}

/* Where libmicrohttpd takes no more connections: the answer goes out past it. What has come
 * is read first, or closing would reset the connection under the answer. */
static void turn_away(struct http *http, int fd)
{
    char bytes[4096];
    struct answer answer = {0};
    struct api_request nameless = {0};
    api_take_id(http->api, &nameless, NULL);
    api_refuse_busy(&answer, 1, "the service is going down");
    api_finish(&answer, nameless.id);
    for (int reads = 0; reads < BACKLOG && recv(fd, bytes, sizeof bytes, MSG_DONTWAIT) > 0; reads++)
        continue;
    answer_send(&answer, fd);
    answer_free(&answer);
    close(fd);
}

/* Connections that the kernel has made and nobody has accepted would be reset when the
 * socket closes: they are taken in, and told that the service is going down. True where libmicrohttpd
 * got some, which its thread may not have looked at yet. */
static bool take_backlog(struct http *http)
{
    bool any_added = false;
    struct sockaddr_storage address;
    socklen_t size = sizeof address;
    uint64_t taken = 0; /* that libmicrohttpd's thread may not have counted yet */
    for (int fd; (fd = accept4(http->listen_fd, (struct sockaddr *)&address, &size, SOCK_NONBLOCK | SOCK_CLOEXEC)) >= 0;
         size = sizeof address) {
        const union MHD_DaemonInfo *info = MHD_get_daemon_info(http->daemon, MHD_DAEMON_INFO_CURRENT_CONNECTIONS);
        if (info && info->num_connections + ++taken < http->config->max_connections) {
            MHD_add_connection(http->daemon, fd, (struct sockaddr *)&address, size);
            any_added = true;
        } else {
            turn_away(http, fd);
        }
    }
    return any_added;
}

/* What was sent on an open connection before the end was known is heard: only then does
 * it count as in flight. Nobody can tell how long to listen, so it is short. some_to_come: connections
 * have been added that are not counted yet. */
static void listen_once_more(struct http *http, bool some_to_come)
{
    for (int ms = 0; ms < GRACE_MS; ms += GRACE_STEP_MS) {
        const union MHD_DaemonInfo *info = MHD_get_daemon_info(http->daemon, MHD_DAEMON_INFO_CURRENT_CONNECTIONS);
        if (!info || (info->num_connections == 0 && !some_to_come)) return;
        if (info->num_connections > 0) some_to_come = false;
        nanosleep(&(struct timespec){.tv_nsec = GRACE_STEP_MS * 1000000L}, NULL);
    }
}

void http_stop(struct http *http)
{
    atomic_store(&http->draining, true);
    MHD_quiesce_daemon(http->daemon);
    bool some_to_come = take_backlog(http);
    shutdown(http->listen_fd,
             SHUT_RD); /* takes no more; closed at the end, for libmicrohttpd's thread may still ask it */
    listen_once_more(http, some_to_come);
    bool ended = wait_for_exchanges(http, http->config->drain_timeout_ms);
    if (!ended) {
        log_event("warn", "drain-timeout", "what is in flight is cut short");
        atomic_store(&http->cut_short, true);
        watchdog_cut_short(http->watchdog, false);
        ended = wait_for_exchanges(http, CANCEL_MS);
    }
    if (!ended) watchdog_cut_short(http->watchdog, true);
    /* The workers must have resumed their connections: stopping with one suspended aborts. */
    queue_stop(http->queue); /* not destroyed: kept connections may still ask it */
    if (!ended) wait_for_exchanges(http, CANCEL_MS);
    MHD_stop_daemon(http->daemon);
    free_http(http);
}
