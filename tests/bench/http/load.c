#include "bench/http/load.h"

#include <arpa/inet.h>
#include <errno.h>
#include <netinet/tcp.h>
#include <sched.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "bench/bench.h"
#include "bench/series.h"

enum { HEAD_SIZE = 4096, EVENTS = 256, PROBE_EVERY_MS = 20, SAMPLES_MAX = 1 << 20, FAILED_MS = 10000 };

static const char HEALTH[] = "GET /healthz HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n";

/* The beginning of requests, up to their number. */
enum { LOAD_HEAD_SIZE = 256 };
#define NUMBER "; number="

struct samples {
    double *ms;
    size_t count;
};

struct client {
    int fd; /* -1: to be connected when its turn comes */
    bool is_probe, busy, ends;
    const char *request;
    size_t size, sent;
    char own[LOAD_HEAD_SIZE]; /* beginning of the request, with a number of its own */
    size_t own_size;
    char head[HEAD_SIZE];
    size_t head_size, body_left;
    bool has_head;
    int status;
    double begun_ms, turn_ms, every_ms;
};

struct run {
    const struct load *load;
    int epoll_fd;
    struct client clients[LOAD_CONNECTIONS_MAX + 1];
    int count;
    struct samples served, probes;
    size_t refused, failed;
};

static void add_sample(struct samples *samples, double ms)
{
    if (samples->count < SAMPLES_MAX) samples->ms[samples->count++] = ms;
}

static void hang_up(struct client *client)
{
    if (client->fd >= 0) close(client->fd);
    client->fd = -1;
    client->busy = false;
}

