#include "output/images/mask_png.h"

#include "output/images/png_chunk.h"

/* ---- bits of the deflate stream ---- */

enum { LAST_CODE = 285 /* of the length 258 */, LONGEST = 258, SHORTEST = 3, ADLER_BASE = 65521, ADLER_STEP = 1 << 16 };

struct writer {
    struct zr_buffer *out;
    uint64_t bits; /* not yet written */
    uint32_t bit_count;
    uint64_t a, b;    /* sums of Adler-32 */
    uint8_t value;    /* of the run that is not yet written */
    uint64_t pending; /* its length */
};

/* Adds up to 32 bits, the lowest first. */
static void put_bits(struct writer *w, uint64_t bits, uint32_t count)
{
    w->bits |= bits << w->bit_count;
    w->bit_count += count;
    if (w->bit_count < 32) return;
    const uint8_t bytes[4] = {(uint8_t)w->bits, (uint8_t)(w->bits >> 8), (uint8_t)(w->bits >> 16),
                              (uint8_t)(w->bits >> 24)};
    zr_buffer_add(w->out, bytes, sizeof bytes);
    w->bits >>= 32;
    w->bit_count -= 32;
}

/* Adds a Huffman code, the highest bit first. */
static void put_code(struct writer *w, uint32_t code, uint32_t count)
{
    uint32_t turned = 0;
    for (uint32_t i = 0; i < count; i++)
        turned |= (code >> i & 1) << (count - 1 - i);
    put_bits(w, turned, count);
}

/* Lengths of the codes of the block: literal 0 and 255: 3 bits; end: 4; lengths 3 to 257: 6; length 258: 2; distance 1:
 * 1. The table itself is written with codes for the lengths 1 to 4, 6, repetition (16) and zeros (18). */
static void put_table(struct writer *w)
{
    static const uint8_t order[] = {2, 0, 3, 0, 0, 0, 0, 3, 0, 0, 0, 3, 0, 3, 0, 3, 0, 3}; /* 16, 17, 18, 0, 8, ... 1 */
    enum { ONE = 2, TWO = 3, THREE = 4, FOUR = 5, SIX = 6, ZEROS = 7, REPEAT = 0 };
    put_bits(w, 1, 1);                   /* the last block, */
    put_bits(w, 2, 2);                   /* with a table */
    put_bits(w, LAST_CODE + 1 - 257, 5); /* literals and lengths */
    put_bits(w, 0, 5);                   /* one distance */
    put_bits(w, sizeof order - 4, 4);
    for (size_t i = 0; i < sizeof order; i++)
        put_bits(w, order[i], 3);
    put_code(w, THREE, 3); /* 0 */
    put_code(w, ZEROS, 3); /* 1 .. 254 */
    put_bits(w, 138 - 11, 7);
    put_code(w, ZEROS, 3);
    put_bits(w, 116 - 11, 7);
    put_code(w, THREE, 3); /* 255 */
    put_code(w, FOUR, 3);  /* the end */
    put_code(w, SIX, 3);   /* 28 lengths */
    for (int i = 0; i < 4; i++) {
        put_code(w, REPEAT, 2);
        put_bits(w, 6 - 3, 2);
    }
    put_code(w, REPEAT, 2);
    put_bits(w, 3 - 3, 2);
    put_code(w, TWO, 3); /* the length 258 */
    put_code(w, ONE, 3); /* the distance */
}

/* Writes that the last byte is repeated; SHORTEST <= length <= LONGEST. */
static void put_repeated(struct writer *w, uint32_t length)
{
    if (length == LONGEST) {
        put_code(w, 0, 2);
    } else {
        uint32_t code, extra = 0;
        const uint32_t from = length - SHORTEST;
        if (from < 8) {
            code = from;
        } else {
            while (from >> extra >= 8)
                extra++;
            code = 4 * extra + (from >> extra);
        }
        put_code(w, 36 + code, 6);
        if (extra > 0) put_bits(w, from & ((1u << extra) - 1), extra);
    }
    put_code(w, 0, 1);
}

/* ---- runs ---- */

