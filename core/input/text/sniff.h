/* sniff.h - input: detects the format of bytes. */
#ifndef ZR_SNIFF_H
#define ZR_SNIFF_H

#include "core.h"

/* Returns the first format whose looks_so accepts the bytes, or ZR_FORMAT_UNKNOWN. */
enum zr_format zr_format_of_bytes(const char *bytes, size_t size);

/* Names the format for a message, also foreign ones: "STL", "a PNG picture"; NULL: unknown. */
const char *zr_bytes_in_words(const char *bytes, size_t size);

/* True if the bytes begin with a UTF-16 byte order mark. Binary formats may begin with these bytes, too. */
bool zr_is_utf16(const char *bytes, size_t size);

#endif
