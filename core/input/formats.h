/* formats.h - input: the formats of bodies, a row each (format_rows.h), and what bytes look like.
 *
 * A new format is a row there, a file with its reader (input.h), and a test.
 */
#ifndef ZR_FORMATS_H
#define ZR_FORMATS_H

#include "input/input.h"

struct zr_format_row {
    const char *name;        /* for messages */
    const char *suffix;      /* of files */
    const char *media_types; /* apart by blanks; the first is the usual one */
    bool has_view;           /* a scene, with a view of its own; else a bare mesh */
    const struct zr_format_reader *reader;
};

extern const struct zr_format_row zr_format_rows[ZR_FORMAT_COUNT];

/* The format of a Content-Type, whatever parameters it has; ZR_FORMAT_UNKNOWN where it is none, or says nothing: where
 * it is NULL or one that is sent for want of a better one (zr_media_type_is_generic). */
enum zr_format zr_format_of_type(const char *media_type);
bool zr_media_type_is_generic(const char *media_type);

/* What the bytes look like. ZR_FORMAT_UNKNOWN: none of these. */
enum zr_format zr_format_of_bytes(const char *bytes, size_t size);

/* The same in words, what is no format included: "STL", "a PNG picture"; NULL: nothing that is known. */
const char *zr_bytes_in_words(const char *bytes, size_t size);

/* How many bytes of a byte order mark there are, as some editors put in front of UTF-8; it is no part of the text. */
size_t zr_byte_order_mark(const char *bytes, size_t size);

/* The usual types, for a message: "application/json, model/obj". */
struct zr_format_types {
    char text[256];
};
struct zr_format_types zr_format_types_join(void);

#endif
