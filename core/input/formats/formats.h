/* formats.h - input: table of the formats of bodies (format_rows.h).
 *
 * A new format is a row there, a file with zr_looks_so_ID and zr_read_ID (input.h), and a test.
 */
#ifndef ZR_FORMATS_H
#define ZR_FORMATS_H

#include "format_rows.h"
#include "input/formats/input.h"

struct zr_format_row {
    const char *name;        /* for messages */
    const char *suffix;      /* of file names */
    const char *media_types; /* separated by blanks; the first is the usual one */
    bool has_view;           /* a scene with its own view; else a bare mesh */
    bool is_binary;          /* may be binary: a byte order mark is not skipped */
    bool is_soup;            /* triangles share no corners */
    bool z_is_up;            /* default up axis of a bare mesh: z, else y; the parameter `up` overrides it */
    const char *text;        /* meaning for people */
    zr_looks_so_fn *looks_so;
    zr_format_read_fn *read;
};

extern const struct zr_format_row zr_format_rows[ZR_FORMAT_COUNT];

/* Returns the first format whose looks_so accepts the bytes, or ZR_FORMAT_UNKNOWN. */
enum zr_format zr_format_of_bytes(const char *bytes, size_t size);

/* zr_format_of_type: the format of a Content-Type, without its parameters; ZR_FORMAT_UNKNOWN if there is none.
 * zr_media_type_is_generic: true for NULL and for types that clients send by default, such as text/plain. */
enum zr_format zr_format_of_type(const char *media_type);
bool zr_media_type_is_generic(const char *media_type);

/* Lists the usual types, for a message: "application/json, model/obj". */
struct zr_format_types {
    char text[256];
};
struct zr_format_types zr_format_types_join(void);

#endif
