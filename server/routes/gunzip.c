#include "gunzip.h"

#include <stdint.h>
#include <zlib.h>

/* AT_ONCE: bytes between two checks for cancellation, some milliseconds. GZIP_FORMAT: added to the window bits, selects
 * gzip instead of zlib. */
enum { FIRST_ROOM = 1 << 16, AT_ONCE = 1 << 20, GZIP_FORMAT = 16 };

static uInt part(size_t size)
{
    return size < AT_ONCE ? (uInt)size : AT_ONCE;
}

static enum gunzip_status inflate_all(z_stream *stream, struct zr_arena *arena, size_t size, size_t max,
                                      const struct zr_cancel *cancel, char **out, size_t *out_size)
{
    size_t room = 0, used = 0, left = size;
    for (int code = Z_OK; code != Z_STREAM_END;) {
        if (zr_is_cancelled(cancel)) return GUNZIP_CANCELLED;
        if (used == room) {
            /* One byte more than the limit distinguishes a body that fits from a larger one. */
            size_t wanted = room ? room * 2 : FIRST_ROOM;
            if (wanted > max) wanted = max + 1;
            if (wanted == room) return GUNZIP_TOO_LARGE;
            char *grown = zr_arena_grow(arena, *out, used, wanted, 1);
            if (!grown) return GUNZIP_NO_MEMORY;
            *out = grown;
            room = wanted;
        }
        stream->avail_in = part(left);
        stream->avail_out = part(room - used);
        stream->next_out = (Bytef *)*out + used;
        uInt in_before = stream->avail_in, out_before = stream->avail_out;
        code = inflate(stream, Z_NO_FLUSH);
        left -= in_before - stream->avail_in;
        used += out_before - stream->avail_out;
        if (code == Z_MEM_ERROR) return GUNZIP_NO_MEMORY;
        bool stuck = code == Z_BUF_ERROR && used < room;
        /* A gzip file may have several members (RFC 1952, 2.2). */
        if (code == Z_STREAM_END && left > 0) code = inflateReset(stream);
        if (stuck || (code != Z_OK && code != Z_BUF_ERROR && code != Z_STREAM_END)) return GUNZIP_BROKEN;
    }
    *out_size = used;
    return used > max ? GUNZIP_TOO_LARGE : GUNZIP_OK;
}

enum gunzip_status gunzip(struct zr_arena *arena, const char *bytes, size_t size, size_t max,
                          const struct zr_cancel *cancel, char **out, size_t *out_size)
{
    z_stream stream = {.next_in = (z_const Bytef *)(uintptr_t)bytes};
    if (inflateInit2(&stream, MAX_WBITS + GZIP_FORMAT) != Z_OK) return GUNZIP_NO_MEMORY;
    *out = NULL;
    enum gunzip_status status = inflate_all(&stream, arena, size, max, cancel, out, out_size);
    inflateEnd(&stream);
    return status;
}
