#include "connections.h"

#include <linux/tcp.h>
#include <math.h>
#include <netinet/in.h>
#include <stdlib.h>
#include <string.h>

#include "clock.h"

enum {
    TICK_WORK_MS = 20, /* during work: the end of work is noticed within this time */
    TICK_MS = 50,
    TICK_IDLE_MS = 1000,
    RATE_GRACE_MS = 5000,   /* before the rate of a body or of a reader is measured */
    CREDIT_MS = 20500,      /* longest time without reading that a fast reader can earn: 20 s, and to begin again */
    SHORT_CREDIT_MS = 5000, /* the same, and the factor of the minimum rate, while answers of others lack room */
    SHORT_RATE = 16,
    LINGER_MS = 2000, /* a refused client may go on sending: closing at once would reset the connection before it reads
                         the refusal */
    JUST_BEGUN_MS = 50, /* a younger connection may have sent bytes that are not read yet */
    FDS_MIN = 256
};

bool connections_init(struct connections *connections, const struct config *config)
{
    *connections = (struct connections){.config = config, .fd_count = FDS_MIN};
    networks_parse(&connections->trusted, config->trusted_proxies); /* config_read has checked both texts */
    forwarded_form_parse(&connections->form, config->client_header);
    connections->asks_for_proxy = strcmp(config->proxy_protocol, "on") == 0;
    connections->by_fd = calloc(FDS_MIN, sizeof *connections->by_fd);
    return connections->by_fd;
}

void connections_free(struct connections *connections)
{
    while (connections->first)
        connections_remove(connections, connections->first);
    free(connections->by_fd);
    connections->by_fd = NULL;
}

