/* http_receive.h - what libmicrohttpd receives, it receives through here: past framing.h. Inside of http*.c only. */
#ifndef ZRASTERD_HTTP_RECEIVE_H
#define ZRASTERD_HTTP_RECEIVE_H

#include <sys/types.h>

#include "http_state.h"

/* The bytes that this thread receives from now on are those of this daemon's connections. */
void http_receive_for(struct http *http);

/* Has the kernel throw away what has come on a socket, copying nothing; of one that sends on and on some MiB. What the
 * last recv() gave: 0 at the end of the connection, below 0 with errno EAGAIN where there may be more later. */
ssize_t http_receive_nothing(int fd);

/* Sends a request that must be refused, and one that must not, through libmicrohttpd. False: it does not receive
 * through here. */
bool http_receive_works(struct http *http);

#endif
