/* body.h - turns the body of a request into the renderer's input: decompresses it and splits its parts. */
#ifndef ZRASTERD_BODY_H
#define ZRASTERD_BODY_H

#include "multipart.h"
#include "request.h"

enum body_status {
    BODY_READY,
    BODY_REFUSED, /* the answer has the error */
    BODY_LARGE,   /* small_only is set, and more than REQUEST_SMALL_BYTES come out */
    BODY_CANCELLED
};

/* Decompresses the body into *render, whose other members are those of request->render, and finds its parts. */
enum body_status body_split(const struct request *request, size_t max, struct zr_arena *arena,
                            const struct zr_cancel *cancel, struct zr_request *render, struct multipart **parts,
                            struct answer *answer);

/* Fills *render from request->render, which stays unchanged. Memory comes from the arena. `max`: largest size of the
 * decompressed body, in bytes. `cancel` may be NULL. */
enum body_status body_unpack(const struct request *request, size_t max, struct zr_arena *arena,
                             const struct zr_cancel *cancel, struct zr_request *render, struct answer *answer);

/* Returns what follows: REQUEST_WORK if the body is ready, REQUEST_LARGE, or REQUEST_ANSWERED; the answer is then set.
 * `timeout_ms`: the time that a cancelled request had. */
enum request_next body_next(enum body_status status, const struct request *request, uint64_t timeout_ms,
                            struct answer *answer);

#endif
