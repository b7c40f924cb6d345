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
enum body_status body_split(const struct work *work, struct zr_request *render, struct multipart **parts);

/* The same for routes that need the parts alone. */
enum body_status body_parts(const struct work *work, struct multipart **parts);

/* Fills *render from request->render, which stays unchanged. Memory comes from the arena. Of the cancellations, only
 * `reading` counts, which may be NULL. */
enum body_status body_unpack(const struct work *work, struct zr_request *render);

/* Returns REQUEST_WORK if the body is ready, else REQUEST_LARGE, or REQUEST_ANSWERED: the answer is then set. */
enum request_next body_next(const struct work *work, enum body_status status);

/* Unpacks the body and reads its scene, with stored assets. *status is that of reading if the body is ready. */
enum body_status body_read_scene(const struct work *work, const struct zr_run *run, const struct zr_scene **scene,
                                 enum zr_status *status);

#endif
