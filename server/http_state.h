/* http_state.h - the daemon's HTTP side and its exchanges: what http*.c work on. Inside of these only.
 */
#ifndef ZRASTERD_HTTP_STATE_H
#define ZRASTERD_HTTP_STATE_H

#include <pthread.h>
#include <stdatomic.h>

#include <microhttpd.h>

#include "config.h"
#include "connections.h"
#include "queue.h"
#include "request.h"
#include "upload.h"

struct exchange;

/* Belongs to the thread of the loop (http_loop.h), but for what is atomic, the queue, and `finished` with its lock. */
struct http {
    const struct config *config;
    struct service *service;
    struct queue *queue;
    struct MHD_Daemon *daemon;
    struct connections connections;
    pthread_t thread;
    int listen_fd, epoll_fd, wake_fd; /* wake_fd: an eventfd that others write to */
    int library_fd;                   /* libmicrohttpd's epoll */
    unsigned port;
    bool listener_rests; /* no descriptor could be had for a new connection */
    bool is_self_test;   /* nothing is logged */
    struct upload_budget uploads;
    atomic_size_t answer_bytes; /* of answers that a worker made and nobody has taken yet */
    size_t in_flight;           /* exchanges whose header has been read */
    int64_t drain_began_ms, cut_ms;
    bool sockets_cut;
    atomic_bool draining, cut_short; /* cut_short: the drain took too long */

    pthread_mutex_t lock;
    struct exchange *finished; /* by workers, for the loop to answer */
};

/* Connections beyond max-connections that are kept for this machine's own health checks. */
enum { HTTP_LOOPBACK_CONNECTIONS = 16 };

enum { METHOD_SIZE = FRAMING_METHOD_MAX + 1, TRACEPARENT_SIZE = 56 };

/* What the next callback of libmicrohttpd means. */
enum step {
    STEP_HEADER,  /* the header is here, nothing of the body */
    STEP_BODY,    /* bytes of the body, or, with none, its end */
    STEP_DISCARD, /* as STEP_BODY, but the answer is made already */
    STEP_REFUSED, /* the answer went out past libmicrohttpd; the rest is thrown away */
    STEP_ANSWER   /* a worker makes the answer, or has made it */
};

/* One request and its answer, from the request line to the last byte. */
struct exchange {
    struct http *http;
    struct MHD_Connection *mhd;
    struct connection *connection;
    struct exchange *next; /* of those that are finished */
    enum step step;
    bool opened, replied, logged, client_left;
    bool is_last; /* the client says that the connection ends with it: what comes behind it is no request */
    char *target; /* path and query; a zero in between once the header is here */
    char method[METHOD_SIZE], traceparent[TRACEPARENT_SIZE];
    int64_t began_us;
    atomic_int_least64_t work_began_ms; /* 0: no worker has it */
    uint64_t body_bytes, length;        /* length: Content-Length, 0 where unknown */
    size_t answer_bytes;                /* its share of http->answer_bytes */
    int file;                           /* of the answer, while it is sent: libmicrohttpd closes it; 0: none */
    struct request request;
    struct answer answer;
    struct upload upload;
    struct queue_job job;
    struct zr_cancel cancel;
    struct step_times times;
};

#endif
