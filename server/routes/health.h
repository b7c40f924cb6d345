/* health.h - GET /healthz: the daemon is alive; GET /readyz: it accepts work; GET /v1/limits: the limits in force. */
#ifndef ZRASTERD_HEALTH_H
#define ZRASTERD_HEALTH_H

#include "request.h"

/* Returns the reason why the daemon is not ready, or REFUSAL_NONE. Not ready if either queue is full: a client that
 * checks readiness may send large requests, too. */
enum refusal health_busy_with(const struct service *service, const struct load *load);

/* Handlers for the router. */
bool health_open(const struct service *service, const struct load *load, struct request *request,
                 struct answer *answer);
bool health_open_ready(const struct service *service, const struct load *load, struct request *request,
                       struct answer *answer);
bool limits_open(const struct service *service, const struct load *load, struct request *request,
                 struct answer *answer);

#endif
