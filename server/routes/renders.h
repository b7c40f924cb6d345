/* renders.h - routes below /v1/renders: pictures that have an address.
 *
 *     GET, HEAD /v1/renders/{sha256}?parameters             the picture of a stored scene or model
 *     GET, HEAD /v1/renders/{sha256}/{preset}?parameters    with the parameters of a preset, too
 *
 * The ETag is known before drawing (render_key.h). A client that has the picture gets 304, and kept answers are sent by
 * `open`.
 */
#ifndef ZRASTERD_RENDERS_H
#define ZRASTERD_RENDERS_H

#include "request.h"

#define RENDERS_PATH "/v1/renders/"

/* Handlers for the router. */
bool renders_open(const struct service *service, const struct load *load, struct request *request,
                  struct answer *answer);
enum request_next renders_work(const struct work *work);

#endif
