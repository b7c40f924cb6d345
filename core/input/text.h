/* text.h - input: what every reader needs to speak about text it did not write. */
#ifndef ZR_TEXT_H
#define ZR_TEXT_H

#include <stddef.h>

/* The length, 1..4, of the UTF-8 character at `at`, or 0 where the bytes are none
 * (overlong forms, surrogates, beyond U+10FFFF, cut short by `end`).
 * Source: RFC 3629, section 4. Requires at < end. */
size_t zr_utf8_length(const char *at, const char *end);

/* How many blanks, tabs and ends of lines bytes begin with, of the first ZR_BLANKS_MAX. */
enum { ZR_BLANKS_MAX = 64 << 10 };
size_t zr_count_blanks(const char *bytes, size_t size);

/* Foreign bytes made fit for an error message: in single quotes, cut at a whole
 * character, whatever is not printable UTF-8 replaced by '?'. */
struct zr_quote {
    char text[64];
};
struct zr_quote zr_quote(const char *bytes, size_t size);

/* Why bytes are refused, told to whoever knows where in the input they stood. */
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
