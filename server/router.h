/* router.h - chooses the handler of a request by path and method, and asks the gate. */
#ifndef ZRASTERD_ROUTER_H
#define ZRASTERD_ROUTER_H

#include "request.h"

/* Finds the route, checks token and method, and opens the request. Returns REQUEST_ANSWERED or REQUEST_WORK. */
enum request_next router_open(const struct service *service, const struct load *load, struct request *request,
                              struct answer *answer);

/* Runs the request's work in `arena`; the answer does not point into it. Thread-safe. With request->small_only,
 * `cancel` has a parent, which is raised when the request has run too long for a small one; it then counts as large.
 * times->queue_ms is input, the other times are output. Returns REQUEST_ANSWERED or REQUEST_LARGE. */
enum request_next router_work(const struct service *service, const struct request *request, struct zr_arena *arena,
                              const struct zr_cancel *cancel, struct step_times *times, struct answer *answer);

/* Adds the headers of all answers. Call once, last. A refused request may lack all but its id. */
void router_finish(struct answer *answer, const struct service *service, const struct request *request);

#endif
