/* http_end.h - the end of an exchange: its line in the log, and its memory. For http*.c only. */
#ifndef ZRASTERD_HTTP_END_H
#define ZRASTERD_HTTP_END_H

#include "http_state.h"

/* Logs an exchange once. */
void http_log_exchange(struct exchange *exchange);

/* Logs and frees an exchange that is over, for libmicrohttpd and for workers. */
void http_close_exchange(struct exchange *exchange);

#endif
