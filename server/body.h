/* body.h - a request's body -> what the renderer takes: inflated, and taken apart.
 */
#ifndef ZRASTERD_BODY_H
#define ZRASTERD_BODY_H

#include "request.h"

enum body_status {
    BODY_READY,
    BODY_REFUSED, /* the answer says why */
    BODY_LARGE,   /* as far as it was inflated it is no small request's any more, and small_only was asked for */
    BODY_CANCELLED
};

/* Fills *render from request->render, which stays as it is; what is made lies in the
 * arena. `max` are the bytes a body may inflate to. `cancel` may be NULL. */
enum body_status body_unpack(const struct request *request, size_t max, struct zr_arena *arena,
                             const struct zr_cancel *cancel, struct zr_request *render, struct answer *answer);

#endif
