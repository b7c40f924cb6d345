/* parts.h - writes files as the parts of an answer: multipart/mixed (RFC 2046, 5.1.3), or multipart/form-data (RFC
 * 7578), which browsers read by Response.formData().
 *
 * A stream: the delimiter after a part follows at once, so that a reader which looks for it has the part without
 * delay. An answer in one piece: all files are there.
 */
#ifndef ZRASTERD_PARTS_H
#define ZRASTERD_PARTS_H

#include "http/accept.h"
#include "jobs/stream.h"
#include "request/encode.h"

struct part {
    const char *name; /* of the file; NULL: none. In a form, the field has it without its extension */
    bool is_twin;     /* the field has the extension, too: another encoding of the channel has the name without it */
    const char *type;
    const char *warnings; /* printable ASCII; "": none */
    const void *bytes;
    size_t size;
};

/* Completes the answer and begins the stream with it. `parts` is not ACCEPT_NO_PARTS. */
void parts_begin(struct stream *stream, enum accept_parts parts, struct answer *answer);

/* True if another file of this view or picture has the name of file `number` with another extension. */
bool parts_have_twin(const struct zr_files *files, uint32_t number);

/* False: the stream is closed. */
bool parts_add(struct stream *stream, const struct part *part);

/* Ends the body. `problem`, if its status is not 0, becomes a last part without a final delimiter after it. */
void parts_end(struct stream *stream, const struct answer *problem);

/* Sets status 200 and a body with a part for each file. */
void parts_answer(struct answer *answer, enum accept_parts parts, const struct zr_files *files);

#endif
