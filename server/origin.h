/* origin.h - requests that browsers send from pages of other sites.
 *
 * A browser says in Sec-Fetch-Site where a request comes from. It does so for https and for this machine's own
 * addresses. Other clients send no such header. */
#ifndef ZRASTERD_ORIGIN_H
#define ZRASTERD_ORIGIN_H

#include "request.h"

/* Adds the headers of CORS if the request's Origin is among --origins. Returns false if the answer is ready: 204 to a
 * preflight, or 403 to a request that changes or draws something, from a page of another origin that is not among
 * them. `route` may be NULL. */
bool origin_check(const struct config *config, const struct request *request, const struct route *route,
                  struct answer *answer);

#endif
