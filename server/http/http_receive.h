/* http_receive.h - recv() of libmicrohttpd: all received bytes pass framing.h first. For http*.c only. */
#ifndef ZRASTERD_HTTP_RECEIVE_H
#define ZRASTERD_HTTP_RECEIVE_H

#include <sys/types.h>

#include "http_state.h"

/* Sets the daemon whose connections this thread receives from. */
void http_receive_for(struct http *http);

/* Lets the kernel discard received bytes without copying them, some MiB at most per call. Returns the result of the
 * last recv(): 0 at the end of the connection; below 0 with errno EAGAIN if more may come later. */
ssize_t http_receive_nothing(int fd);

/* Sends one bad and one good request through libmicrohttpd. False: libmicrohttpd does not use this recv(). */
bool http_receive_works(struct http *http);

#endif
