/* base64.h - input: decodes base64, strictly.
 *
 * Source: RFC 4648, section 4: the alphabet with + and /, padded, no white space. The bits behind the last byte are 0
 *         (section 3.5), so that each sequence of bytes has one spelling.
 */
#ifndef ZR_BASE64_H
#define ZR_BASE64_H

#include <stdbool.h>
#include <stddef.h>

/* Returns a sufficient size of the output for `size` characters. */
static inline size_t zr_base64_room(size_t size)
{
    return size / 4 * 3;
}

/* Decodes into `out`, which has zr_base64_room(size) bytes; *used: the bytes written. False for invalid text; *used is
 * then the index of the first bad character, or `size` if the text is too short. */
bool zr_base64_decode(const char *text, size_t size, unsigned char *out, size_t *used);

#endif
