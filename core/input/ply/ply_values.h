/* ply_values.h - input: reads values of binary PLY of any type and byte order as doubles, exactly. */
#ifndef ZR_PLY_VALUES_H
#define ZR_PLY_VALUES_H

#include <stdint.h>
#include <string.h>

#include "base/inlined.h"
#include "input/ply/ply_header.h"

/* True if the byte order differs from the machine's. */
static inline bool zr_ply_is_swapped(enum zr_ply_form form)
{
    return (form == ZR_PLY_BIG) != (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__);
}

ZR_INLINED uint32_t zr_ply_word32(const char *at, bool is_swapped)
{
    uint32_t bits;
    memcpy(&bits, at, sizeof bits);
    return is_swapped ? __builtin_bswap32(bits) : bits;
}

/* Reads one value. */
double zr_ply_value(const char *at, enum zr_ply_type type, bool is_swapped);

/* Reads `count` values, the first at `at`, `stride` bytes apart. */
void zr_ply_column(const char *at, size_t stride, size_t count, enum zr_ply_type type, bool is_swapped, double *out);

#endif
