/* http_loop.h - the one thread that serves all connections: accepts, waits, has libmicrohttpd read and write,
 * answers what workers have finished, and ends what takes too long. Inside of http*.c only.
 *
 * libmicrohttpd is driven from outside: its own loop stops for ever when 128 connections are ready at once
 * (0.9.75 to 1.0.1), takes no connection by an address or a place, and sees no client leave while its request is worked
 * on.
 */
#ifndef ZRASTERD_HTTP_LOOP_H
#define ZRASTERD_HTTP_LOOP_H

#include "http_state.h"

/* The descriptors that the loop waits for. False: none could be had. */
bool http_loop_open(struct http *http);

/* Runs until http->draining is set and all is over. */
void http_loop_run(struct http *http);

/* Has the loop look at http->draining. From any thread. */
void http_loop_wake(struct http *http);

#endif
