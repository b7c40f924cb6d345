/* log_text.h - texts of strangers as strings of one line of JSON. Pure. */
#ifndef ZRASTERD_LOG_TEXT_H
#define ZRASTERD_LOG_TEXT_H

#include <stddef.h>

/* LOG_TEXT_ESCAPED_SIZE: room for a text, each byte escaped to six. */
enum { LOG_TEXT_SIZE = 513, LOG_TEXT_ESCAPED_SIZE = 6 * LOG_TEXT_SIZE };

/* Writes the inside of a JSON string (RFC 8259, 7): valid UTF-8, at most LOG_TEXT_SIZE - 1 bytes of it before it is
 * escaped. Escaped is also all that moves a terminal's cursor, ends its line or turns the direction of its text: DEL,
 * C1 controls, U+2028, U+2029, and marks of direction. */
void log_text_escape(char out[LOG_TEXT_ESCAPED_SIZE], const char *text);

/* Copies a query with the values of secrets replaced by "-": signature, token, access_token. Names are compared as a
 * reader of the query would: percent-decoded. */
void log_text_redact(char *out, size_t size, const char *query);

#endif
