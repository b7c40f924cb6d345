#include "output/deflate.h"

#include <string.h>

#include "output/huffman.h"

/* Codes are this long at most, so that those of a token's first three symbols, then the rest, fit a 64-bit word behind
 * 7 bits that wait. Costs less than 0.1 % of bytes. */
enum { CODE_BITS_MAX = 12 };

enum { SYMBOLS = 286, SYMBOL_SLOTS = 512, DISTANCES = 30, DISTANCE_SLOTS = 32, CODE_SYMBOLS = 19 };
enum { BLOCK_FIXED = 1, BLOCK_DYNAMIC = 2 };

struct counts {
    uint32_t symbols[4][SYMBOL_SLOTS]; /* one a place in a token: equal neighbours do not wait for each other */
    uint32_t distances[DISTANCE_SLOTS];
};

struct code {
    uint8_t symbol_lengths[SYMBOLS + 2], distance_lengths[DISTANCES + 2];
    uint16_t symbols[SYMBOLS + 2], distances[DISTANCES + 2];
};

static inline unsigned field(uint64_t token, unsigned first, unsigned bits)
{
    return (unsigned)(token >> first & ((1u << bits) - 1));
}

/* ---- bits ---- */

static inline void put(struct zr_deflate *d, uint64_t value, unsigned count)
{
    d->bits |= value << d->bit_count;
    d->bit_count += count;
}

static inline void flush(struct zr_deflate *d)
{
    uint64_t bits = d->bits;
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    bits = __builtin_bswap64(bits);
#endif
    memcpy(d->out, &bits, sizeof bits);
    d->out += d->bit_count / 8;
    d->bits >>= d->bit_count & ~7u;
    d->bit_count &= 7;
}

void zr_deflate_align(struct zr_deflate *d, bool last)
{
    put(d, last, 3);
    d->bit_count = (d->bit_count + 7) & ~7u;
    put(d, 0xffff0000u, 32);
    flush(d);
}

/* ---- counting ---- */

static void count_tokens(const uint64_t *tokens, size_t count, struct counts *counts)
{
    memset(counts, 0, sizeof *counts);
    for (size_t i = 0; i < count; i++) {
        uint64_t token = tokens[i];
        unsigned distance = field(token, 36, 5);
        if (distance == ZR_TOKEN_REPEATED) {
            counts->symbols[3][SYMBOLS - 1] += field(token, 41, 16);
            counts->distances[field(token, 57, 2)] += field(token, 41, 16);
            continue;
        }
        counts->symbols[0][field(token, 0, 9)]++;
        counts->symbols[1][field(token, 9, 9)]++;
        counts->symbols[2][field(token, 18, 9)]++;
        counts->symbols[3][field(token, 27, 9)]++;
        counts->distances[distance]++;
    }
    for (int i = 0; i < SYMBOLS; i++)
        counts->symbols[0][i] += counts->symbols[1][i] + counts->symbols[2][i] + counts->symbols[3][i];
    counts->symbols[0][ZR_SYMBOL_END] = 1;
}

static uint64_t bits_of(const struct counts *counts, const struct code *code)
{
    uint64_t bits = 0; /* extra bits are the same for every code */
    for (int i = 0; i < SYMBOLS; i++)
        bits += (uint64_t)counts->symbols[0][i] * code->symbol_lengths[i];
    for (int i = 0; i < DISTANCES; i++)
        bits += (uint64_t)counts->distances[i] * code->distance_lengths[i];
    return bits;
}

/* ---- a code, and how it is told ---- */

static void finish_code(struct code *code)
{
    zr_huffman_codes(code->symbol_lengths, SYMBOLS + 2, code->symbols);
    zr_huffman_codes(code->distance_lengths, DISTANCES + 2, code->distances);
}

static void fixed_code(struct code *code)
{
    for (int i = 0; i < SYMBOLS + 2; i++)
        code->symbol_lengths[i] = (uint8_t)(i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8);
    memset(code->distance_lengths, 5, sizeof code->distance_lengths);
    finish_code(code);
}

