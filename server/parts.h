/* parts.h - writes the body of a streamed answer: multipart/mixed (RFC 2046, 5.1.3), a part for each file.
 *
 * The delimiter behind a part follows at once, so that a reader which looks for it has the part without delay.
 */
#ifndef ZRASTERD_PARTS_H
#define ZRASTERD_PARTS_H

#include "stream.h"

#define PARTS_TYPE "multipart/mixed"

struct part {
    const char *name; /* of the file; NULL: none */
    const char *type;
    const char *warnings; /* printable ASCII; "": none */
    const void *bytes;
    size_t size;
};

/* Completes the answer and begins the stream with it. */
void parts_begin(struct stream *stream, struct answer *answer);

/* False: the stream is closed. */
bool parts_add(struct stream *stream, const struct part *part);

/* Ends the body. `problem`, if its status is not 0, becomes a last part without a final delimiter behind it. */
void parts_end(struct stream *stream, const struct answer *problem);

#endif
