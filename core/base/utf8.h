/* utf8.h - base: characters of UTF-8. */
#ifndef ZR_UTF8_H
#define ZR_UTF8_H

#include <stdbool.h>
#include <stddef.h>

static inline bool zr_utf8_in(char byte, unsigned char low, unsigned char high)
{
    return (unsigned char)byte >= low && (unsigned char)byte <= high;
}

/* Returns the length, 1..4, of the UTF-8 character at `at`; 0 if it is invalid (overlong, a surrogate, beyond U+10FFFF,
 * cut short by `end`). Requires at < end. Source: RFC 3629, section 4. */
static inline size_t zr_utf8_length(const char *at, const char *end)
{
    unsigned char lead = (unsigned char)*at;
    size_t left = (size_t)(end - at);
    if (lead < 0x80) return 1;
    if (lead < 0xC2 || lead > 0xF4 || left < 2) return 0;
    if (lead < 0xE0) return zr_utf8_in(at[1], 0x80, 0xBF) ? 2 : 0;
    if (left < 3 || !zr_utf8_in(at[2], 0x80, 0xBF)) return 0;
    if (lead < 0xF0) return zr_utf8_in(at[1], lead == 0xE0 ? 0xA0 : 0x80, lead == 0xED ? 0x9F : 0xBF) ? 3 : 0;
    if (left < 4 || !zr_utf8_in(at[3], 0x80, 0xBF)) return 0;
    return zr_utf8_in(at[1], lead == 0xF0 ? 0x90 : 0x80, lead == 0xF4 ? 0x8F : 0xBF) ? 4 : 0;
}

#endif
