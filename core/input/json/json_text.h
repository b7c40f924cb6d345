/* json_text.h - input: JSON strings as written, and their decoded text (RFC 8259, section 7). */
#ifndef ZR_JSON_TEXT_H
#define ZR_JSON_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The bytes between the quotes, escapes unresolved. */
struct zr_json_text {
    const char *at, *end;
    bool has_escapes;
};

/* Decodes the \u escape at `at`, or the two of a surrogate pair; *length: their bytes. Negative if it is invalid;
 * *length is then 0 if hexadecimal digits are missing. */
int32_t zr_json_text_unit(const char *at, const char *end, size_t *length);

/* Writes a well-formed string with its escapes resolved and returns the bytes written, at most the length of `text`. */
size_t zr_json_text_resolve(const struct zr_json_text *text, char *out);

/* True if a well-formed string equals `word` after its escapes are resolved. */
bool zr_json_is(const struct zr_json_text *text, const char *word);

#endif
