#include "output/tokens.h"

const uint16_t zr_length_base[29] = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                     31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
const uint8_t zr_length_extra[29] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                     2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};

void zr_lengths_init(struct zr_lengths *lengths)
{
    for (int i = 0; i < ZR_MATCH_MIN; i++)
        lengths->parts[i] = zr_token_symbols(0, 0, 0, ZR_TOKEN_NO_SYMBOL);
    for (unsigned symbol = 0, length = ZR_MATCH_MIN; length <= ZR_MATCH_MAX; length++) {
        if (symbol < 28 && length == zr_length_base[symbol + 1]) symbol++;
        lengths->parts[length] =
            (uint64_t)(ZR_SYMBOL_LENGTH + symbol) << 27 | (uint64_t)(length - zr_length_base[symbol]) << 41;
    }
}

/* Bits 36 and up but for the length's extra bits, which `symbol` says how many are. */
static uint64_t distance_part(uint32_t distance, uint64_t length_part)
{
    uint32_t rest = distance - 1, symbol = rest, extra = 0;
    if (distance > 4) {
        uint32_t top = 31u - (uint32_t)__builtin_clz(rest);
        symbol = 2 * top + (rest >> (top - 1) & 1);
        extra = rest & ((1u << (top - 1)) - 1);
    }
    unsigned shift = zr_length_extra[(length_part >> 27 & 511) - ZR_SYMBOL_LENGTH];
    return (uint64_t)symbol << 36 | (uint64_t)extra << (41 + shift);
}

static void push(struct zr_tokens *tokens, size_t size, uint32_t distance)
{
    static const uint64_t none = ZR_TOKEN_NO_SYMBOL | ZR_TOKEN_NO_SYMBOL << 9 | ZR_TOKEN_NO_SYMBOL << 18;
    uint64_t part = tokens->lengths.parts[size];
    zr_tokens_push(tokens, none | part | distance_part(distance, part));
}

void zr_tokens_match(struct zr_tokens *tokens, size_t size, uint32_t distance)
{
    if (size <= ZR_MATCH_MAX) {
        push(tokens, size, distance);
        return;
    }
    size_t whole = size > ZR_MATCH_MAX ? (size - ZR_MATCH_MIN) / ZR_MATCH_MAX : 0; /* leaves enough for another match */
    size -= whole * ZR_MATCH_MAX;
    if (distance > 4)
        for (; whole > 0; whole--)
            push(tokens, ZR_MATCH_MAX, distance);
    for (size_t some; whole > 0; whole -= some) {
        some = whole < ZR_TOKEN_REPEATED_MAX ? whole : ZR_TOKEN_REPEATED_MAX;
        zr_tokens_push(tokens,
                       (uint64_t)ZR_TOKEN_REPEATED << 36 | (uint64_t)some << 41 | (uint64_t)(distance - 1) << 57);
    }
    if (size > ZR_MATCH_MAX) { /* 259 and 260 are two matches, since none is shorter than 3 */
        push(tokens, size - ZR_MATCH_MIN, distance);
        size = ZR_MATCH_MIN;
    }
    push(tokens, size, distance);
}
