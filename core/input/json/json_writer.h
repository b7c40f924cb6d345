/* json_writer.h - input: writes a short JSON text value by value, each at its JSON Pointer (RFC 6901, without escapes).
 *
 *     zr_json_go_to(&writer, "/view/fit/padding");
 *     zr_json_put_number(&writer, 0.1);
 *     zr_json_go_to(&writer, "");                    {"view":{"fit":{"padding":0.1}}}
 */
#ifndef ZR_JSON_WRITER_H
#define ZR_JSON_WRITER_H

#include <stdbool.h>
#include <stddef.h>

/* The caller provides a `text` with room for all values and a final zero: six bytes per byte of a string, 32 per
 * number, and for each pointer its length and two bytes per segment. */
struct zr_json_writer {
    char *text;
    size_t used;
    const char *pointer; /* of the last value; "" at the beginning */
};

/* Closes the objects and lists that the new value is outside of, and opens the ones around it. The values of one object
 * must be consecutive; lists have one item, 0. "" ends the text. */
void zr_json_go_to(struct zr_json_writer *json, const char *pointer);

void zr_json_put(struct zr_json_writer *json, const char *text);    /* JSON, copied as it is */
void zr_json_put_number(struct zr_json_writer *json, double value); /* finite */

/* Writes a string. Bytes that JSON forbids in strings become question marks. */
void zr_json_put_string(struct zr_json_writer *json, const char *text);
void zr_json_put_part(struct zr_json_writer *json, const char *text, size_t size); /* its first bytes */

/* Returns the length of the common prefix of two pointers, up to and including its last '/'. */
size_t zr_json_shared(const char *a, const char *b);

/* True if a segment is the number of an item. */
static inline bool zr_json_is_index(const char *segment)
{
    return *segment >= '0' && *segment <= '9';
}

#endif