/* Returns the bytes of all answers that the client's system has acknowledged. */
static uint64_t bytes_taken(const struct connection *connection)
{
    struct tcp_info info = {0};
    socklen_t size = sizeof info;
    if (getsockopt(connection->fd, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return 0;
    return info.tcpi_bytes_acked;
}

/* ---- the list ---- */

static bool make_room(struct connections *connections, size_t fd)
{
    size_t count = connections->fd_count;
    while (count <= fd)
        count *= 2;
    if (count == connections->fd_count) return true;
    struct connection **grown = realloc(connections->by_fd, count * sizeof(struct connection *));
    if (!grown) return false;
    memset(grown + connections->fd_count, 0, (count - connections->fd_count) * sizeof *grown);
    connections->by_fd = grown;
    connections->fd_count = count;
    return true;
}

static bool is_waiting(enum phase phase)
{
    return phase == PHASE_IDLE || phase == PHASE_HEADER;
}

static void count_phase(struct connections *connections, struct connection *connection, bool in)
{
    size_t *count = &connections->counts[connection->phase];
    *count = in ? *count + 1 : *count - 1;
}

static void trust(const struct connections *connections, struct connection *connection)
{
    connection->is_trusted = networks_contain(&connections->trusted, &connection->address);
    connection->framing.reads_client = connection->is_trusted;
}

struct connection *connections_add(struct connections *connections, int fd, const struct sockaddr *address)
{
    struct connection *old = connections_find(connections, fd);
    if (old) connections_remove(connections, old); /* libmicrohttpd closed it before it added it */
    const struct ip peer = ip_of_socket(address);
    struct connection *connection = calloc(1, sizeof *connection);
    if (!connection || !make_room(connections, (size_t)fd) ||
        !(connection->client = clients_join(&connections->clients, &peer))) {
        free(connection);
        return NULL;
    }
    connection->peer = connection->address = peer;
    trust(connections, connection);
    connection->awaits_proxy = connection->is_trusted && connections->asks_for_proxy;
    connection->fd = fd;
    connection->previous = connections->last;
    if (connections->last)
        connections->last->next = connection;
    else
        connections->first = connection;
    connections->last = connection;
    connections->by_fd[fd] = connection;
    connections->count++;
    connection->began_ms = clock_ms();
    connection->deadline_ms = connection->began_ms + (int64_t)connections->config->header_timeout_ms;
    count_phase(connections, connection, true);
    return connection;
}

void connections_remove(struct connections *connections, struct connection *connection)
{
    connections_release(connections, connection);
    count_phase(connections, connection, false);
    if (connection->previous)
        connection->previous->next = connection->next;
    else
        connections->first = connection->next;
    if (connection->next)
        connection->next->previous = connection->previous;
    else
        connections->last = connection->previous;
    connections->by_fd[connection->fd] = NULL;
    connections->count--;
    clients_leave(&connections->clients, connection->client);
    free(connection);
}

static void take_source(struct connections *connections, struct connection *connection)
{
    struct client *client = clients_join(&connections->clients, &connection->proxy.source);
    if (!client) {
        framing_refuse(&connection->framing, 503, "out of memory");
        return;
    }
    clients_leave(&connections->clients, connection->client);
    connection->client = client;
    connection->address = connection->proxy.source;
    trust(connections, connection);
}

bool connections_is_within_proxy(const struct connection *connection)
{
    return connection->awaits_proxy && connection->proxy.taken > 0;
}

size_t connections_take_proxy(struct connections *connections, struct connection *connection, char *bytes, size_t size)
{
    struct proxy_header *proxy = &connection->proxy;
    if (!connection->awaits_proxy) {
        const struct framing *framing = &connection->framing;
        const bool is_first = framing->state == FRAMING_START && framing->passed == 0 && framing->empty_lines == 0;
        if (is_first && proxy_header_begins(bytes, size))
            framing_refuse(&connection->framing, 400,
                           connection->is_trusted
                               ? "a PROXY header, which --proxy-protocol=on would read"
                               : "a PROXY header from an address that --trusted-proxies does not name");
        return size;
    }
    const size_t taken = proxy_header_take(proxy, bytes, size);
    if (proxy->wrong) framing_refuse(&connection->framing, 400, proxy->wrong);
    if (proxy->is_whole) {
        connection->awaits_proxy = false;
        if (proxy->has_source)
            take_source(connections, connection);
        else /* the headers may be those of an unknown client */
            connection->is_trusted = connection->framing.reads_client = false;
    }
    memmove(bytes, bytes + taken, size - taken);
    return size - taken;
}

struct connection *connections_find(const struct connections *connections, int fd)
{
    return fd >= 0 && (size_t)fd < connections->fd_count ? connections->by_fd[fd] : NULL;
}

/* ---- phases ---- */

static int64_t time_for(const struct config *config, enum phase phase)
{
    switch (phase) {
    case PHASE_IDLE:
        return (int64_t)config->idle_timeout_ms;
    case PHASE_HEADER:
        return (int64_t)config->header_timeout_ms;
    case PHASE_BODY:
        return (int64_t)config->body_timeout_ms;
    case PHASE_WRITE:
        return (int64_t)config->write_timeout_ms;
    case PHASE_REFUSED:
        return LINGER_MS;
    default: /* work: its time starts with a worker */
        return INT64_MAX / 2;
    }
}

void connections_enter(struct connections *connections, struct connection *connection, enum phase phase)
{
    count_phase(connections, connection, false);
    connection->phase = phase;
    count_phase(connections, connection, true);
    connection->began_ms = clock_ms();
    connection->deadline_ms = connection->began_ms + time_for(connections->config, phase);
    connection->body_bytes = 0;
    if (phase == PHASE_WRITE) {
        connection->credit_until_ms = connection->began_ms + RATE_GRACE_MS;
        connection->taken_before = connection->taken_bytes = bytes_taken(connection);
    }
    /* PHASE_HEADER, too: bytes of it may have come with the request before. */
    if (is_waiting(phase) || phase == PHASE_REFUSED) connections_release(connections, connection);
}

void connections_pause(struct connection *connection, int64_t ms)
{
    connection->deadline_ms += ms;
    connection->credit_until_ms += ms;
}

const char *connections_admit(struct connections *connections, struct connection *connection, const struct ip *address,
                              uint64_t *most)
{
    const struct config *config = connections->config;
    struct client *client = connection->client;
    if (!ip_is_same(address, &connection->address)) client = clients_join(&connections->clients, address);
    if (!client) client = connection->client; /* out of memory */
    *most = client->is_private ? config->max_per_private_client : config->max_per_client;
    const char *forbids = client->is_private ? "maxPerPrivateClient" : "maxPerClient";
    connection->asker = client;
    client->in_flight++;
    if (*most == 0 || client->in_flight <= *most) return NULL;
    connections_release(connections, connection);
    return forbids;
}

void connections_release(struct connections *connections, struct connection *connection)
{
    struct client *asker = connection->asker;
    if (!asker) return;
    asker->in_flight--;
    if (asker != connection->client) clients_leave(&connections->clients, asker);
    connection->asker = NULL;
}

/* Returns the priority for giving up a place; 0: never. */
static int rank(enum phase phase)
{
    return phase == PHASE_REFUSED ? 3 : is_waiting(phase) ? 2 : phase == PHASE_BODY ? 1 : 0;
}

struct connection *connections_replaceable(const struct connections *connections, int64_t now_ms, bool *soon)
{
    struct connection *best = NULL;
    int best_rank = 0;
    *soon = false;
    for (struct connection *c = connections->first; c; c = c->next) {
        const int its_rank = rank(c->phase);
        if (its_rank == 0 || its_rank < best_rank) continue;
        if (now_ms - c->began_ms < JUST_BEGUN_MS) {
            *soon = true;
        } else if (its_rank > best_rank || c->client->connections > best->client->connections) {
            best = c;
            best_rank = its_rank;
        }
    }
    return best;
}

/* ---- deadlines ---- */

/* The rate is the average since the beginning of the body. */
static bool body_is_slow(const struct connections *connections, const struct connection *connection, int64_t now)
{
    const int64_t elapsed = now - connection->began_ms;
    return elapsed > RATE_GRACE_MS && (double)connection->body_bytes * 1000.0 <
                                          (double)connections->config->body_min_bytes_per_second * (double)elapsed;
}

/* Each byte that the client's system acknowledges earns the reader its time at the minimum rate, up to CREDIT_MS. A
 * system acknowledges as much as its buffers hold, then nothing until half of that is read. */
static bool reader_is_slow(const struct connections *connections, struct connection *connection, int64_t now)
{
    const bool is_short = connections->is_short;
    const double least = (double)connections->config->answer_min_bytes_per_second * (is_short ? SHORT_RATE : 1);
    const int64_t latest = now + (is_short ? SHORT_CREDIT_MS : CREDIT_MS);
    if (least <= 0.0) return false;
    const uint64_t taken = bytes_taken(connection), more = taken - connection->taken_bytes;
    connection->taken_bytes = taken;
    if (more > 0) {
        const int64_t from = connection->credit_until_ms > now ? connection->credit_until_ms : now;
        connection->credit_until_ms = (int64_t)fmin((double)from + (double)more * 1000.0 / least, (double)latest);
    }
    if (connection->credit_until_ms > latest) connection->credit_until_ms = latest;
    return now > connection->credit_until_ms;
}

uint64_t connections_taken(const struct connection *connection)
{
    return connection->phase == PHASE_WRITE ? bytes_taken(connection) - connection->taken_before : 0;
}

enum overdue connections_overdue(const struct connections *connections, struct connection *connection, int64_t now_ms)
{
    const bool is_over = now_ms >= connection->deadline_ms;
    switch (connection->phase) {
    case PHASE_HEADER:
        return is_over ? OVERDUE_408 : OVERDUE_NO;
    case PHASE_BODY:
        return is_over || body_is_slow(connections, connection, now_ms) ? OVERDUE_408 : OVERDUE_NO;
    case PHASE_WORK:
        return is_over ? OVERDUE_CANCEL : OVERDUE_NO;
    case PHASE_WRITE:
        return is_over || reader_is_slow(connections, connection, now_ms) ? OVERDUE_READER : OVERDUE_NO;
    default:
        return is_over ? OVERDUE_CLOSE : OVERDUE_NO;
    }
}

int connections_wait_ms(const struct connections *connections)
{
    const size_t *counts = connections->counts;
    if (counts[PHASE_WORK] > 0) return TICK_WORK_MS;
    if (connections->count > counts[PHASE_IDLE]) return TICK_MS;
    return connections->count > 0 ? TICK_IDLE_MS : -1;
}
