/* text.h - makes untrusted bytes safe for JSON and headers. */
#ifndef ZRASTERD_TEXT_H
#define ZRASTERD_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* Copies `source` as valid UTF-8, cut at a complete character to `size` bytes with the final zero. Each invalid byte
 * becomes U+FFFD. */
void text_to_utf8(char *out, size_t size, const char *source);

/* Copies `source` as printable ASCII, cut likewise. Any other byte becomes '?'. */
void text_to_ascii(char *out, size_t size, const char *source);

/* Returns the length without trailing space, which is no part of a header's value (RFC 9112, 5). */
size_t text_trimmed_length(const char *text);

/* Searches an item, without regard to case, in a list with spaces or commas between its items. */
bool text_has_item(const char *list, const char *item, size_t length);

/* Searches an entity tag, given with its quotes, in the value of If-None-Match: "*", or a list (RFC 9110, 13.1.2).
 * Quotes stand only around tags. `list` may be NULL: the header was not sent. */
bool text_has_tag(const char *list, const char *tag);

#endif