static void sum(struct writer *w, uint64_t value, uint64_t count)
{
    while (count > 0) {
        const uint64_t some = count < ADLER_STEP ? count : ADLER_STEP;
        w->b = (w->b + some * w->a + some * (some + 1) / 2 * value) % ADLER_BASE;
        w->a = (w->a + some * value) % ADLER_BASE;
        count -= some;
    }
}

static void put_literal(struct writer *w, uint8_t value)
{
    put_code(w, value == 0 ? 2 : 3, 3);
}

static void flush_run(struct writer *w)
{
    uint64_t left = w->pending;
    if (left == 0) return;
    sum(w, w->value, left);
    put_literal(w, w->value);
    for (left--; left >= SHORTEST;) {
        const uint32_t some = left < LONGEST ? (uint32_t)left : LONGEST;
        put_repeated(w, some);
        left -= some;
    }
    for (; left > 0; left--)
        put_literal(w, w->value);
    w->pending = 0;
}

static void add_run(struct writer *w, uint8_t value, uint64_t count)
{
    if (count == 0) return;
    if (value != w->value) flush_run(w);
    w->value = value;
    w->pending += count;
}

/* Returns the first column from `x` on whose bit is `value`, or the end of the words. */
static uint32_t find_bit(const struct zr_bit_mask *mask, const uint64_t *row, uint32_t x, bool value)
{
    uint32_t word = (x - mask->left) / 64;
    uint64_t skip = UINT64_MAX << (x - mask->left) % 64;
    for (; word < mask->words; word++, skip = UINT64_MAX) {
        const uint64_t bits = (value ? row[word] : ~row[word]) & skip;
        if (bits != 0) return mask->left + 64 * word + (uint32_t)__builtin_ctzll(bits);
    }
    return mask->left + 64 * mask->words;
}

/* The filter of each row is None, a byte of 0. */
static void add_row(struct writer *w, const struct zr_bit_mask *mask, const uint64_t *row)
{
    uint32_t x = 0;
    add_run(w, 0, 1);
    for (uint32_t at = mask->left; row && at < mask->left + 64 * mask->words;) {
        const uint32_t begin = find_bit(mask, row, at, true);
        if (begin >= mask->width) break;
        const uint32_t end = find_bit(mask, row, begin, false);
        at = end < mask->width ? end : mask->width;
        add_run(w, 0, begin - x);
        add_run(w, 255, at - begin);
        x = at;
        if (end >= mask->width) break;
    }
    add_run(w, 0, mask->width - x);
}

/* ---- the file ---- */

static void put_pixels(const struct zr_bit_mask *mask, struct zr_buffer *out)
{
    static const uint8_t head[2] = {0x78, 0x01};
    struct writer w = {.out = out, .a = 1};
    zr_buffer_add(out, head, sizeof head);
    put_table(&w);
    for (uint32_t y = 0; y < mask->height; y++)
        add_row(&w, mask, zr_bit_mask_row(mask, y));
    flush_run(&w);
    put_code(&w, 8, 4); /* the end of the block */
    for (; w.bit_count > 0; w.bits >>= 8, w.bit_count = w.bit_count < 8 ? 0 : w.bit_count - 8) {
        const uint8_t byte = (uint8_t)w.bits;
        zr_buffer_add(out, &byte, 1);
    }
    zr_png_put_word(out, (uint32_t)(w.b << 16 | w.a));
}

bool zr_mask_png_write(const struct zr_bit_mask *mask, struct zr_buffer *out)
{
    static const uint8_t signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    static const uint8_t grey[] = {8, 0, 0, 0, 0}; /* bits, grey, and the only methods */
    zr_buffer_add(out, signature, sizeof signature);
    size_t at = zr_png_chunk_begin(out, "IHDR");
    zr_png_put_word(out, mask->width);
    zr_png_put_word(out, mask->height);
    zr_buffer_add(out, grey, sizeof grey);
    zr_png_chunk_end(out, at);
    at = zr_png_chunk_begin(out, "IDAT");
    put_pixels(mask, out);
    zr_png_chunk_end(out, at);
    at = zr_png_chunk_begin(out, "IEND");
    return zr_png_chunk_end(out, at);
}
