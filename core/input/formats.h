/* formats.h - input: the formats of bodies, a row each (format_rows.h).
 *
 * A new format is a row there, a file with zr_looks_so_ID and zr_read_ID (input.h), and a test.
 */
#ifndef ZR_FORMATS_H
#define ZR_FORMATS_H

#include "input/input.h"

struct zr_format_row {
    const char *name;        /* for messages */
    const char *suffix;      /* of files */
    const char *media_types; /* apart by blanks; the first is the usual one */
    bool has_view;           /* a scene, with a view of its own; else a bare mesh */
    bool is_binary;          /* may be; no byte order mark is skipped */
    bool is_soup;            /* triangles share no corners */
    bool z_is_up;            /* of bare meshes, unless the query has `up`; else y */
    zr_looks_so_fn *looks_so;
    zr_format_read_fn *read;
};

extern const struct zr_format_row zr_format_rows[ZR_FORMAT_COUNT];

/* The format of a Content-Type, whatever parameters it has; ZR_FORMAT_UNKNOWN where it is none, or says nothing: where
 * it is NULL or one that is sent for want of a better one (zr_media_type_is_generic). */
enum zr_format zr_format_of_type(const char *media_type);
bool zr_media_type_is_generic(const char *media_type);

/* The usual types, for a message: "application/json, model/obj". */
struct zr_format_types {
    char text[256];
};
struct zr_format_types zr_format_types_join(void);

#endif
