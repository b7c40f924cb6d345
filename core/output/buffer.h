/* buffer.h - output: bytes that grow, in the request's arena. */
#ifndef ZR_BUFFER_H
#define ZR_BUFFER_H

#include "base/arena.h"

struct zr_buffer {
    struct zr_arena *arena;
    unsigned char *bytes;
    size_t size, room;
};

/* Appends, and returns false once the arena has failed. */
bool zr_buffer_add(struct zr_buffer *buffer, const void *bytes, size_t size);

#endif