/* The code lengths of a block, themselves run-length and Huffman coded (RFC 1951, 3.2.7). */
struct heading {
    unsigned symbols, distances, codes;
    unsigned count;
    uint8_t steps[SYMBOLS + DISTANCES], repeats[SYMBOLS + DISTANCES];
    uint8_t lengths[CODE_SYMBOLS];
};

static const uint8_t HEADING_ORDER[CODE_SYMBOLS] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};

static unsigned heading_extra(unsigned step)
{
    return step == 16 ? 2 : step == 17 ? 3 : step == 18 ? 7 : 0;
}

static void add_step(struct heading *heading, unsigned step, unsigned repeats)
{
    heading->steps[heading->count] = (uint8_t)step;
    heading->repeats[heading->count++] = (uint8_t)repeats;
}

static void add_run(struct heading *heading, unsigned length, unsigned size)
{
    while (length == 0 && size >= 3) {
        unsigned some = size < 138 ? size : 138;
        add_step(heading, some < 11 ? 17 : 18, some < 11 ? some - 3 : some - 11);
        size -= some;
    }
    for (bool said = false; size > 0; said = true) {
        unsigned some = said && size >= 3 ? (size < 6 ? size : 6) : 1;
        if (some > 1)
            add_step(heading, 16, some - 3);
        else
            add_step(heading, length, 0);
        size -= some;
    }
}

static uint64_t make_heading(const struct code *code, struct heading *heading)
{
    uint8_t all[SYMBOLS + DISTANCES];
    uint32_t counts[CODE_SYMBOLS] = {0};
    *heading = (struct heading){.symbols = SYMBOLS, .distances = DISTANCES, .codes = CODE_SYMBOLS};
    while (heading->symbols > ZR_SYMBOL_END + 1 && code->symbol_lengths[heading->symbols - 1] == 0)
        heading->symbols--;
    while (heading->distances > 1 && code->distance_lengths[heading->distances - 1] == 0)
        heading->distances--;
    memcpy(all, code->symbol_lengths, heading->symbols);
    memcpy(all + heading->symbols, code->distance_lengths, heading->distances);
    for (unsigned i = 0, size; i < heading->symbols + heading->distances; i += size) {
        for (size = 1; i + size < heading->symbols + heading->distances && all[i + size] == all[i];)
            size++;
        add_run(heading, all[i], size);
    }
    for (unsigned i = 0; i < heading->count; i++)
        counts[heading->steps[i]]++;
    /* A code of a single symbol is not complete, and zlib wants this one to be. */
    if (zr_huffman_lengths(counts, CODE_SYMBOLS, 7, heading->lengths) == 1) heading->lengths[counts[0] ? 1 : 0] = 1;
    while (heading->codes > 4 && heading->lengths[HEADING_ORDER[heading->codes - 1]] == 0)
        heading->codes--;
    uint64_t bits = 14 + 3 * (uint64_t)heading->codes;
    for (unsigned i = 0; i < heading->count; i++)
        bits += heading->lengths[heading->steps[i]] + heading_extra(heading->steps[i]);
    return bits;
}

static void put_heading(struct zr_deflate *d, const struct heading *heading)
{
    uint16_t codes[CODE_SYMBOLS];
    zr_huffman_codes(heading->lengths, CODE_SYMBOLS, codes);
    put(d, (heading->symbols - 257) | (heading->distances - 1) << 5 | (heading->codes - 4) << 10, 14);
    flush(d);
    for (unsigned i = 0; i < heading->codes; i++) {
        put(d, heading->lengths[HEADING_ORDER[i]], 3);
        flush(d);
    }
    for (unsigned i = 0; i < heading->count; i++) {
        unsigned step = heading->steps[i];
        put(d, codes[step], heading->lengths[step]);
        put(d, heading->repeats[i], heading_extra(step));
        flush(d);
    }
}

