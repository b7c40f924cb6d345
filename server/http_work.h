/* http_work.h - a request between its last byte and its answer: queue, worker, watchdog.
 * Inside of http*.c only.
 */
#ifndef ZRASTERD_HTTP_WORK_H
#define ZRASTERD_HTTP_WORK_H

#include "http_exchange.h"

/* Which queue a body of this size goes to: as far as can be told before anybody has looked at it. */
enum queue_lane http_lane_of(uint64_t body_bytes);

/* The whole body is here. Suspends the connection until a worker, or whoever ends it, has made the answer. */
enum MHD_Result http_begin_work(struct exchange *exchange);

extern const struct watchdog_calls HTTP_WATCHDOG_CALLS;

#endif
