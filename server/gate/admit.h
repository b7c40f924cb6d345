/* admit.h - who may ask: holders of a token, and who has an address with a signature. */
#ifndef ZRASTERD_ADMIT_H
#define ZRASTERD_ADMIT_H

#include "request.h"

/* Checks token and signature, as request->route asks for them, which may be NULL. A token stands for a signature, and a
 * signature for a token. Takes the parameters of a signature out of request->query, and sets request->expires_s.
 * Returns false if the answer is ready: 401 or 403. On the thread of service->gate. */
bool admit(const struct service *service, struct request *request, struct answer *answer);

#endif
