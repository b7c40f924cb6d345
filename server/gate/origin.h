/* origin.h - requests that browsers send from pages of other sites.
 *
 * A browser compares the site of the page with that of the daemon, and sends the result in Sec-Fetch-Site, with https
 * and to addresses of this machine. Other clients send no such header. */
#ifndef ZRASTERD_ORIGIN_H
#define ZRASTERD_ORIGIN_H

#include "request.h"

/* Returns false if the answer is ready: 403 to a request that draws or stores something, from a page of another origin
 * that is not among --allow-origin. */
bool origin_check(const struct config *config, const struct request *request, struct answer *answer);

/* Returns true if the request names an origin among --allow-origin. */
bool origin_is_allowed(const struct config *config, const struct request *request);

/* Adds the headers of CORS, to refusals, too: those that an origin among --allow-origin needs, and Vary. */
void origin_finish(const struct config *config, const struct request *request, struct answer *answer);

#endif
