/* request.h - api: translates a caller's request into one of the core. */
#ifndef ZR_LIBRARY_REQUEST_H
#define ZR_LIBRARY_REQUEST_H

#include "api/zraster.h"
#include "render_request.h"

/* A request and its cancel, which may be NULL. */
struct zr_taken_request {
    struct zr_request request;
    zraster_cancel *cancel;
    void (*progress)(void *context, uint32_t done, uint32_t total); /* or NULL */
    void *progress_context;
};

/* Checks and translates a request; the texts of its query go to the arena. `is_kept`: also copies the
 * parts that the caller has not lent, and marks them as lent. Else parts are borrowed, as the body always is. Fails
 * with ZR_BAD_REQUEST, ZR_BAD_TYPE or ZR_NO_MEMORY. */
enum zr_status zr_request_take(struct zr_arena *arena, const struct zraster_request *given, bool is_kept,
                               struct zr_taken_request *out, struct zr_error *error);

#endif
