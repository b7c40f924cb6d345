/* multipart.h - finds the parts of a multipart/form-data body.
 *
 * Copies only names; parts point into the body. Input that two readers could read differently is refused: bare line
 * feeds, folded headers, a backslash in a name, two parts with one name, bytes after a boundary, transfer encodings
 * that change bytes (binary, 8bit and 7bit do not).
 * Source: RFC 7578 (form-data), RFC 2046 section 5.1 (multipart), RFC 9110 section 5.6.
 */
#ifndef ZRASTERD_MULTIPART_H
#define ZRASTERD_MULTIPART_H

#include <stdbool.h>
#include <stddef.h>

enum {
    MULTIPART_PARTS_MAX = 256,
    MULTIPART_HEADER_MAX = 4096,                         /* bytes of one part's headers */
    MULTIPART_NAME_MAX = 128,                            /* bytes */
    MULTIPART_BOUNDARY_MAX = 70,                         /* characters */
    MULTIPART_BOUNDARY_SIZE = MULTIPART_BOUNDARY_MAX + 1 /* with the final zero */
};

struct multipart_part {
    char name[MULTIPART_NAME_MAX + 1];
    const char *type; /* Content-Type as sent, not zero-terminated; NULL: none */
    size_t type_size;
    bool is_optional; /* Zraster-Use: optional */
    const char *bytes;
    size_t size;
};

struct multipart {
    size_t count;
    struct multipart_part parts[MULTIPART_PARTS_MAX];
};

/* Reads the boundary from a Content-Type of multipart/form-data. False: *fault has the reason. */
bool multipart_boundary(const char *content_type, char boundary[MULTIPART_BOUNDARY_SIZE], const char **fault);

/* Finds all parts of a body. False: the bytes are incomplete or ambiguous, and *fault has the reason. */
bool multipart_parse(const char *boundary, const char *bytes, size_t size, struct multipart *out, const char **fault);

/* Returns the part with this name, or NULL. */
const struct multipart_part *multipart_find(const struct multipart *multipart, const char *name);

#endif
