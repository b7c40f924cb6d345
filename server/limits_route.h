/* limits_route.h - GET /v1/limits: the limits in force. */
#ifndef ZRASTERD_LIMITS_ROUTE_H
#define ZRASTERD_LIMITS_ROUTE_H

#include "request.h"

bool limits_open(const struct service *service, const struct load *load, struct request *request,
                 struct answer *answer);

#endif
