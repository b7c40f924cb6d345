/* Reads numbers and flags of the Draco bitstream. */
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

/* ---- flags, coded by asymmetric numeral systems of two symbols (Duda, arXiv:1311.2540) ---- */

enum { BASE = 4096, PRECISION = 256 };

bool zr_draco_state_open(const unsigned char *bytes, size_t size, uint32_t base, uint32_t *state, size_t *left)
{
    const unsigned count = size > 0 ? 1u + (bytes[size - 1] >> 6) : 1;
    if (count > size) return false;
    *left = size - count;
    *state = bytes[size - 1] & 0x3Fu;
    for (unsigned k = 2; k <= count; k++)
        *state = *state << 8 | bytes[size - k];
    *state += base;
    return *state < base * 256;
}

bool zr_draco_flags_open(struct zr_draco_stream *stream, struct zr_draco_flags *flags)
{
    const uint32_t zeros = zr_draco_u8(stream);
    const uint64_t size = zr_draco_varint(stream);
    const unsigned char *bytes = zr_draco_take(stream, size);
    *flags = (struct zr_draco_flags){.bytes = bytes, .ones = (PRECISION - zeros) % PRECISION};
    if (bytes && zr_draco_state_open(bytes, (size_t)size, BASE, &flags->state, &flags->left)) return true;
    stream->is_broken = true;
    return false;
}

bool zr_draco_flags_next(struct zr_draco_flags *flags)
{
    if (flags->state < BASE) {
        if (flags->left == 0) {
            flags->is_broken = true;
            return false;
        }
        flags->state = flags->state << 8 | flags->bytes[--flags->left];
    }
    const uint32_t quotient = flags->state / PRECISION, rest = flags->state % PRECISION;
    const bool is_set = rest < flags->ones;
    flags->state = is_set ? quotient * flags->ones + rest : flags->state - quotient * flags->ones - flags->ones;
    return is_set;
}
