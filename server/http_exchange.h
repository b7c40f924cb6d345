/* http_exchange.h - one request and its answer, from the request line to the
 * last byte; libmicrohttpd's callbacks. Inside of http*.c only.
 */
#ifndef ZRASTERD_HTTP_EXCHANGE_H
#define ZRASTERD_HTTP_EXCHANGE_H

#include <pthread.h>
#include <stdatomic.h>

#include <microhttpd.h>

#include "api.h"
#include "config.h"
#include "queue.h"
#include "upload.h"
#include "watchdog.h"

struct http {
    const struct config *config;
    struct api *api;
    struct queue *queue;
    struct watchdog *watchdog;
    struct MHD_Daemon *daemon;
    int listen_fd;
    unsigned port;
    struct upload_budget uploads;
    atomic_bool draining, cut_short; /* cut_short: the drain took too long */

    pthread_mutex_t lock;
    pthread_cond_t exchange_ended;
    size_t in_flight; /* exchanges whose header has been read */
};

enum { METHOD_SIZE = 24, TRACEPARENT_SIZE = 56 };

/* What the next callback of libmicrohttpd means. */
enum step {
    STEP_HEADER,  /* the header is here, nothing of the body */
    STEP_BODY,    /* bytes of the body, or, with none, its end */
    STEP_DISCARD, /* as STEP_BODY, but the answer is made already */
    STEP_REFUSED, /* the answer went out past libmicrohttpd; the rest is thrown away */
    STEP_ANSWER   /* a worker made the answer */
};

struct exchange {
    struct http *http;
    struct MHD_Connection *connection;
    struct watch *watch;
    enum step step;
    bool opened, replied;
    char *target; /* path and query; a zero in between once the header is here */
    char method[METHOD_SIZE], traceparent[TRACEPARENT_SIZE];
    int64_t began_us;
    uint64_t body_bytes, length; /* length: Content-Length, 0 where unknown */
    struct api_request request;
    struct answer answer;
    struct upload upload;
    struct queue_job job;
    struct zr_cancel cancel;
    struct api_times times;
};

void http_on_connection(void *http, struct MHD_Connection *connection, void **socket_context,
                        enum MHD_ConnectionNotificationCode code);
void *http_on_request_line(void *http, const char *target, struct MHD_Connection *connection);
enum MHD_Result http_on_request(void *http, struct MHD_Connection *connection, const char *url, const char *method,
                                const char *version, const char *bytes, size_t *size, void **exchange);
void http_on_completed(void *http, struct MHD_Connection *connection, void **exchange,
                       enum MHD_RequestTerminationCode code);

#endif
