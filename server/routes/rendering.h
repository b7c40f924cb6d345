/* rendering.h - renders: from the body to the answer, for all routes that draw. */
#ifndef ZRASTERD_RENDERING_H
#define ZRASTERD_RENDERING_H

#include "body.h"
#include "request.h"

/* Allocates request->render, of an unknown format, with room for the texts of its query, and returns that room. NULL:
 * the answer is ready. */
char *rendering_begin(struct request *request, size_t room, struct answer *answer);

/* A kind of render: how a body becomes the renderer's input, how faults of the input are reported, what is added to an
 * answer with a picture, and whether model files are kept as read. */
struct rendering_kind {
    enum body_status (*unpack)(const struct work *work, struct zr_request *render);
    void (*report)(struct answer *answer, enum zr_status status, const struct zr_error *error); /* NULL: as they are */
    /* is_pinned: the version of the look is fixed. NULL: nothing is added. */
    void (*finish)(const struct work *work, bool is_pinned);
    bool keeps_meshes;
};

/* Unpacks the body, reads the scene, predicts its cost, draws it and encodes the outputs. */
enum request_next rendering_run(const struct rendering_kind *kind, const struct work *work);

/* True if a Content-Type is multipart/form-data. */
bool rendering_is_multipart(const char *content_type);

#endif
