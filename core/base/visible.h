/* visible.h - base: texts of strangers, such as names of files, without what would command a terminal: control
 * characters, and marks that turn the direction of text or end its line. */
#ifndef ZR_VISIBLE_H
#define ZR_VISIBLE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/utf8.h"

/* Returns the code point of a character of valid UTF-8 with this length. */
static inline unsigned zr_code_point(const char *at, size_t length)
{
    const unsigned char *c = (const unsigned char *)at;
    if (length == 1) return c[0];
    unsigned code = c[0] & (0xFFu >> (length + 1));
    for (size_t i = 1; i < length; i++)
        code = code << 6 | (c[i] & 0x3Fu);
    return code;
}

static inline bool zr_is_visible(unsigned code)
{
    const bool is_control = code < 0x20 || (code >= 0x7F && code < 0xA0);
    const bool is_mark = code == 0x61C || code == 0xFEFF || (code >= 0x200B && code <= 0x200F) ||
                         (code >= 0x2028 && code <= 0x202E) || (code >= 0x2060 && code <= 0x206F);
    return !is_control && !is_mark;
}

/* Returns the length of the visible character at `at`; 0: another one, or an invalid byte. Requires at < end. */
static inline size_t zr_visible_length(const char *at, const char *end)
{
    const size_t length = zr_utf8_length(at, end);
    return length > 0 && zr_is_visible(zr_code_point(at, length)) ? length : 0;
}

/* Replaces each byte of the text that shows nothing by '?'. `has_lines`: line ends stay. */
void zr_make_visible(char *text, bool has_lines);

#endif
