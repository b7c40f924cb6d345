/* Reads numbers of the Draco bitstream. */
#include "input/codecs/draco_stream.h"

const unsigned char *zr_draco_take(struct zr_draco_stream *stream, uint64_t count)
{
    const unsigned char *at = stream->at;
    if (stream->is_broken || count > (size_t)(stream->end - at)) {
        stream->is_broken = true;
        return NULL;
    }
    stream->at += count;
    return at;
}

/* Reads `count` bytes, the lowest first. */
static uint32_t read_number(struct zr_draco_stream *stream, unsigned count)
{
    const unsigned char *at = zr_draco_take(stream, count);
    uint32_t value = 0;
    for (unsigned k = 0; at && k < count; k++)
        value |= (uint32_t)at[k] << 8 * k;
    return value;
}

uint32_t zr_draco_u8(struct zr_draco_stream *stream)
{
    return read_number(stream, 1);
}

uint32_t zr_draco_u16(struct zr_draco_stream *stream)
{
    return read_number(stream, 2);
}

uint32_t zr_draco_u32(struct zr_draco_stream *stream)
{
    return read_number(stream, 4);
}

uint64_t zr_draco_varint(struct zr_draco_stream *stream)
{
    uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
        const uint32_t byte = zr_draco_u8(stream);
        value |= (uint64_t)(byte & 0x7F) << shift;
        if (byte < 0x80) return value;
    }
    stream->is_broken = true;
    return 0;
}

uint32_t zr_draco_count(struct zr_draco_stream *stream)
{
    const uint64_t value = zr_draco_varint(stream);
    if (value <= UINT32_MAX) return (uint32_t)value;
    stream->is_broken = true;
    return 0;
}
