/* routes/metrics.h - GET /metrics: counts and state of the daemon for Prometheus. */
#ifndef ZRASTERD_METRICS_ROUTE_H
#define ZRASTERD_METRICS_ROUTE_H

#include "request.h"

/* Handler for the router. */
bool metrics_open(const struct service *service, const struct load *load, struct request *request,
                  struct answer *answer);

#endif
