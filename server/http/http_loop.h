/* http_loop.h - the thread that serves all connections: accepts them, runs libmicrohttpd, sends finished answers and
 * ends overdue connections. For http*.c only.
 *
 * The daemon drives libmicrohttpd from outside. The library's own loop hangs if 128 connections are ready at once
 * (0.9.75 to 1.0.1). It neither limits connections per address nor notices that a client leaves during the work on its
 * request.
 */
#ifndef ZRASTERD_HTTP_LOOP_H
#define ZRASTERD_HTTP_LOOP_H

#include "http_state.h"

/* Opens the descriptors of the loop. False: none available. */
bool http_loop_open(struct http *http);

/* Runs until http->leaving is set and all requests are finished. */
void http_loop_run(struct http *http);

/* Wakes the loop to check http->leaving. Thread-safe. */
void http_loop_wake(struct http *http);

#endif
