/* site_file.h - a file that the daemon serves from memory. */
#ifndef ZRASTERD_SITE_FILE_H
#define ZRASTERD_SITE_FILE_H

#include <stddef.h>

struct site_file {
    const char *name;          /* "": the page; of the manual: address below /docs/, "": its first page */
    const char *title, *files; /* of a scene: name for people; names of its files, as items of JSON; NULL: no scene */
    const char *type;
    const char *tag; /* hash of the bytes, hexadecimal */
    const unsigned char *bytes;
    size_t size, plain_size; /* compressed, decompressed; plain_size 0: not compressed */
};

#endif
