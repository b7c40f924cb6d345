/* http_work.h - the way of a request from its last byte to its answer: queue, worker, and back to the loop. For http*.c
 * only.
 *
 * Streams: the worker reports an answer with its first bytes, then more bytes, then the end of its work. The loop sends
 * bytes until there are none, and resumes at the next report. A client that leaves ends its exchange for libmicrohttpd
 * at once; it is freed when its work has ended.
 */
#ifndef ZRASTERD_HTTP_WORK_H
#define ZRASTERD_HTTP_WORK_H

#include "http_state.h"

/* Returns the queue for a body of this size: a first guess, before the body is read. */
enum queue_lane http_lane_of(uint64_t body_bytes);

/* Begins work on a complete body. Suspends the connection until its answer is ready. */
enum MHD_Result http_begin_work(struct exchange *exchange);

/* Sends answers that workers have made, and bytes of those that they stream. On the thread of the loop, like all
 * functions below. */
void http_take_reports(struct http *http);

/* Ends the work on a request whose client left. */
void http_abandon_work(struct http *http, struct exchange *exchange);

/* Returns true if a worker still makes the answer, whose first bytes may be sent. */
bool http_is_streaming(const struct exchange *exchange);

/* Reads bytes of a streamed answer for libmicrohttpd. */
ssize_t http_read_stream(void *exchange, uint64_t position, char *bytes, size_t size);

/* Ends a streamed answer whose client does not read, and cancels its work. */
void http_cut_stream(struct exchange *exchange);

/* Cancels work that took too long. */
void http_cancel_work(struct exchange *exchange);

/* Returns the deadline of the work on a request; INT64_MAX: no worker has begun. */
int64_t http_work_deadline_ms(const struct exchange *exchange);

#endif
