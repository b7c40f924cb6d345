/* text.h - input: quotes and places for messages about the input. */
#ifndef ZR_TEXT_H
#define ZR_TEXT_H

#include <stdbool.h>
#include <stddef.h>

#include "base/utf8.h"

/* Returns the value of a hexadecimal digit; -1 for other characters. */
static inline int zr_hex_digit(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/* Returns the length of a UTF-8 byte order mark at the start, which is no part of the text; 0: there is none. */
size_t zr_byte_order_mark(const char *bytes, size_t size);

/* Counts leading blanks, tabs and line ends, at most ZR_BLANKS_MAX. */
enum { ZR_BLANKS_MAX = 64 << 10 };
size_t zr_count_blanks(const char *bytes, size_t size);

/* True for the words that programs write for NaN and infinity: nan, -nan(ind), inf, 1.#QNAN. */
bool zr_is_not_finite(const char *word, size_t size);

/* Formats bytes of the input for a message: in single quotes, cut at a whole character, with '?' for bytes that are not
 * printable UTF-8. */
struct zr_quote {
    char text[64];
};
struct zr_quote zr_quote(const char *bytes, size_t size);

/* The reason of a refusal, for a caller that adds the place in the input. */
struct zr_reason {
    char text[160];
};
void zr_reason_give(struct zr_reason *reason, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Line and column of a byte, both from 1; columns count characters. */
struct zr_place {
    size_t line, column;
};
struct zr_place zr_place_of(const char *bytes, size_t offset);

#endif
