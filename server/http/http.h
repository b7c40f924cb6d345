/* http.h - the HTTP side of the daemon: listens, receives requests, sends answers.
 *
 * Only http*.c include microhttpd.h. One thread, the loop, serves all connections. While a worker has a request,
 * libmicrohttpd suspends its connection; a streamed answer (stream.h) resumes it whenever there are bytes.
 */
#ifndef ZRASTERD_HTTP_H
#define ZRASTERD_HTTP_H

#include <stddef.h>

#include "config.h"
#include "request.h"

struct http;

/* Listens and serves from now on. NULL: `message` has the reason. `config` and `service` must outlive the result. */
struct http *http_start(const struct config *config, struct service *service, char *message, size_t message_size);

/* Replaces service->gate and frees the one before; the loop takes `gate` within a turn, and logs the change. Any thread
 * may call it. */
void http_change_gate(struct http *http, struct gate *gate);

unsigned http_port(const struct http *http);

/* Reports the daemon as not ready, and serves for drain_delay_ms more. Then accepts no new connections, waits up to
 * drain_timeout_ms for the requests in flight, ends all threads and frees everything. */
void http_stop(struct http *http);

#endif
