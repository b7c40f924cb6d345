/* body.h - a request's body -> what the renderer takes: inflated, and taken apart.
 */
#ifndef ZRASTERD_BODY_H
#define ZRASTERD_BODY_H

#include "api.h"

extern const char BODY_MEMORY_USED_UP[];

/* Fills *render from request->render, which stays as it is; what is made lies in the
 * arena. `max` are the bytes a body may inflate to. False: `answer` says why not. */
bool body_unpack(const struct api_request *request, size_t max, struct zr_arena *arena, struct zr_request *render,
                 struct answer *answer);

#endif
