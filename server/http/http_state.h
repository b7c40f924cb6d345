/* http_state.h - state of the HTTP side and of one exchange. For http*.c only. */
#ifndef ZRASTERD_HTTP_STATE_H
#define ZRASTERD_HTTP_STATE_H

#include <pthread.h>
#include <stdatomic.h>

#include <microhttpd.h>

#include "config.h"
#include "connections.h"
#include "jobs/queue.h"
#include "jobs/stream.h"
#include "request.h"
#include "upload.h"

struct exchange;

/* Belongs to the thread of the loop (http_loop.h), except atomic members, the queue, and `reports` with its lock. */
struct http {
    const struct config *config;
    struct service *service;
    struct queue *queue;
    struct MHD_Daemon *daemon;
    struct connections connections;
    pthread_t thread;
    int listen_fd, epoll_fd, wake_fd; /* wake_fd: eventfd that other threads write to */
    int library_fd;                   /* epoll of libmicrohttpd */
    unsigned port;
    bool listener_rests; /* no descriptor, or no place, for a new connection */
    bool is_self_test;   /* logs nothing */
    struct upload_budget uploads;
    atomic_size_t answer_bytes; /* of answers that are not sent yet, and of works that wait for readers */
    atomic_size_t streams;      /* works that may stream their answers */
    size_t in_flight;           /* exchanges with a complete header */
    int64_t leave_began_ms, drain_began_ms, cut_ms; /* 0: not yet */
    bool sockets_cut;
    /* leaving: the daemon is to end, and still serves; draining: the drain delay has passed; cut_short: the drain
     * timeout has, too */
    atomic_bool leaving, draining, cut_short;

    _Atomic(struct gate *) next_gate; /* from another thread, for service->gate; NULL: none */

    struct exchange *leaders; /* list of works whose answers equal requests share (http_equal.h) */
    size_t shared_answers;    /* since the start */

    pthread_mutex_t lock;
    struct exchange *reports; /* list, from workers to the loop */
};

/* Connections beyond max-connections for health checks from this machine. */
enum { HTTP_LOOPBACK_CONNECTIONS = 16 };

enum { METHOD_SIZE = FRAMING_METHOD_MAX + 1 };

/* State of an exchange: the meaning of the next callback of libmicrohttpd. */
enum step {
    STEP_HEADER,  /* the header is complete */
    STEP_BODY,    /* the callback brings bytes of the body, or its end */
    STEP_DISCARD, /* as STEP_BODY, but the answer is ready */
    STEP_REFUSED, /* answered without libmicrohttpd; further bytes are discarded */
    STEP_ANSWER   /* a worker makes or has made the answer */
};

/* One request and its answer, from the request line to the last byte, or to the end of work on a streamed answer whose
 * reader left. */
struct exchange {
    struct http *http;
    struct MHD_Connection *mhd;
    struct connection *connection;
    struct exchange *next;                   /* in http->reports */
    bool is_reported, has_answer, has_ended; /* with http->lock: in the list, since there is an answer or work ended */
    struct exchange *leader, *followers;     /* NULL: none */
    struct exchange *next_equal;             /* in the list of followers of its leader, or in http->leaders */
    struct ip peer, client;                  /* client: as told by a trusted proxy, else the peer */
    struct client *holder;                   /* has the exchange's share of answers and streams; NULL: no memory */
    enum step step;
    bool opened, replied, logged, client_left;
    bool was_slow;     /* the client read the answer too slowly */
    bool is_working;   /* from its place in the queue until the loop learns that work has ended */
    bool is_suspended; /* a stream has no bytes */
    bool is_over;      /* for libmicrohttpd; the connection may be gone */
    bool is_whole;     /* the client has the whole answer */
    uint64_t bytes_out;
    int64_t suspended_ms;
    bool is_last; /* the client ends the connection after this request: bytes after it are no request */
    char *target; /* path and query, split by a zero once the header is complete */
    char method[METHOD_SIZE];
    int64_t began_us;
    atomic_int_least64_t work_began_ms; /* 0: not on a worker */
    uint64_t body_bytes, length;        /* length: Content-Length, 0 if unknown */
    size_t answer_bytes;                /* share of http->answer_bytes */
    int file;                           /* of the answer during sending; libmicrohttpd closes it; 0: none */
    struct request request;
    struct answer answer;
    struct answer made; /* for the worker; of a stream, the problem that ended it */
    struct stream stream;
    bool has_stream;  /* for the worker: counts in http->streams */
    int64_t spent_ms; /* for the worker: of its time before it waits for the reader */
    struct upload upload;
    struct queue_job job;
    struct zr_cancel cancel;
    struct step_times times;
};

#endif
