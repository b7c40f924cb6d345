/* connections.h - the list of all connections: phase, deadline, and the choice of one to close for a new client.
 *
 * libmicrohttpd's own timeout measures silence only, so a client that sends one byte per second would never time out.
 * Here each phase has an absolute deadline, and bodies and answers have a minimum rate.
 *
 *     IDLE -> HEADER -> BODY -> WORK -> WRITE -> IDLE
 *       BODY -> WRITE: answered without work
 *       WORK -> WRITE: with the first bytes of a streamed answer, while work goes on
 *       WRITE -> HEADER: bytes of the next request are here already
 *       any of these but WORK -> REFUSED: answered without libmicrohttpd; bytes that still arrive are discarded
 *
 * A phase is the state of a connection; a step (http_state.h) is the state of one request's exchange with
 * libmicrohttpd.
 *
 * Belongs to the thread of the loop; not thread-safe.
 */
#ifndef ZRASTERD_CONNECTIONS_H
#define ZRASTERD_CONNECTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "clients.h"
#include "config.h"
#include "framing.h"
#include "gate/forwarded.h"
#include "proxy_header.h"

enum phase { PHASE_IDLE, PHASE_HEADER, PHASE_BODY, PHASE_WORK, PHASE_WRITE, PHASE_REFUSED, PHASES };

struct exchange;

struct connection {
    struct connection *next, *previous; /* oldest first */
    int fd;
    struct ip peer, address; /* address: that of a PROXY header, else that of the peer */
    struct client *client;   /* with this address */
    struct client *asker;    /* counts the request in flight; NULL: none does */
    bool is_trusted;         /* a proxy's address: its requests may name their clients */
    bool awaits_proxy;       /* a PROXY header is asked for and not whole */
    struct proxy_header proxy;
    enum phase phase;
    int64_t began_ms, deadline_ms; /* of the phase */
    uint64_t body_bytes;           /* received in PHASE_BODY */
    /* In PHASE_WRITE: the time until which the client may pause reading; the bytes that its system had acknowledged at
     * the beginning of the phase, and at the last check. */
    int64_t credit_until_ms;
    uint64_t taken_before, taken_bytes;
    struct framing framing;
    uint64_t answered;         /* finished requests; framing.passed counts requests with a complete header */
    struct exchange *exchange; /* current request, or NULL */
    bool has_left;             /* the client has closed its sending half */
};

struct connections {
    const struct config *config;
    struct networks trusted; /* of --trusted-proxies */
    enum forwarded_form form;
    bool asks_for_proxy; /* trusted proxies begin connections by a PROXY header */
    bool is_short;       /* memory of answers, or streams: slow readers leave early */
    struct connection *first, *last;
    struct connection **by_fd;
    size_t fd_count;
    size_t counts[PHASES], count;
    struct clients clients;
};

bool connections_init(struct connections *connections, const struct config *config);
void connections_free(struct connections *connections);

/* Adds an accepted socket in PHASE_IDLE. NULL: out of memory, and the socket stays the caller's. */
struct connection *connections_add(struct connections *connections, int fd, const struct sockaddr *address);

/* Takes the bytes of a PROXY header from the front of those received, with the address that it names, and returns the
 * count of the others, which are moved to the front. A fault becomes that of connection->framing. */
size_t connections_take_proxy(struct connections *connections, struct connection *connection, char *bytes, size_t size);

/* Returns true if a PROXY header has begun and not ended. */
bool connections_is_within_proxy(const struct connection *connection);

/* Call before the socket is closed. */
void connections_remove(struct connections *connections, struct connection *connection);

/* Returns the connection of this socket, or NULL. */
struct connection *connections_find(const struct connections *connections, int fd);

/* Enters a phase and starts its time. */
void connections_enter(struct connections *connections, struct connection *connection, enum phase phase);

/* Moves the deadline of a reader in PHASE_WRITE by a wait for bytes. */
void connections_pause(struct connection *connection, int64_t ms);

/* Counts the request of the client with this address as in flight. Returns the setting that forbids it, as /v1/limits
 * has it, and its value; NULL: it is counted. */
const char *connections_admit(struct connections *connections, struct connection *connection, const struct ip *client,
                              uint64_t *most);

/* Ends the count of the request as in flight. */
void connections_release(struct connections *connections, struct connection *connection);

/* Returns the bytes of the current answer that the client's system has acknowledged; 0 outside PHASE_WRITE. */
uint64_t connections_taken(const struct connection *connection);

/* Returns the connection to close for a new one: a refused one, else one without a complete header, else one whose body
 * is arriving; among these, the oldest one of the client with the most connections. NULL: none. `soon`: some have
 * entered such a phase only just now. */
struct connection *connections_replaceable(const struct connections *connections, int64_t now_ms, bool *soon);

/* Action that a connection needs at a time. */
enum overdue {
    OVERDUE_NO,
    OVERDUE_CLOSE,  /* close it without an answer */
    OVERDUE_408,    /* its header or body came too slowly */
    OVERDUE_CANCEL, /* its work took too long */
    OVERDUE_READER  /* its client reads the answer too slowly */
};
enum overdue connections_overdue(const struct connections *connections, struct connection *connection, int64_t now_ms);

/* Returns the time until the next check for overdue connections, in ms; -1: none is needed. */
int connections_wait_ms(const struct connections *connections);

#endif
