#include "stream.h"

#include <stdlib.h>
#include <string.h>

#include "clock.h"

void stream_init(struct stream *stream, const struct stream_owner *owner)
{
    *stream = (struct stream){.owner = *owner};
    pthread_mutex_init(&stream->lock, NULL);
    pthread_cond_init(&stream->room, NULL);
}

void stream_free(struct stream *stream)
{
    free(stream->bytes);
    pthread_cond_destroy(&stream->room);
    pthread_mutex_destroy(&stream->lock);
}

static size_t smallest(size_t a, size_t b, size_t c)
{
    const size_t least = a < b ? a : b;
    return least < c ? least : c;
}

/* ---- the writer ---- */

enum refusal stream_open(struct stream *stream)
{
    const enum refusal refusal = stream->owner.open(stream->owner.context);
    if (refusal) return refusal;
    stream->bytes = malloc(STREAM_ROOM);
    return stream->bytes ? REFUSAL_NONE : REFUSAL_MEMORY;
}

void stream_begin(struct stream *stream, struct answer *answer)
{
    stream->is_begun = true;
    stream->owner.begin(stream->owner.context, answer);
}

/* With the lock held. */
static void wake(struct stream *stream)
{
    if (stream->is_hungry) stream->owner.wake(stream->owner.context);
    stream->is_hungry = false;
}

/* Waits until half of the room is free: with less, writer and reader would take turns. Without the lock while memory is
 * returned, and while others have the place for work: the reader never waits. */
static void wait_for_room(struct stream *stream)
{
    const int64_t began_us = clock_us();
    wake(stream);
    pthread_mutex_unlock(&stream->lock);
    if (stream->shrink) stream->held_bytes = stream->shrink(stream->memory);
    stream->refusal = stream->owner.wait(stream->owner.context, true);
    pthread_mutex_lock(&stream->lock);
    stream->is_closed |= stream->refusal != REFUSAL_NONE;
    while (stream->used > STREAM_ROOM / 2 && !stream->is_closed)
        pthread_cond_wait(&stream->room, &stream->lock);
    pthread_mutex_unlock(&stream->lock);
    stream->owner.wait(stream->owner.context, false);
    pthread_mutex_lock(&stream->lock);
    stream->waited_us += clock_us() - began_us;
}

bool stream_write(struct stream *stream, const void *bytes, size_t size)
{
    const char *from = bytes;
    pthread_mutex_lock(&stream->lock);
    while (size > 0 && !stream->is_closed) {
        if (stream->used == STREAM_ROOM) {
            wait_for_room(stream);
            continue;
        }
        const size_t at = (stream->first + stream->used) % STREAM_ROOM;
        const size_t count = smallest(size, STREAM_ROOM - stream->used, STREAM_ROOM - at);
        memcpy(stream->bytes + at, from, count);
        stream->used += count;
        from += count;
        size -= count;
    }
    const bool is_open = !stream->is_closed;
    pthread_mutex_unlock(&stream->lock);
    return is_open;
}

void stream_flush(struct stream *stream)
{
    pthread_mutex_lock(&stream->lock);
    wake(stream);
    pthread_mutex_unlock(&stream->lock);
}

void stream_finish(struct stream *stream, enum stream_end end)
{
    pthread_mutex_lock(&stream->lock);
    stream->end = end;
    wake(stream);
    pthread_mutex_unlock(&stream->lock);
}

/* ---- the reader ---- */

static ptrdiff_t find_end(struct stream *stream)
{
    if (stream->is_closed || stream->end == STREAM_BROKEN) return STREAM_AT_BREAK;
    if (stream->end == STREAM_WHOLE) return STREAM_AT_END;
    stream->is_hungry = true;
    return STREAM_NO_BYTES;
}

ptrdiff_t stream_read(struct stream *stream, char *bytes, size_t size)
{
    ptrdiff_t result;
    pthread_mutex_lock(&stream->lock);
    if (stream->is_closed || stream->used == 0) {
        result = find_end(stream);
    } else {
        const size_t count = smallest(size, stream->used, STREAM_ROOM - stream->first);
        memcpy(bytes, stream->bytes + stream->first, count);
        stream->used -= count;
        stream->first = stream->used > 0 ? (stream->first + count) % STREAM_ROOM : 0; /* touches few pages */
        if (stream->used <= STREAM_ROOM / 2) pthread_cond_signal(&stream->room);
        result = (ptrdiff_t)count;
    }
    pthread_mutex_unlock(&stream->lock);
    return result;
}

void stream_close(struct stream *stream)
{
    pthread_mutex_lock(&stream->lock);
    stream->is_closed = true;
    pthread_cond_signal(&stream->room);
    pthread_mutex_unlock(&stream->lock);
}
