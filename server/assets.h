/* assets.h - the routes below /v1/assets, and the assets that scenes ask for.
 *
 *     POST      /v1/assets             bytes -> their name
 *     PUT       /v1/assets/{sha256}    bytes, checked against the name
 *     GET, HEAD /v1/assets/{sha256}    the bytes
 */
#ifndef ZRASTERD_ASSETS_H
#define ZRASTERD_ASSETS_H

#include "api.h"

#define ASSETS_PATH "/v1/assets/"

/* All that can be said before the body: false, and `answer` says why not, or request->asset is set. */
bool assets_open(const struct api *api, struct api_request *request, struct answer *answer);

/* As api_work. */
enum api_next assets_work(const struct api *api, const struct api_request *request, struct zr_arena *arena,
                          const struct zr_cancel *cancel, struct answer *answer);

/* For zr_request: looks into the store. */
struct zr_stored assets_stored(const struct api *api);

#endif
