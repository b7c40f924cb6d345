/* http.h - the daemon's HTTP side: listens, reads requests, has them answered.
 *
 * Only http*.c see microhttpd.h. One thread, the loop's, serves all
 * connections; libmicrohttpd suspends a connection while a worker has its request.
 */
#ifndef ZRASTERD_HTTP_H
#define ZRASTERD_HTTP_H

#include <stddef.h>

#include "config.h"
#include "request.h"

struct http;

/* Listens and answers from now on. NULL: `message` says why not. `config` and `service` must outlive it. */
struct http *http_start(const struct config *config, struct service *service, char *message, size_t message_size);

unsigned http_port(const struct http *http);

/* Takes no new connections, lets what is in flight be answered (at most
 * drain_timeout_ms), then ends all threads and frees all. */
void http_stop(struct http *http);

#endif
