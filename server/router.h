/* router.h - chooses the handler of a request by path and method, and asks the gate. */
#ifndef ZRASTERD_ROUTER_H
#define ZRASTERD_ROUTER_H

#include "request.h"

/* Finds the route, checks token and method, and opens the request. Returns REQUEST_ANSWERED or REQUEST_WORK. */
enum request_next router_open(const struct service *service, struct request *request, struct answer *answer);

/* Adds the headers of all answers. Call once, last. A refused request may lack all but its id. */
void router_finish(struct answer *answer, const struct service *service, const struct request *request);

#endif
