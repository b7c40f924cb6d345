/* http_exchange.h - what becomes of a request: libmicrohttpd's callbacks, and refusals. Inside of http*.c only.
 */
#ifndef ZRASTERD_HTTP_EXCHANGE_H
#define ZRASTERD_HTTP_EXCHANGE_H

#include "http_state.h"

void http_on_connection(void *http, struct MHD_Connection *connection, void **socket_context,
                        enum MHD_ConnectionNotificationCode code);
void *http_on_request_line(void *http, const char *target, struct MHD_Connection *connection);
enum MHD_Result http_on_request(void *http, struct MHD_Connection *connection, const char *url, const char *method,
                                const char *version, const char *bytes, size_t *size, void **exchange);
void http_on_completed(void *http, struct MHD_Connection *connection, void **exchange,
                       enum MHD_RequestTerminationCode code);

/* Refuses what the connection is sending, be it a request that is known or not, past libmicrohttpd, and closes the way
 * out. */
void http_refuse(struct http *http, struct connection *connection, int status, const char *detail);

/* The same for what framing_scan refused, once the requests before it have been answered. */
void http_refuse_framing(struct http *http, struct connection *connection);

#endif
