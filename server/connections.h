/* connections.h - all connections of the daemon: what each is doing, until when it may, and whose place a new one may
 * take.
 *
 * libmicrohttpd's own timeout measures silence only, so a client that drips a byte a second would live for ever. Here
 * every phase has an absolute end, and bodies and answers a least speed.
 *
 *     IDLE -> HEADER -> BODY -> WORK -> WRITE -> IDLE
 *       BODY -> WRITE: answered without work
 *       WRITE -> HEADER: some of the next request is there already
 *       any of these but WORK -> REFUSED: answered past libmicrohttpd; what still comes is thrown away
 *
 * A phase is what the connection does; a step (http_state.h) is how far one request's exchange with libmicrohttpd is.
 *
 * Belongs to the thread of the loop; nothing here is thread-safe.
 */
#ifndef ZRASTERD_CONNECTIONS_H
#define ZRASTERD_CONNECTIONS_H

#include <netinet/in.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "clients.h"
#include "config.h"
#include "framing.h"

enum phase { PHASE_IDLE, PHASE_HEADER, PHASE_BODY, PHASE_WORK, PHASE_WRITE, PHASE_REFUSED, PHASES };

struct exchange;

struct connection {
    struct connection *next, *previous; /* oldest first */
    int fd;
    char address[INET6_ADDRSTRLEN];
    struct client *client;
    enum phase phase;
    int64_t began_ms, deadline_ms; /* of the phase */
    uint64_t body_bytes;           /* received in PHASE_BODY */
    /* In PHASE_WRITE: how long the client may take nothing, and bytes that its system had taken when the phase began
     * and when that was last looked at. */
    int64_t credit_until_ms;
    uint64_t taken_before, taken_bytes;
    struct framing framing;
    uint64_t answered;         /* requests that are over; framing.passed counts those whose header was read */
    struct exchange *exchange; /* the request under way, or NULL */
    bool in_flight;            /* it counts for its client */
    bool has_left;             /* the client has closed its sending half */
};

struct connections {
    const struct config *config;
    struct connection *first, *last;
    struct connection **by_fd;
    size_t fd_count;
    size_t counts[PHASES], count;
    struct clients clients;
};

bool connections_init(struct connections *connections, const struct config *config);
void connections_free(struct connections *connections);

/* A socket that was accepted: PHASE_IDLE. NULL without memory; the socket stays the caller's. */
struct connection *connections_add(struct connections *connections, int fd, const struct sockaddr *address);

/* Call before the socket is closed. */
void connections_remove(struct connections *connections, struct connection *connection);

/* The connection that has this socket, or NULL. */
struct connection *connections_find(const struct connections *connections, int fd);

/* Moves on; the phase's time begins now. */
void connections_enter(struct connections *connections, struct connection *connection, enum phase phase);

/* Counts the request as in flight and returns true, unless its client has as many as it may. `most`: how many that is;
 * 0: any number. */
bool connections_admit(struct connections *connections, struct connection *connection, uint64_t *most);
/* The request is in flight no more. */
void connections_release(struct connection *connection);

/* Bytes of the answer that is being written that the client's system has taken; 0 in other phases. */
uint64_t connections_taken(const struct connection *connection);

/* Whom a new connection may push out: one that has had its refusal, else one without a whole request, else one whose
 * body is coming in; of these, of the client with the most connections the oldest. NULL: nobody; `soon`: some have only
 * just come to that. */
struct connection *connections_replaceable(const struct connections *connections, int64_t now_ms, bool *soon);

/* What is to be done about a connection at a time. */
enum overdue {
    OVERDUE_NO,
    OVERDUE_CLOSE,  /* without a word */
    OVERDUE_408,    /* its header or body came too slowly */
    OVERDUE_CANCEL, /* its work took too long */
    OVERDUE_READER  /* it takes its answer too slowly */
};
enum overdue connections_overdue(const struct connections *connections, struct connection *connection, int64_t now_ms);

/* How long nobody need look for what is overdue; -1: for ever. */
int connections_wait_ms(const struct connections *connections);

#endif
