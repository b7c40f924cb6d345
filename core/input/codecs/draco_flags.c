/* Flags of the Draco bitstream, coded by asymmetric numeral systems of two symbols (Duda, arXiv:1311.2540). */
#include "input/codecs/draco_stream.h"

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
