/* json_writer.h - input: a short text of JSON, value after value, each at its JSON Pointer (RFC 6901, without escapes).
 *
 *     zr_json_go_to(&writer, "/view/fit/padding");
 *     zr_json_put_number(&writer, 0.1);
 *     zr_json_go_to(&writer, "");                    {"view":{"fit":{"padding":0.1}}}
 */
#ifndef ZR_JSON_WRITER_H
#define ZR_JSON_WRITER_H

#include <stdbool.h>
#include <stddef.h>

/* Its caller sees to it that `text` has room for all that is put into it and a final zero: six bytes per byte of a
 * string, 32 per number, and each pointer with two bytes more per segment. */
struct zr_json_writer {
    char *text;
    size_t used;
    const char *pointer; /* of the value before; "" at the beginning */
};

/* Leaves the objects and lists of the value before that the next one is not in, and enters those of the next one.
 * Values of one object come one after the other, and lists have one item, 0. "" ends the text. */
void zr_json_go_to(struct zr_json_writer *json, const char *pointer);

void zr_json_put(struct zr_json_writer *json, const char *text);    /* JSON, as it is */
void zr_json_put_number(struct zr_json_writer *json, double value); /* a finite one */

/* A string. Bytes that JSON does not allow in strings become question marks. */
void zr_json_put_string(struct zr_json_writer *json, const char *text);

/* How many characters two pointers share, up to their last common stroke. */
size_t zr_json_shared(const char *a, const char *b);

/* Whether a segment is the number of an item. */
static inline bool zr_json_is_index(const char *segment)
{
    return *segment >= '0' && *segment <= '9';
}

#endif
