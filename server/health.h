/* health.h - GET /healthz and /readyz: that the daemon is there, and whether it takes on work. */
#ifndef ZRASTERD_HEALTH_H
#define ZRASTERD_HEALTH_H

#include "request.h"

bool health_open(const struct service *service, const struct load *load, struct request *request,
                 struct answer *answer);
bool health_open_ready(const struct service *service, const struct load *load, struct request *request,
                       struct answer *answer);

#endif
