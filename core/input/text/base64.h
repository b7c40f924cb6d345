/* base64.h - input: decodes base64, strictly.
 *
 * Source: RFC 4648, section 4: the alphabet with + and /, padded, no white space. The bits after the last byte are 0
 *         (section 3.5), so that each sequence of bytes has one spelling.
 */
#ifndef ZR_BASE64_H
#define ZR_BASE64_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/status.h"
#include "input/text/text.h"

/* Returns a sufficient size of the output for `size` characters. */
static inline size_t zr_base64_room(size_t size)
{
    return size / 4 * 3;
}

/* Decodes into `out`, which has zr_base64_room(size) bytes; *used: the bytes written. False for invalid text; *used is
 * then the index of the first bad character, or `size` if the text is too short. */
bool zr_base64_decode(const char *text, size_t size, unsigned char *out, size_t *used);

/* Decodes "data:image/png;base64,iVBO..." (RFC 2397), of `length` bytes, into the arena. ";base64" is required. The
 * media type and its parameters are ignored: the bytes decide the format. ZR_OK, ZR_NO_MEMORY, or ZR_BAD_SCENE with the
 * reason. */
enum zr_status zr_data_uri_read(struct zr_arena *arena, const char *text, size_t length, const void **bytes,
                                size_t *size, struct zr_reason *reason);

#endif
