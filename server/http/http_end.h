/* http_end.h - the end of an exchange: its line in the log, and its memory. For http*.c only. */
#ifndef ZRASTERD_HTTP_END_H
#define ZRASTERD_HTTP_END_H

#include "http_state.h"

/* Logs an exchange once. */
void http_log_exchange(struct exchange *exchange);

/* Logs an event of a connection without a request that libmicrohttpd has reported. answer->status 0: none was sent. */
void http_log_connection(const struct http *http, const struct connection *connection, const char *id,
                         const struct answer *answer);

/* Logs and frees an exchange that is over, for libmicrohttpd and for workers. */
void http_close_exchange(struct exchange *exchange);

#endif