static bool dial(struct run *run, struct client *client)
{
    const struct sockaddr_in address = {
        .sin_family = AF_INET, .sin_port = htons((uint16_t)run->load->port), .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    const int on = 1;
    struct epoll_event event = {.events = EPOLLIN | EPOLLOUT | EPOLLET, .data.ptr = client};
    client->fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (client->fd < 0) return false;
    setsockopt(client->fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    const int status = connect(client->fd, (const struct sockaddr *)&address, sizeof address);
    if ((status != 0 && errno != EINPROGRESS) || epoll_ctl(run->epoll_fd, EPOLL_CTL_ADD, client->fd, &event) != 0) {
        hang_up(client);
        return false;
    }
    return true;
}

static void write_more(struct client *client)
{
    while (client->busy && client->sent < client->size) {
        const bool is_own = client->sent < client->own_size;
        const char *from = is_own ? client->own : client->request;
        const size_t end = is_own ? client->own_size : client->size;
        const ssize_t count = send(client->fd, from + client->sent, end - client->sent, MSG_NOSIGNAL);
        if (count <= 0) return; /* what it ended with is there to be read */
        client->sent += (size_t)count;
    }
}

static void begin(struct run *run, struct client *client, double now)
{
    client->busy = true;
    client->has_head = client->ends = false;
    client->sent = client->head_size = client->body_left = 0;
    client->status = 0;
    client->begun_ms = now;
    client->turn_ms += client->every_ms;
    if (client->turn_ms < now - client->every_ms)
        client->turn_ms = now; /* turns that were missed are not made up for */
    if (client->fd < 0 && !dial(run, client)) {
        client->busy = false;
        run->failed++;
        return;
    }
    write_more(client);
}

static void end(struct run *run, struct client *client)
{
    const double took = now_ms() - client->begun_ms;
    if (client->is_probe)
        add_sample(&run->probes, client->status == 200 ? took : FAILED_MS);
    else if (client->status == 200)
        add_sample(&run->served, took);
    else if (client->status)
        run->refused++;
    else
        run->failed++;
    client->busy = false;
    if (client->ends || client->is_probe || client->status == 0) hang_up(client);
}

static void take_head(struct client *client)
{
    client->head[client->head_size] = '\0';
    char *end = strstr(client->head, "\r\n\r\n");
    if (!end) return;
    const char *length = strcasestr(client->head, "\r\nContent-Length:");
    const size_t behind = client->head_size - (size_t)(end + 4 - client->head);
    const size_t body = length ? strtoul(length + 17, NULL, 10) : 0;
    client->has_head = true;
    client->ends = strcasestr(client->head, "\r\nConnection: close");
    client->status = atoi(client->head + 9);
    client->body_left = body > behind ? body - behind : 0;
}

static void read_more(struct run *run, struct client *client)
{
    static char thrown_away[256 << 10];
    while (client->fd >= 0) {
        ssize_t count;
        if (client->busy && !client->has_head)
            count = recv(client->fd, client->head + client->head_size, HEAD_SIZE - 1 - client->head_size, 0);
        else
            count = recv(client->fd, thrown_away, sizeof thrown_away, 0);
        if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
        if (count <= 0) {
            if (client->busy) {
                if (!client->has_head) client->status = 0;
                client->ends = true;
                end(run, client);
            } else {
                hang_up(client);
            }
            return;
        }
        if (!client->busy) continue;
        if (!client->has_head) {
            client->head_size += (size_t)count;
            take_head(client);
        } else {
            client->body_left -= (size_t)count < client->body_left ? (size_t)count : client->body_left;
        }
        if (client->has_head && client->body_left == 0) end(run, client);
    }
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double percentile(struct samples *samples, double percent)
{
    if (samples->count == 0) return -1.0;
    qsort(samples->ms, samples->count, sizeof *samples->ms, by_size);
    return samples->ms[(size_t)((double)(samples->count - 1) * percent / 100.0)];
}

static void give_number(struct client *client, int number)
{
    const char *end = memmem(client->request, client->size, NUMBER, sizeof NUMBER - 1);
    const size_t before = end ? (size_t)(end - client->request) + sizeof NUMBER - 1 : sizeof client->own;
    if (before + 4 >= sizeof client->own) return;
    memcpy(client->own, client->request, before);
    client->own_size = before + (size_t)sprintf(client->own + before, "%04d", number % 10000);
}

static void prepare(struct run *run, double now)
{
    const struct load *load = run->load;
    const double every = load->per_second > 0 ? 1000.0 * load->connections / load->per_second : 0.0;
    for (int i = 0; i < load->connections; i++)
        run->clients[run->count++] = (struct client){.fd = -1,
                                                     .request = load->request,
                                                     .size = load->size,
                                                     .every_ms = every,
                                                     .turn_ms = now + every * i / load->connections};
    for (int i = 0; i < run->count && !load->is_equal; i++)
        give_number(&run->clients[i], i);
    if (load->probe)
        run->clients[run->count++] = (struct client){.fd = -1,
                                                     .is_probe = true,
                                                     .request = HEALTH,
                                                     .size = sizeof HEALTH - 1,
                                                     .every_ms = PROBE_EVERY_MS,
                                                     .turn_ms = now};
}

static void drive(struct run *run, double until)
{
    struct epoll_event events[EVENTS];
    for (double now = now_ms(); now < until; now = now_ms()) {
        double next = until;
        for (int i = 0; i < run->count; i++) {
            struct client *client = &run->clients[i];
            if (!client->busy && client->turn_ms <= now) begin(run, client, now);
            if (!client->busy && client->turn_ms < next) next = client->turn_ms;
        }
        const double wait = next - now_ms();
        const int count = epoll_wait(run->epoll_fd, events, EVENTS, wait <= 0 ? 0 : wait < 1 ? 1 : (int)wait);
        for (int i = 0; i < count; i++) {
            struct client *client = events[i].data.ptr;
            if (client->fd >= 0 && (events[i].events & EPOLLOUT)) write_more(client);
            if (client->fd >= 0 && (events[i].events & (EPOLLIN | EPOLLHUP | EPOLLERR))) read_more(run, client);
        }
    }
}

bool load_run(const struct load *load, struct load_result *result)
{
    struct run *run = calloc(1, sizeof *run);
    bool ok = run && (run->epoll_fd = epoll_create1(EPOLL_CLOEXEC)) >= 0;
    if (ok) {
        run->load = load;
        run->served.ms = malloc(SAMPLES_MAX * sizeof(double));
        run->probes.ms = malloc(SAMPLES_MAX * sizeof(double));
        ok = run->served.ms && run->probes.ms;
    }
    if (ok) {
        const double begun = now_ms();
        prepare(run, begun);
        drive(run, begun + load->seconds * 1000.0);
        const double seconds = (now_ms() - begun) / 1000.0;
        *result = (struct load_result){.served = (double)run->served.count / seconds,
                                       .refused = (double)run->refused / seconds,
                                       .failed = (double)run->failed / seconds,
                                       .p50_ms = percentile(&run->served, 50),
                                       .p99_ms = percentile(&run->served, 99),
                                       .probe_p99_ms = percentile(&run->probes, 99)};
        for (int i = 0; i < run->count; i++)
            hang_up(&run->clients[i]);
        close(run->epoll_fd);
        free(run->served.ms);
        free(run->probes.ms);
    }
    free(run);
    return ok || bench_complain("no load could be made: no memory or descriptors");
}

static void take_processors(bool first)
{
    cpu_set_t all, mine;
    static cpu_set_t allowed;
    if (CPU_COUNT(&allowed) == 0) sched_getaffinity(0, sizeof allowed, &allowed);
    all = allowed;
    if (CPU_COUNT(&all) < 2) return;
    CPU_ZERO(&mine);
    bool is_first = true;
    for (size_t cpu = 0; cpu < CPU_SETSIZE; cpu++) {
        if (!CPU_ISSET(cpu, &all)) continue;
        if (is_first == first) CPU_SET(cpu, &mine);
        is_first = false;
    }
    sched_setaffinity(0, sizeof mine, &mine);
}

char *load_make_request(const char *target, const char *type, const void *body, size_t body_size, size_t *size)
{
    char head[LOAD_HEAD_SIZE];
    const int length =
        snprintf(head, sizeof head,
                 "POST %s HTTP/1.1\r\nHost: a\r\nContent-Type: %s" NUMBER "0000\r\nContent-Length: %zu\r\n\r\n", target,
                 type, body_size);
    char *request = malloc((size_t)length + body_size);
    if (!request) return NULL;
    memcpy(request, head, (size_t)length);
    memcpy(request + length, body, body_size);
    *size = (size_t)length + body_size;
    return request;
}

void load_take_first_processor(void)
{
    take_processors(true);
}

void load_take_other_processors(void)
{
    take_processors(false);
}
