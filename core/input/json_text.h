/* json_text.h - input: a string of JSON as it is written, and what it means (RFC 8259, section 7). */
#ifndef ZR_JSON_TEXT_H
#define ZR_JSON_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* From behind the opening quote to the closing one. */
struct zr_json_text {
    const char *at, *end;
    bool has_escapes;
};

/* The character of the \u escape at `at`, of one unit or of a surrogate pair, and how many bytes it takes; below 0
 * where there is none, with *length 0 where four hexadecimal digits are missing. */
int32_t zr_json_text_unit(const char *at, const char *end, size_t *length);

/* Writes a well-formed string with its escapes resolved, and returns how many bytes: no more than it has. */
size_t zr_json_text_resolve(const struct zr_json_text *text, char *out);

/* Is a well-formed string this word? */
bool zr_json_is(const struct zr_json_text *text, const char *word);

#endif
