/* matcher.h - output: filtered rows -> tokens: what repeats, and what must be spelled out.
 *
 * A row is cut into runs of equal pixels. A run of zeros (as the row above) is a match at distance 1, another run its
 * first pixel and a match at the distance of one pixel, and a string of two or more pixels that begins as one lately
 * seen began is a match with that. Strings are looked for where runs begin, all of a row at once and before anything
 * is decided: so the processor does not wait for one decision to look up the next. (Measured on a flat bunny,
 * 1920x1080: tokens take 1.5 ms, and 2.7 ms with look-ups in turn.)
 */
#ifndef ZR_MATCHER_H
#define ZR_MATCHER_H

#include "base/arena.h"
#include "output/filter.h"
#include "output/tokens.h"

enum {
    ZR_MATCHER_WIDTH_MAX = 1 << 20, /* pixels; so that a place is a row and a pixel in 32 bits */
    ZR_MATCHER_ROWS_MAX = (1 << 10) - 1,
    ZR_MATCHER_BLOCK_MIN = 1 << 15, /* tokens, where there are more than room for: a quarter of a megabyte, in cache */
    ZR_MATCHER_HASH_BITS = 12       /* 14 save 0.3 % of bytes and take 10 % more time */
};

/* Found, but looked at for 32 bytes only. */
struct zr_string {
    uint16_t distance; /* bytes - 1 */
    uint16_t pixels;   /* 0: none */
};

struct zr_matcher {
    enum zr_layout layout;
    uint32_t width;
    size_t stride;      /* bytes of a kept row */
    uint32_t ring_rows; /* kept rows: more than matches reach back to */
    uint32_t row;       /* the last one's number in the strip, from 1 on */
    uint32_t kept;      /* rows kept so far; those that are equal to the one above are not */
    uint8_t *ring;
    uint32_t *offsets;         /* by row: bytes into `ring` */
    uint32_t *places;          /* by hash: row << 20 | pixel; 0: none yet */
    uint32_t *starts;          /* runs of a row: the pixel each begins at, and the end */
    uint32_t *listed;          /* runs that are not of zeros */
    struct zr_string *strings; /* by run that is not of zeros */
    struct zr_tokens tokens;
};

/* For rows of up to ZR_MATCHER_WIDTH_MAX pixels. False once the arena has failed. */
bool zr_matcher_init(struct zr_matcher *matcher, struct zr_arena *arena, enum zr_layout layout, uint32_t width);

/* Forgets all rows: what comes is decoded without what came. */
void zr_matcher_begin(struct zr_matcher *matcher);

/* One more row, of at most ZR_MATCHER_ROWS_MAX since the beginning: its tokens, filter byte included, and the sum of
 * its bytes. False, and nothing done, where there is no room for its tokens: write them first. */
bool zr_matcher_row(struct zr_matcher *matcher, const uint8_t *row, const uint8_t *above, struct zr_adler *sum);

#endif
