/* stream.h - bytes of an answer, from the worker that makes them to the loop that sends them meanwhile.
 *
 * Bound: up to STREAM_ROOM bytes wait for the loop. If they fill it, the writer waits, so a slow reader slows drawing
 * and memory stays flat. A writer that waits gives up its place for work (queue.h), and its memory counts as that of
 * answers.
 *
 * Threads: one writer, and one reader, which never waits.
 *
 * End: the writer ends the bytes. The reader closes the stream to stop the writer, whose calls then return at once.
 */
#ifndef ZRASTERD_STREAM_H
#define ZRASTERD_STREAM_H

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "answer.h"

enum { STREAM_ROOM = 1 << 20, STREAM_BOUNDARY_SIZE = 40 };

/* Functions of the stream's owner that the writer calls, on its thread. */
struct stream_owner {
    enum refusal (*open)(void *context);                 /* takes one of the places for streams, or says why not */
    void (*begin)(void *context, struct answer *answer); /* takes the answer over and sends its header */
    void (*wake)(void *context);                         /* the reader, which found no bytes, should read again */
    /* A wait for the reader begins, or ends. A reason: there is no room for the work while it waits, and the stream
     * ends. */
    enum refusal (*wait)(void *context, bool begins);
    void *context;
};

enum stream_end { STREAM_OPEN, STREAM_WHOLE, STREAM_BROKEN };

struct stream {
    struct stream_owner owner;
    pthread_mutex_t lock; /* of the next ones */
    pthread_cond_t room;
    size_t first, used;
    bool is_hungry; /* the reader found no bytes and waits to be woken */
    bool is_closed;
    enum stream_end end;
    char *bytes; /* ring of STREAM_ROOM bytes; NULL before it is opened */

    /* For the writer; for others once it has ended. */
    bool is_begun;
    int64_t waited_us;
    /* Returns memory of the work to the system, and the bytes that it holds while it waits; NULL: held_bytes. */
    size_t (*shrink)(void *memory);
    void *memory;
    size_t held_bytes;
    enum refusal refusal;                /* why the stream ended within a wait */
    char boundary[STREAM_BOUNDARY_SIZE]; /* of its parts (parts.h) */
    bool is_form;                        /* its parts are those of a form */
};

void stream_init(struct stream *stream, const struct stream_owner *owner);
void stream_free(struct stream *stream);

/* ---- the writer ---- */

/* Call before the work for the answer. REFUSAL_NONE, or the reason why there can be no stream now. */
enum refusal stream_open(struct stream *stream);

/* Sends an answer without its body, which follows. Leaves an empty answer. */
void stream_begin(struct stream *stream, struct answer *answer);

/* Adds bytes. False: the stream is closed. */
bool stream_write(struct stream *stream, const void *bytes, size_t size);

/* Wakes the reader for the bytes so far. */
void stream_flush(struct stream *stream);

void stream_finish(struct stream *stream, enum stream_end end);

/* ---- the reader ---- */

enum { STREAM_NO_BYTES = 0, STREAM_AT_END = -1, STREAM_AT_BREAK = -2 };

/* Takes up to `size` bytes and returns their number, or one of the above. */
ptrdiff_t stream_read(struct stream *stream, char *bytes, size_t size);

void stream_close(struct stream *stream);

#endif
