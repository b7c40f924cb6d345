/* draco_stream.h - input: bytes, bits and entropy codes of the Draco bitstream; private to its decoder.
 *
 * Errors: a read beyond the end returns 0 and sets is_broken, which stays set. */
#ifndef ZR_DRACO_STREAM_H
#define ZR_DRACO_STREAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/cancel.h"

/* Elements between checks for cancellation: at most about 100 microseconds. */
enum { ZR_DRACO_AT_ONCE = 4096 };

struct zr_draco_stream {
    const unsigned char *at, *end;
    bool is_broken;
};

/* Returns the next `count` bytes; NULL after the end. */
const unsigned char *zr_draco_take(struct zr_draco_stream *stream, uint64_t count);

/* Read little-endian numbers, and a number of 7 bits per byte, the lowest first. */
uint32_t zr_draco_u8(struct zr_draco_stream *stream);
uint32_t zr_draco_u16(struct zr_draco_stream *stream);
uint32_t zr_draco_u32(struct zr_draco_stream *stream);
uint64_t zr_draco_varint(struct zr_draco_stream *stream);

/* Reads a varint of 32 bits; larger ones are broken. */
uint32_t zr_draco_count(struct zr_draco_stream *stream);

/* Bits of a range of bytes, from the lowest bit of each. */
struct zr_draco_bits {
    const unsigned char *bytes;
    uint64_t at, end; /* numbers of bits */
    bool is_broken;
};

/* Reads up to 32 bits. */
static inline uint32_t zr_draco_bits_read(struct zr_draco_bits *bits, unsigned count)
{
    const unsigned char *at = bits->bytes + bits->at / 8;
    const unsigned shift = (unsigned)(bits->at % 8);
    uint64_t value = 0;
    if (count > bits->end - bits->at) {
        bits->is_broken = true;
        return 0;
    }
    for (unsigned k = 0; 8 * k < shift + count; k++)
        value |= (uint64_t)at[k] << 8 * k;
    bits->at += count;
    return (uint32_t)(value >> shift & ((UINT64_C(1) << count) - 1));
}

/* Flags of one probability, coded by asymmetric numeral systems. */
struct zr_draco_flags {
    const unsigned char *bytes;
    size_t left;    /* bytes before the read ones; they are read backwards */
    uint32_t state; /* 0: not opened */
    uint32_t ones;  /* probability of 1, of 256 */
    bool is_broken;
};
bool zr_draco_flags_open(struct zr_draco_stream *stream, struct zr_draco_flags *flags);
bool zr_draco_flags_next(struct zr_draco_flags *flags);

/* Starts a state of an entropy code from its last bytes. `base`: its lowest value. False if there are too few. */
bool zr_draco_state_open(const unsigned char *bytes, size_t size, uint32_t base, uint32_t *state, size_t *left);

/* draco_symbols.c: reads `count` symbols, in groups of `width` with one tag each if the stream has tags. `scratch`
 * holds tables until the call ends. False if the stream is broken, without memory, or if cancelled. */
bool zr_draco_read_symbols(struct zr_draco_stream *stream, struct zr_arena *scratch, const struct zr_cancel *cancel,
                           uint32_t count, uint32_t width, uint32_t *out);

#endif
