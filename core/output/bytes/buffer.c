#include "output/bytes/buffer.h"

#include <string.h>

#include "base/checked.h"

enum { FIRST_ROOM = 1 << 16 };

unsigned char *zr_buffer_room(struct zr_buffer *buffer, size_t size)
{
    size_t wanted;
    if (!zr_add_size(buffer->size, size, &wanted)) return NULL;
    if (wanted > buffer->room || !buffer->bytes) {
        size_t room = buffer->room < FIRST_ROOM ? FIRST_ROOM : buffer->room * 2;
        if (room < wanted) room = wanted;
        unsigned char *grown = zr_arena_grow(buffer->arena, buffer->bytes, buffer->size, room, 1);
        if (!grown) return NULL;
        buffer->bytes = grown;
        buffer->room = room;
    }
    return buffer->bytes + buffer->size;
}

bool zr_buffer_add(struct zr_buffer *buffer, const void *bytes, size_t size)
{
    unsigned char *end = zr_buffer_room(buffer, size);
    if (!end) return false;
    if (size > 0) memcpy(end, bytes, size);
    buffer->size += size;
    return true;
}
