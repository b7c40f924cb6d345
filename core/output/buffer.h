/* buffer.h - output: bytes that grow, in the request's arena. */
#ifndef ZR_BUFFER_H
#define ZR_BUFFER_H

#include "base/arena.h"

struct zr_buffer {
    struct zr_arena *arena;
    unsigned char *bytes;
    size_t size, room;
};

/* Makes room for `size` bytes behind the last one and returns where they go; whoever
 * writes them adds to `size`. NULL once the arena has failed. */
unsigned char *zr_buffer_room(struct zr_buffer *buffer, size_t size);

/* Appends, and returns false once the arena has failed. */
bool zr_buffer_add(struct zr_buffer *buffer, const void *bytes, size_t size);

#endif
