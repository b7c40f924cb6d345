/* buffer.h - output: a growing byte buffer in the request's arena. */
#ifndef ZR_BUFFER_H
#define ZR_BUFFER_H

#include "base/arena.h"

struct zr_buffer {
    struct zr_arena *arena;
    unsigned char *bytes;
    size_t size, room;
};

/* Ensures room for `size` more bytes and returns a pointer to it; the caller writes them and increases `size`. Returns
 * NULL once the arena has failed. */
unsigned char *zr_buffer_room(struct zr_buffer *buffer, size_t size);

/* Appends bytes. Returns false once the arena has failed. */
bool zr_buffer_add(struct zr_buffer *buffer, const void *bytes, size_t size);

#endif
