/* ply_header.h - input: the header of a PLY file: its elements, their properties and the position of the values.
 *
 * Source: Turk, "The PLY Polygon File Format", 1994, and the type names of later programs (int32, float64).
 */
#ifndef ZR_PLY_HEADER_H
#define ZR_PLY_HEADER_H

#include <stdint.h>

#include "base/arena.h"
#include "base/status.h"
#include "input/text/text.h"

enum zr_ply_form { ZR_PLY_ASCII, ZR_PLY_LITTLE, ZR_PLY_BIG };

/* ROW(ID, name, newer name, C type) */
#define ZR_PLY_TYPE_ROWS(ROW)                                                                                          \
    ROW(I8, "char", "int8", int8_t)                                                                                    \
    ROW(U8, "uchar", "uint8", uint8_t)                                                                                 \
    ROW(I16, "short", "int16", int16_t)                                                                                \
    ROW(U16, "ushort", "uint16", uint16_t)                                                                             \
    ROW(I32, "int", "int32", int32_t)                                                                                  \
    ROW(U32, "uint", "uint32", uint32_t)                                                                               \
    ROW(F32, "float", "float32", float)                                                                                \
    ROW(F64, "double", "float64", double)

enum zr_ply_type {
#define ZR_PLY_TYPE_ENUM(ID, ...) ZR_PLY_##ID,
    ZR_PLY_TYPE_ROWS(ZR_PLY_TYPE_ENUM)
#undef ZR_PLY_TYPE_ENUM
        ZR_PLY_TYPES
};

/* A word of the header, not terminated. */
struct zr_ply_word {
    const char *at;
    size_t size;
};
bool zr_ply_word_is(struct zr_ply_word word, const char *text);

/* Formats a word for a message, as zr_quote without the quotes. */
struct zr_quote zr_ply_printable(struct zr_ply_word word);

struct zr_ply_property {
    struct zr_ply_word name;
    enum zr_ply_type type; /* of the value, or of each value of a list */
    bool is_list;
    enum zr_ply_type count_type; /* of the length of a list */
    size_t offset;               /* in a binary record, if no list precedes it */
};

struct zr_ply_element {
    struct zr_ply_word name;
    size_t count;
    size_t property_count, list_count;
    struct zr_ply_property *properties;
    size_t least_bytes; /* minimum of a record; its exact size in binary without lists */
};

struct zr_ply_header {
    enum zr_ply_form form;
    size_t element_count;
    struct zr_ply_element *elements;
    size_t size;  /* bytes, up to the first value */
    size_t lines; /* of the header */
    size_t texture_count, unknown_count;
    struct zr_ply_word texture; /* the first `comment TextureFile` */
    size_t unknown_line;        /* the first unknown line */
};

enum { ZR_PLY_HEADER_MAX = 1 << 18 };

size_t zr_ply_type_bytes(enum zr_ply_type type);

/* Returns the property with this name, or NULL. */
const struct zr_ply_property *zr_ply_find(const struct zr_ply_element *element, const char *name);

/* True if the bytes begin as every PLY file does. */
bool zr_ply_begins(const char *bytes, size_t size);

/* Reads the header. Errors of ZR_BAD_SYNTAX name the line. Names point into the bytes.
 * The caller checks the counts against the bytes that follow. */
enum zr_status zr_ply_read_header(struct zr_arena *arena, const char *bytes, size_t size, struct zr_ply_header *header,
                                  struct zr_error *error);

#endif
