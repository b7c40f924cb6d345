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

void http_on_connection(void *http, struct MHD_Connection *connection, void **socket_context,
                        enum MHD_ConnectionNotificationCode code);
void *http_on_request_line(void *http, const char *target, struct MHD_Connection *connection);
enum MHD_Result http_on_request(void *http, struct MHD_Connection *connection, const char *url, const char *method,
                                const char *version, const char *bytes, size_t *size, void **exchange);
void http_on_completed(void *http, struct MHD_Connection *connection, void **exchange,
                       enum MHD_RequestTerminationCode code);

extern const struct watchdog_calls HTTP_WATCHDOG_CALLS;

#endif
