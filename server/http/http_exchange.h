/* http_exchange.h - callbacks of libmicrohttpd for connections and requests, and refusals. For http*.c only. */
#ifndef ZRASTERD_HTTP_EXCHANGE_H
#define ZRASTERD_HTTP_EXCHANGE_H

#include "http_state.h"

/* Callbacks of libmicrohttpd: a connection opens or closes; a request line arrives; a header is complete, or bytes of a
 * body arrive, or its end (size 0); an exchange is over. */
void http_on_connection(void *http, struct MHD_Connection *connection, void **socket_context,
                        enum MHD_ConnectionNotificationCode code);
void *http_on_request_line(void *http, const char *target, struct MHD_Connection *connection);
enum MHD_Result http_on_request(void *http, struct MHD_Connection *connection, const char *url, const char *method,
                                const char *version, const char *bytes, size_t *size, void **exchange);
void http_on_completed(void *http, struct MHD_Connection *connection, void **exchange,
                       enum MHD_RequestTerminationCode code);

/* Refuses the bytes that the connection sends, whether or not its request is known. Sends the answer without
 * libmicrohttpd and closes the sending half. */
void http_refuse(struct http *http, struct connection *connection, int status, const char *detail);

/* Refuses bytes that framing_scan refused, once all requests before them are answered. */
void http_refuse_framing(struct http *http, struct connection *connection);

#endif
