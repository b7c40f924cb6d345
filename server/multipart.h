/* multipart.h - a body of several parts (multipart/form-data): where each begins and ends.
 *
 * Nothing is copied but names: parts point into the body. What two readers could read in
 * two ways is refused: bare line feeds, folded headers, a backslash in a name, two parts of
 * one name, a boundary with something behind it, transfer encodings that would change the bytes
 * (binary, 8bit and 7bit leave them as they are).
 * Source: RFC 7578 (form-data), RFC 2046 section 5.1 (multipart), RFC 9110 section 5.6.
 */
#ifndef ZRASTERD_MULTIPART_H
#define ZRASTERD_MULTIPART_H

#include <stdbool.h>
#include <stddef.h>

enum {
    MULTIPART_PARTS_MAX = 32,
    MULTIPART_HEADER_MAX = 4096,                         /* bytes of one part's headers */
    MULTIPART_NAME_MAX = 128,                            /* bytes */
    MULTIPART_BOUNDARY_MAX = 70,                         /* characters */
    MULTIPART_BOUNDARY_SIZE = MULTIPART_BOUNDARY_MAX + 1 /* with the final zero */
};

struct multipart_part {
    char name[MULTIPART_NAME_MAX + 1];
    const char *type; /* Content-Type as sent, not terminated; NULL: none */
    size_t type_size;
    const char *bytes;
    size_t size;
};

struct multipart {
    size_t count;
    struct multipart_part parts[MULTIPART_PARTS_MAX];
};

/* The boundary that a Content-Type header names, its type already known to be
 * multipart/form-data. False, and *fault says why, where it names none that is allowed. */
bool multipart_boundary(const char *content_type, char boundary[MULTIPART_BOUNDARY_SIZE], const char **fault);

/* False, and *fault says why, where the bytes are not whole and unambiguous. */
bool multipart_parse(const char *boundary, const char *bytes, size_t size, struct multipart *out, const char **fault);

/* The part of that name, NULL where there is none. */
const struct multipart_part *multipart_find(const struct multipart *multipart, const char *name);

#endif
