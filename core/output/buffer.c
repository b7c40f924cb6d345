#include "output/buffer.h"

#include <string.h>

#include "base/checked.h"

enum { FIRST_ROOM = 1 << 16 };

bool zr_buffer_add(struct zr_buffer *buffer, const void *bytes, size_t size)
{
    size_t wanted;
    if (!zr_add_size(buffer->size, size, &wanted)) return false;
    if (wanted > buffer->room) {
        size_t room = buffer->room < FIRST_ROOM ? FIRST_ROOM : buffer->room * 2;
        if (room < wanted) room = wanted;
        unsigned char *grown = zr_arena_grow(buffer->arena, buffer->bytes, buffer->size, room, 1);
        if (!grown) return false;
        buffer->bytes = grown;
        buffer->room = room;
    }
    if (size > 0) memcpy(buffer->bytes + buffer->size, bytes, size);
    buffer->size = wanted;
    return true;
}
