/* http_work.h - a request between its last byte and its answer: queue, worker, and back to the loop.
 * Inside of http*.c only.
 */
#ifndef ZRASTERD_HTTP_WORK_H
#define ZRASTERD_HTTP_WORK_H

#include "http_state.h"

/* Which queue a body of this size goes to: as far as can be told before anybody has looked at it. */
enum queue_lane http_lane_of(uint64_t body_bytes);

/* The whole body is here. Suspends the connection until a worker, or whoever ends it, has made the answer. */
enum MHD_Result http_begin_work(struct exchange *exchange);

/* Answers what the workers have finished. On the thread of the loop, as all below. */
void http_take_finished(struct http *http);

/* The client left: work on its request ends. */
void http_abandon_work(struct http *http, struct exchange *exchange);

/* Ends the work of a request that took too long. */
void http_cancel_work(struct exchange *exchange);

/* When the work of a request is to end; INT64_MAX: no worker has begun it. */
int64_t http_work_deadline_ms(const struct exchange *exchange);

/* Answers that wait for their readers fill what they may. */
bool http_answers_are_full(struct http *http);

#endif
