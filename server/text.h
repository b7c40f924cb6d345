/* text.h - untrusted bytes made fit to be shown: in JSON and in headers. */
#ifndef ZRASTERD_TEXT_H
#define ZRASTERD_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* Copies `source` as valid UTF-8, with U+FFFD for each byte that is none, cut at
 * a whole character to fit `size` bytes with the final zero. */
void text_to_utf8(char *out, size_t size, const char *source);

/* Copies `source` as printable ASCII, '?' for every other byte. */
void text_to_ascii(char *out, size_t size, const char *source);

/* Length without the space at the end, which is no part of a header's value (RFC 9112, 5). */
size_t text_trimmed_length(const char *text);

/* `length` bytes of a query, %XX and '+' decoded, to `out` of length + 1 bytes.
 * False where an escape is broken or gives a zero byte. */
bool text_percent_decode(char *out, const char *source, size_t length);

#endif
