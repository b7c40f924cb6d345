/* sniff.h - input: names the format of bytes. */
#ifndef ZR_SNIFF_H
#define ZR_SNIFF_H

#include <stdbool.h>
#include <stddef.h>

/* Names the format for a message, also foreign ones: "STL", "a PNG picture"; NULL: unknown. */
const char *zr_bytes_in_words(const char *bytes, size_t size);

/* True if the bytes begin with a UTF-16 byte order mark. Binary formats may begin with these bytes, too. */
bool zr_is_utf16(const char *bytes, size_t size);

/* True if the bytes are the text that a clone without Git LFS has in place of a file. */
bool zr_is_lfs_pointer(const char *bytes, size_t size);

#endif
