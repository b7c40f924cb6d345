/* tokens.h - output: what deflate is told to write, one step at a time.
 *
 * A token is up to four symbols and a distance, so that all of them are written by the same
 * instructions, without a branch that depends on the picture: three literals and a run, a zero
 * and a run of zeros, a string seen before, or literals alone. From the lowest bit:
 *
 *     4 x 9  literals or a length (257..285), the length last; ZR_TOKEN_NO_SYMBOL where there is none
 *     5      the distance's symbol; ZR_TOKEN_NO_DISTANCE; or ZR_TOKEN_REPEATED
 *     18     extra bits of the length, and above them those of the distance
 *
 * ZR_TOKEN_REPEATED: the longest match, again and again, at a distance of up to 4: the extra bits
 * are how often (16) and the distance - 1 (2).
 * Why: measured on a flat bunny, 1920x1080: one symbol a step 1.3 ms, this 0.6 ms.
 */
#ifndef ZR_TOKENS_H
#define ZR_TOKENS_H

#include <stddef.h>
#include <stdint.h>

enum {
    ZR_TOKEN_NO_SYMBOL = 287,
    ZR_TOKEN_NO_DISTANCE = 31,
    ZR_TOKEN_REPEATED = 30,
    ZR_TOKEN_REPEATED_MAX = 0xffff,
    ZR_MATCH_MIN = 3, /* bytes, as the format has them */
    ZR_MATCH_MAX = 258,
    ZR_DISTANCE_MAX = 32768,
    ZR_SYMBOL_LENGTH = 257, /* the first that is a length */
    ZR_SYMBOL_END = 256
};

/* The lengths and distances that symbols begin at, and their extra bits (RFC 1951, 3.2.5). */
extern const uint16_t zr_length_base[29];
extern const uint8_t zr_length_extra[29];
static inline unsigned zr_distance_extra(unsigned symbol)
{
    return symbol < 4 ? 0 : symbol / 2 - 1;
}

/* By length: what a token says of it, in place (symbol, no distance, extra bits). Below
 * ZR_MATCH_MIN: nothing. */
struct zr_lengths {
    uint64_t parts[ZR_MATCH_MAX + 1];
};
void zr_lengths_init(struct zr_lengths *lengths);

/* Symbols where others will be left out. */
static inline uint64_t zr_token_symbols(uint64_t s0, uint64_t s1, uint64_t s2, uint64_t s3)
{
    return s0 | s1 << 9 | s2 << 18 | s3 << 27 | (uint64_t)ZR_TOKEN_NO_DISTANCE << 36;
}

struct zr_tokens {
    uint64_t *at;
    size_t count, room;
    struct zr_lengths lengths;
};

/* The newest tokens; whoever calls sees to the room. */
static inline void zr_tokens_push(struct zr_tokens *tokens, uint64_t token)
{
    tokens->at[tokens->count++] = token;
}

/* `size` bytes (from ZR_MATCH_MIN on) equal to those `distance` earlier. Up to
 * ZR_TOKENS_A_MATCH(size) tokens. */
void zr_tokens_match(struct zr_tokens *tokens, size_t size, uint32_t distance);
#define ZR_TOKENS_A_MATCH(size) (2 + (size) / ZR_MATCH_MAX)

#endif