/* ---- writing ---- */

/* code | length << 16 | extra bits << 24; 0 where nothing is written. */
struct entries {
    uint32_t symbols[SYMBOL_SLOTS], distances[DISTANCE_SLOTS];
};

static void make_entries(const struct code *code, struct entries *entries)
{
    memset(entries, 0, sizeof *entries);
    for (unsigned i = 0; i < SYMBOLS; i++) {
        uint32_t extra = i >= ZR_SYMBOL_LENGTH ? zr_length_extra[i - ZR_SYMBOL_LENGTH] : 0;
        entries->symbols[i] = code->symbols[i] | (uint32_t)code->symbol_lengths[i] << 16 | extra << 24;
    }
    for (unsigned i = 0; i < DISTANCES; i++)
        entries->distances[i] =
            code->distances[i] | (uint32_t)code->distance_lengths[i] << 16 | (uint32_t)zr_distance_extra(i) << 24;
}

static inline unsigned entry_length(uint32_t entry)
{
    return entry >> 16 & 255;
}

static inline void put_entry(struct zr_deflate *d, uint32_t entry)
{
    put(d, entry & 0xffff, entry_length(entry));
}

static void put_repeated(struct zr_deflate *d, const struct entries *entries, uint64_t token)
{
    uint32_t symbol = entries->symbols[SYMBOLS - 1], distance = entries->distances[field(token, 57, 2)];
    for (unsigned i = field(token, 41, 16); i > 0; i--) {
        put_entry(d, symbol);
        put_entry(d, distance);
        flush(d);
    }
}

static void put_tokens(struct zr_deflate *deflate, const struct entries *entries, const uint64_t *tokens, size_t count)
{
    struct zr_deflate d = *deflate; /* in registers */
    for (size_t i = 0; i < count; i++) {
        uint64_t token = tokens[i];
        unsigned distance_symbol = field(token, 36, 5);
        if (distance_symbol == ZR_TOKEN_REPEATED) {
            put_repeated(&d, entries, token);
            continue;
        }
        uint32_t last = entries->symbols[field(token, 27, 9)], distance = entries->distances[distance_symbol];
        uint64_t extra = token >> 41;
        unsigned length_extra = last >> 24;
        put_entry(&d, entries->symbols[field(token, 0, 9)]);
        put_entry(&d, entries->symbols[field(token, 9, 9)]);
        put_entry(&d, entries->symbols[field(token, 18, 9)]);
        flush(&d);
        put_entry(&d, last);
        put(&d, extra & ((1u << length_extra) - 1), length_extra);
        put_entry(&d, distance);
        put(&d, extra >> length_extra, distance >> 24);
        flush(&d);
    }
    put_entry(&d, entries->symbols[ZR_SYMBOL_END]);
    flush(&d);
    *deflate = d;
}

void zr_deflate_block(struct zr_deflate *deflate, const uint64_t *tokens, size_t count)
{
    struct counts counts;
    struct code code, fixed;
    struct heading heading;
    struct entries entries;
    count_tokens(tokens, count, &counts);
    memset(&code, 0, sizeof code);
    zr_huffman_lengths(counts.symbols[0], SYMBOLS, CODE_BITS_MAX, code.symbol_lengths);
    if (zr_huffman_lengths(counts.distances, DISTANCES, CODE_BITS_MAX, code.distance_lengths) == 0)
        code.distance_lengths[0] = 1; /* no matches: some readers want a code all the same */
    finish_code(&code);
    fixed_code(&fixed);
    uint64_t bits = make_heading(&code, &heading) + bits_of(&counts, &code);
    bool dynamic = bits < bits_of(&counts, &fixed);
    put(deflate, (uint64_t)(dynamic ? BLOCK_DYNAMIC : BLOCK_FIXED) << 1, 3);
    if (dynamic) put_heading(deflate, &heading);
    make_entries(dynamic ? &code : &fixed, &entries);
    put_tokens(deflate, &entries, tokens, count);
}
