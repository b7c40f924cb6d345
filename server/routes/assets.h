/* assets.h - routes below /v1/assets and /v1/scenes, which are one store, and the assets named by scenes.
 *
 *     POST      /v1/assets             bytes -> their name
 *     PUT       /v1/assets/{sha256}    bytes, checked against the name
 *     GET, HEAD /v1/assets/{sha256}    the bytes
 */
#ifndef ZRASTERD_ASSETS_H
#define ZRASTERD_ASSETS_H

#include "request.h"

#define ASSETS_PATH "/v1/assets/"
#define SCENES_PATH "/v1/scenes/"

/* Handlers for the router. assets_open sets request->asset and has_asset. */
bool assets_open(const struct service *service, const struct load *load, struct request *request,
                 struct answer *answer);
enum request_next assets_work(const struct work *work);

/* Returns the reader of stored assets for zr_request. */
struct zr_stored assets_stored(const struct service *service);

#endif
