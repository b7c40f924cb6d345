/* admit.h - checks the token of a request and the signature of its address. */
#ifndef ZRASTERD_ADMIT_H
#define ZRASTERD_ADMIT_H

#include "request.h"

/* Checks token and signature, as request->route asks for them, which may be NULL. A token stands for a signature, and a
 * signature for a token. Takes the parameters of a signature out of request->query, and sets request->expires_s.
 * Returns false if the answer is ready: 401 or 403. On the thread of service->gate. */
bool admit(const struct service *service, struct request *request, struct answer *answer);

/* Adds Cache-Control to an answer that stays the same for `seconds`, or for ever (`is_immutable`): no longer than the
 * address is valid, and for no shared cache if a token opened it (RFC 9111, 3.5: "public" would allow it). */
void admit_caching(const struct request *request, int64_t seconds, bool is_immutable, struct answer *answer);

#endif
