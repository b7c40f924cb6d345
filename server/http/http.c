#include "http.h"

#include <errno.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "gate/gate.h"
#include "http_exchange.h"
#include "http_loop.h"
#include "http_receive.h"
#include "http_work.h"
#include "log/log_writer.h"
#include "metrics/metrics.h"

enum {
    BACKLOG = 512,
    /* The limits of framing.h fit it. More would be mapped per connection, not taken from the heap, which halves the
     * throughput under tenfold overload. */
    CONNECTION_MEMORY = 32 << 10,
    UNSENT_BYTES = 256 << 10,                          /* of an answer that the kernel holds unsent */
    ROOM_CONNECTIONS = 64 + HTTP_LOOPBACK_CONNECTIONS, /* beyond max-connections, while others close */
    QUEUE_CALM_MS = 2000
};

static int listen_on(const struct config *config, unsigned *port, char *message, size_t message_size)
{
    struct addrinfo hints = {.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM};
    hints.ai_flags = AI_PASSIVE | AI_NUMERICHOST | AI_NUMERICSERV;
    struct addrinfo *address = NULL;
    char service[16];
    snprintf(service, sizeof service, "%u", (unsigned)config->port);
    const int failure = getaddrinfo(config->address, service, &hints, &address);
    if (failure == EAI_MEMORY) return -1; /* http_start has set the message */
    if (failure != 0) {
        snprintf(message, message_size, "--address: '%.100s' is not a numeric IPv4 or IPv6 address", config->address);
        return -1;
    }
    int on = 1, unsent = UNSENT_BYTES;
    struct sockaddr_storage bound;
    socklen_t size = sizeof bound;
    int fd = socket(address->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd < 0 || setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
        setsockopt(fd, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent, sizeof unsent) != 0 || /* connections inherit it */
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
    /* Not strict: framing.h is strict, with every version of libmicrohttpd. No MHD_OPTION_CONNECTION_TIMEOUT:
     * connections.h has absolute deadlines for each phase. */
    return MHD_start_daemon(MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME | MHD_USE_NO_LISTEN_SOCKET, 0, NULL, NULL,
                            http_on_request, http, MHD_OPTION_STRICT_FOR_CLIENT, 0, MHD_OPTION_CONNECTION_LIMIT,
                            (unsigned)(http->config->max_connections + ROOM_CONNECTIONS),
                            MHD_OPTION_CONNECTION_MEMORY_LIMIT, (size_t)CONNECTION_MEMORY,
                            MHD_OPTION_SIGPIPE_HANDLED_BY_APP, 1, MHD_OPTION_URI_LOG_CALLBACK, http_on_request_line,
                            http, MHD_OPTION_NOTIFY_COMPLETED, http_on_completed, http, MHD_OPTION_NOTIFY_CONNECTION,
                            http_on_connection, http, MHD_OPTION_END);
}

/* On the thread of the loop. libmicrohttpd aborts if it stops with a suspended connection, so the workers end first. */
static void stop(struct http *http)
{
    queue_stop(http->queue); /* not destroyed: kept connections may still call it */
    http_take_reports(http);
    MHD_run(http->daemon);
    MHD_stop_daemon(http->daemon);
    http->daemon = NULL;
}

static void *serve(void *argument)
{
    struct http *http = argument;
    http_receive_for(http);
    http_loop_run(http);
    stop(http);
    return NULL;
}

static void free_http(struct http *http)
{
    http_receive_for(http);
    if (http->daemon) MHD_stop_daemon(http->daemon);
    http_receive_for(NULL);
    queue_destroy(http->queue);
    if (http->connections.by_fd) connections_free(&http->connections);
    const int fds[] = {http->listen_fd, http->epoll_fd, http->wake_fd};
    for (size_t i = 0; i < sizeof fds / sizeof fds[0]; i++)
        if (fds[i] >= 0) close(fds[i]);
    pthread_mutex_destroy(&http->lock);
    gate_free(atomic_load(&http->next_gate));
    free(http);
}

/* False: `message` has the reason, or memory or threads ran out. */
static bool start(struct http *http, char *message, size_t message_size)
{
    const struct config *config = http->config;
    http->epoll_fd = epoll_create1(EPOLL_CLOEXEC);
    http->wake_fd = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    http->queue = queue_create(&(struct queue_options){
        .workers = (size_t)config->workers,
        .stand_ins = (size_t)config->max_streams,
        .capacity = (size_t)config->queue,
        .request_memory_bytes = (size_t)config->request_memory_bytes,
        .keep_memory_bytes = (size_t)config->keep_memory_bytes,
        .calm_ms = QUEUE_CALM_MS,
    });
    if (!http->queue || !connections_init(&http->connections, config)) return false;
    http->daemon = start_daemon(http);
    if (!http->daemon || !http_loop_open(http)) return false;
    http_receive_for(http);
    const bool works = http_receive_works(http);
    http_receive_for(NULL);
    if (!works) {
        snprintf(message, message_size,
                 "libmicrohttpd %s does not receive through this program's recv(), which checks requests",
                 MHD_get_version());
        return false;
    }
    return pthread_create(&http->thread, NULL, serve, http) == 0;
}

/* For metrics, on the thread of the loop. */
static void look(void *context, struct metrics_now *now)
{
    struct http *http = context;
    const struct service *service = http->service;
    const struct queue_state queue = queue_look(http->queue);
    double *numbers = now->numbers;
    numbers[METRICS_WORKERS] = (double)queue.workers;
    numbers[METRICS_BUSY] = (double)queue.busy;
    numbers[METRICS_RENDER_BYTES] = (double)queue.used_bytes;
    numbers[METRICS_IN_PROGRESS] = (double)http->in_flight;
    numbers[METRICS_STREAMS] = (double)atomic_load(&http->streams);
    numbers[METRICS_CONNECTIONS_MAX] = (double)http->config->max_connections;
    numbers[METRICS_ANSWER_BYTES] = (double)atomic_load(&http->answer_bytes);
    numbers[METRICS_ANSWER_BYTES_MAX] = (double)http->config->answer_memory_bytes;
    numbers[METRICS_ASSET_BYTES] = service->store ? (double)store_bytes(service->store) : 0;
    numbers[METRICS_ASSET_BYTES_MAX] = (double)http->config->assets_max_bytes;
    numbers[METRICS_MEMORY_MAX] = service_memory_limit(service);
    numbers[METRICS_UPLOAD_BYTES] = (double)atomic_load(&http->uploads.held);
    numbers[METRICS_SHARED_ANSWERS] = (double)http->shared_answers;
    numbers[METRICS_LOST_LINES] = (double)log_writer_lost_ever();
    for (int i = 0; i < QUEUE_LANES; i++)
        now->waiting[i] = queue.waiting[i];
    for (int i = 0; i < PHASES; i++)
        now->connections[i] = http->connections.counts[i];
    for (int i = 0; i < KEPT_TABLES; i++)
        now->kept[i] = kept_look(service->kept[i]);
}

struct http *http_start(const struct config *config, struct service *service, char *message, size_t message_size)
{
    snprintf(message, message_size, "cannot start: out of memory or threads");
    struct http *http = calloc(1, sizeof *http);
    if (!http) return NULL;
    http->config = config;
    http->service = service;
    if (service->metrics) {
        service->metrics->look = look;
        service->metrics->context = http;
    }
    http->uploads.body_max = (size_t)config->body_max_bytes;
    http->uploads.memory_max = (size_t)config->upload_memory_bytes;
    http->epoll_fd = http->wake_fd = -1;
    pthread_mutex_init(&http->lock, NULL);
    http->listen_fd = listen_on(config, &http->port, message, message_size);
    if (http->listen_fd >= 0 && start(http, message, message_size)) return http;
    free_http(http);
    return NULL;
}

unsigned http_port(const struct http *http)
{
    return http->port;
}

void http_change_gate(struct http *http, struct gate *gate)
{
    gate_free(atomic_exchange(&http->next_gate, gate));
    http_loop_wake(http);
}

void http_stop(struct http *http)
{
    atomic_store(&http->leaving, true);
    http_loop_wake(http);
    pthread_join(http->thread, NULL);
    free_http(http);
}
