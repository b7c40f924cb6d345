/* sniff.h - input: the format that bytes look like. */
#ifndef ZR_SNIFF_H
#define ZR_SNIFF_H

#include "zraster.h"

/* The first row whose bytes look so; ZR_FORMAT_UNKNOWN: none. */
enum zr_format zr_format_of_bytes(const char *bytes, size_t size);

/* The same in words, foreign formats included: "STL", "a PNG picture"; NULL: unknown. */
const char *zr_bytes_in_words(const char *bytes, size_t size);

/* How many bytes of a byte order mark there are, as some editors put in front of UTF-8; it is no part of the text. */
size_t zr_byte_order_mark(const char *bytes, size_t size);

#endif
