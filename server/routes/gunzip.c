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

/* Bytes that come out. */
struct output {
    struct zr_arena *arena;
    char *bytes;
    size_t used, room, max;
};

static enum gunzip_status make_room(struct output *out)
{
    /* One byte more than the limit distinguishes a body that fits from a larger one. */
    size_t wanted = out->room ? out->room * 2 : FIRST_ROOM;
    if (wanted > out->max) wanted = out->max + 1;
    if (wanted == out->room) return GUNZIP_TOO_LARGE;
    char *grown = zr_arena_grow(out->arena, out->bytes, out->used, wanted, 1);
    if (!grown) return GUNZIP_NO_MEMORY;
    out->bytes = grown;
    out->room = wanted;
    return GUNZIP_OK;
}

static enum gunzip_status inflate_all(z_stream *stream, size_t left, const struct zr_cancel *cancel, struct output *out)
{
    for (int code = Z_OK; code != Z_STREAM_END;) {
        if (zr_is_cancelled(cancel)) return GUNZIP_CANCELLED;
        const enum gunzip_status status = out->used == out->room ? make_room(out) : GUNZIP_OK;
        if (status != GUNZIP_OK) return status;
        stream->avail_in = part(left);
        stream->avail_out = part(out->room - out->used);
        stream->next_out = (Bytef *)out->bytes + out->used;
        uInt in_before = stream->avail_in, out_before = stream->avail_out;
        code = inflate(stream, Z_NO_FLUSH);
        left -= in_before - stream->avail_in;
        out->used += out_before - stream->avail_out;
        if (code == Z_MEM_ERROR) return GUNZIP_NO_MEMORY;
        bool stuck = code == Z_BUF_ERROR && out->used < out->room;
        /* A gzip file may have several members (RFC 1952, 2.2). */
        if (code == Z_STREAM_END && left > 0) code = inflateReset(stream);
        if (stuck || (code != Z_OK && code != Z_BUF_ERROR && code != Z_STREAM_END)) return GUNZIP_BROKEN;
    }
    return out->used > out->max ? GUNZIP_TOO_LARGE : GUNZIP_OK;
}

enum gunzip_status gunzip(struct zr_arena *arena, const struct zr_cancel *cancel, size_t max, const char **bytes,
                          size_t *size)
{
    struct output out = {.arena = arena, .max = max};
    z_stream stream = {.next_in = (z_const Bytef *)(uintptr_t)*bytes};
    if (inflateInit2(&stream, MAX_WBITS + GZIP_FORMAT) != Z_OK) return GUNZIP_NO_MEMORY;
    const enum gunzip_status status = inflate_all(&stream, *size, cancel, &out);
    inflateEnd(&stream);
    if (status != GUNZIP_OK) return status;
    *bytes = out.bytes;
    *size = out.used;
    return GUNZIP_OK;
}
