/* base64.h - input: base64 -> bytes, strictly.
 *
 * Source: RFC 4648, section 4: the alphabet with + and /, padded, no white space, and the
 *         bits behind the last byte are 0 (section 3.5), so that bytes have one spelling.
 */
#ifndef ZR_BASE64_H
#define ZR_BASE64_H

#include <stdbool.h>
#include <stddef.h>

/* Room that is enough for what `size` characters decode to. */
static inline size_t zr_base64_room(size_t size)
{
    return size / 4 * 3;
}

/* Decodes into `out`, which has that room. False where the text is not base64: *used is
 * then the character where that shows, `size` where it ends too early; else it is the
 * count of bytes written. */
bool zr_base64_decode(const char *text, size_t size, unsigned char *out, size_t *used);

#endif
