/* watchdog.h - absolute deadlines, and clients that leave.
 *
 * libmicrohttpd's own timeout measures silence only, so a client that drips a
 * byte a second lives for ever; and it does not look at a connection while a
 * worker has its request. One thread here looks at every connection a few dozen
 * times a second. It touches a socket only while its watch is in the list, and
 * whoever closes the socket takes the watch out first.
 *
 *     WATCH_HEADER -> WATCH_BODY -> WATCH_WORK -> WATCH_WRITE -> WATCH_HEADER
 *           any of these but WATCH_WORK -> WATCH_REFUSED (answered; the rest is thrown away)
 */
#ifndef ZRASTERD_WATCHDOG_H
#define ZRASTERD_WATCHDOG_H

#include <netinet/in.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "answer.h"
#include "config.h"

enum watch_phase { WATCH_HEADER, WATCH_BODY, WATCH_WORK, WATCH_WRITE, WATCH_REFUSED };

/* One connection. The fields are the watchdog's; others go through functions. */
struct watch {
    struct watch *next, *previous;
    int socket_fd;
    char address[INET6_ADDRSTRLEN];
    enum watch_phase phase;
    int64_t began_ms, deadline_ms;
    int64_t idle_deadline_ms;    /* of a kept connection in WATCH_HEADER; 0: its first request */
    uint64_t received_before;    /* bytes on the socket when the last request had been read */
    uint64_t body_bytes;         /* received since began_ms */
    struct zr_cancel *cancel;    /* in WATCH_WORK */
    void *owner;                 /* the request that the connection is busy with, NULL between two */
    bool client_left, in_flight; /* in_flight: counts for max-per-client */
    bool ended;                  /* by libmicrohttpd's thread only: no further request is expected */
};

/* What the watchdog asks of its user; called with its lock held, but for `release`. */
struct watchdog_calls {
    /* Makes the 408 for a connection whose deadline passed in WATCH_HEADER or WATCH_BODY. */
    void (*expired)(void *context, struct watch *watch, struct answer *answer);
    /* The client left: true where nobody works on the request yet and nobody will. */
    bool (*withdraw)(void *context, void *owner);
    /* Afterwards, for each that was withdrawn. */
    void (*release)(void *context, void *owner);
};

struct watchdog;

struct watchdog *watchdog_create(const struct config *config, const struct watchdog_calls *calls, void *context);
void watchdog_destroy(struct watchdog *watchdog);

void watchdog_add(struct watchdog *watchdog, struct watch *watch);
void watchdog_remove(struct watchdog *watchdog, struct watch *watch);

/* Moves on to HEADER, BODY or WRITE; the phase's time starts now. False where the connection was given up. */
bool watchdog_enter(struct watchdog *watchdog, struct watch *watch, enum watch_phase phase, void *owner);

/* Moves on to WATCH_WORK: from now on the client is looked after. False as above. */
bool watchdog_enter_work(struct watchdog *watchdog, struct watch *watch, struct zr_cancel *cancel);

/* A worker begins: the time for a render starts. */
void watchdog_work_begins(struct watchdog *watchdog, struct watch *watch);

/* It has given the work up, for another worker to begin again. */
void watchdog_work_waits(struct watchdog *watchdog, struct watch *watch);

/* Leaves WATCH_WORK: `cancel` is not touched any more. True where the client left meanwhile. */
bool watchdog_leave_work(struct watchdog *watchdog, struct watch *watch);

void watchdog_count_body(struct watchdog *watchdog, struct watch *watch, size_t bytes);

/* Sends `answer` past libmicrohttpd, which cannot answer in the middle of a
 * body, and closes the way out. False where the connection was given up before. */
bool watchdog_refuse(struct watchdog *watchdog, struct watch *watch, const struct answer *answer);

/* Marks the request in flight and returns true, unless its address has `max` of them (0: any number). */
bool watchdog_admit(struct watchdog *watchdog, struct watch *watch, size_t max);

/* Bytes have come in on this connection that belong to no request known so far. */
bool watchdog_has_unknown_bytes(const struct watch *watch);

/* For the end of a drain: cancels all work; shuts all sockets down too. */
void watchdog_cut_short(struct watchdog *watchdog, bool sockets_too);

#endif
