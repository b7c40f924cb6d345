#include "scene/mesh_label.h"

#include <inttypes.h>
#include <stdio.h>

enum { NAME_BYTES = 32 };

/* True for a continuation byte of UTF-8. */
static int is_continuation(char byte)
{
    return (byte & 0xC0) == 0x80;
}

struct zr_mesh_label zr_mesh_label_of(uint64_t number, const char *name)
{
    struct zr_mesh_label label;
    char cut[NAME_BYTES + 1];
    int length = 0;
    for (; length < NAME_BYTES && name[length]; length++)
        cut[length] = (unsigned char)name[length] < ' ' || name[length] == 0x7F ? '?' : name[length];
    while (length > 0 && is_continuation(name[length]))
        length--;
    cut[length] = '\0';
    snprintf(label.text, sizeof label.text, length ? "mesh %" PRIu64 " '%s'" : "mesh %" PRIu64, number, cut);
    return label;
}
