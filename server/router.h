/* router.h - method, path, headers and bytes in; status, headers and bytes out: whom the daemon asks for what. */
#ifndef ZRASTERD_ROUTER_H
#define ZRASTERD_ROUTER_H

#include "request.h"

enum request_next router_open(const struct service *service, const struct load *load, struct request *request,
                              struct answer *answer);

/* Works in `arena`; the answer's bytes are a copy of their own. Thread-safe. Where small_only is asked for, `cancel`
 * has a parent that is raised once the request has taken too long for a small one: it is large then. times->queue_ms is
 * given, the others are filled in. REQUEST_ANSWERED or REQUEST_LARGE. */
enum request_next router_work(const struct service *service, const struct request *request, struct zr_arena *arena,
                              const struct zr_cancel *cancel, struct step_times *times, struct answer *answer);

/* The headers that every answer has. Call once, last. */
void router_finish(struct answer *answer, const char *request_id);

#endif
