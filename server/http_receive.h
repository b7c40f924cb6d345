/* http_receive.h - what libmicrohttpd receives, it receives through here: past framing.h. Inside of http*.c only. */
#ifndef ZRASTERD_HTTP_RECEIVE_H
#define ZRASTERD_HTTP_RECEIVE_H

#include "http_exchange.h"

/* The bytes that this thread receives from now on are those of this daemon's connections. */
void http_receive_for(struct http *http);

/* Sends a request that must be refused, and one that must not, through libmicrohttpd. False: it does not receive
 * through here. */
bool http_receive_works(struct http *http);

#endif
