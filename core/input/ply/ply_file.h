/* ply_file.h - input: the state of reading a PLY file, element by element in the order of the file.
 *
 * All threads read binary vertices without lists (ply_vertices.c), and binary faces if all are triangles (ply_faces.c).
 * One thread reads other elements record by record (ply_records.c).
 * Source: Turk, "The PLY Polygon File Format", 1994, and the type names of later programs (int32, float64).
 */
#ifndef ZR_PLY_FILE_H
#define ZR_PLY_FILE_H

#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

#include "base/inlined.h"
#include "core.h"
#include "input/text/recenter.h"
#include "input/text/text.h"
#include "scene/scene_builder.h"

/* ---- ply_header.c: elements, their properties and the position of the values ---- */

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

/* Reads the header. Errors of ZR_BAD_SYNTAX name the line. Names point into the bytes.
 * The caller checks the counts against the bytes that follow. */
enum zr_status zr_ply_read_header(struct zr_arena *arena, const char *bytes, size_t size, struct zr_ply_header *header,
                                  struct zr_error *error);

/* ---- ply_values.c: binary values of any type and byte order as doubles, exactly ---- */

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

/* ---- the state of reading ---- */

/* Values that are drawn. Three of a group belong together. */
enum zr_ply_slot {
    ZR_PLY_X,
    ZR_PLY_Y,
    ZR_PLY_Z,
    ZR_PLY_NX,
    ZR_PLY_NY,
    ZR_PLY_NZ,
    ZR_PLY_RED,
    ZR_PLY_GREEN,
    ZR_PLY_BLUE,
    ZR_PLY_ALPHA,
    ZR_PLY_S,
    ZR_PLY_T,
    ZR_PLY_VERTEX1,
    ZR_PLY_VERTEX2,
    ZR_PLY_SLOTS
};

/* The largest number of vertices, faces, corners or edges. */
enum { ZR_PLY_COUNT_MAX = 1 << 30 };

enum zr_ply_kind { ZR_PLY_VERTEX, ZR_PLY_FACE, ZR_PLY_STRIPS, ZR_PLY_EDGE, ZR_PLY_OTHER };

/* The drawn properties of an element; NULL if it has none. */
struct zr_ply_plan {
    enum zr_ply_kind kind;
    const struct zr_ply_element *element;
    const struct zr_ply_property *slots[ZR_PLY_SLOTS];
    bool is_splat;                         /* red, green and blue are coefficients of a Gaussian splat's mean colour */
    bool is_packed;                        /* red, green and blue are one property, 0xRRGGBB, as an integer or its bits
                                              as a float */
    const struct zr_ply_property *indices; /* the list of vertices */
};

/* Polygons, as many as have been read. */
struct zr_ply_faces {
    size_t count, corner_count;
    size_t room, corner_room;
    uint32_t *offsets; /* room + 1; NULL: triangles */
    uint32_t *indices; /* corner_room */
    zr_vec4 *colors;   /* room; NULL: faces have no colours */
};

/* Counts for warnings, and the first place of each. */
struct zr_ply_oddities {
    size_t small_faces, first_small_face;
    size_t broken_lines, first_broken_line; /* records of ASCII that are not one line each */
    size_t broken_record;
    struct zr_ply_word broken_name;
    size_t comments, first_comment; /* lines of ASCII */
    size_t trailing_bytes;
};

/* A position in the file, and the lines there. */
struct zr_ply_place {
    const char *at;
    size_t line, last_line;
};

struct zr_ply_file {
    struct zr_arena *arena;
    struct zr_team *team;
    const struct zr_cancel *cancel;
    const struct zr_limits *limits;
    struct zr_error *error;
    struct zr_ply_header header;
    const char *at, *end; /* unread bytes */
    size_t line;          /* ASCII: of `at` */
    size_t last_line;     /* ASCII: line of the last record's end */
    size_t vertex_count;
    zr_vec4 *positions; /* x of a hole, a vertex that is not finite, is NaN */
    zr_vec4 *colors, *texcoords;
    zr_vec3 *normals;
    atomic_bool has_holes, has_odd_colors;
    atomic_bool is_far; /* a coordinate is beyond the limit (recenter.h) */
    struct zr_ply_place vertices_at;
    const struct zr_ply_element *vertices;
    const double *origin; /* subtracted from positions; NULL: none */
    bool finds_box;       /* vertices are read for their bounds: one thread */
    const uint8_t *used;  /* if finds_box: one per vertex, 1 if it is drawn; NULL: all are */
    struct zr_box box;
    bool faces_have_colors;
    struct zr_ply_faces faces;
    size_t line_count;
    uint32_t *lines;
    struct zr_ply_oddities odd;
};

/* ply_plan.c: finds the drawn properties of an element. */
struct zr_ply_plan zr_ply_plan_of(const struct zr_ply_element *element);

/* Returns the value of this type that is a colour of 1. */
double zr_ply_color_scale(enum zr_ply_type type);

/* Values of up to ZR_PLY_BLOCK records, one column per slot. */
enum { ZR_PLY_BLOCK = 256 };
struct zr_ply_columns {
    double values[ZR_PLY_SLOTS][ZR_PLY_BLOCK];
};

/* Stores vertices first..first + count - 1. Reports those beyond the limit, up to `faults` faults. */
void zr_ply_store_vertices(struct zr_ply_file *file, const struct zr_ply_plan *plan,
                           const struct zr_ply_columns *columns, size_t first, size_t count, size_t faults,
                           struct zr_error *error);

/* Stores colours unclamped; sets has_odd_colors if one is beyond 0 to 1. */
void zr_ply_store_colors(struct zr_ply_file *file, const struct zr_ply_plan *plan, const struct zr_ply_columns *columns,
                         size_t count, zr_vec4 *out);

/* Allocates the arrays of the vertices. False without memory. */
bool zr_ply_make_vertices(struct zr_ply_file *file, const struct zr_ply_plan *plan);

/* Reads binary vertices without lists. The caller has checked that the bytes suffice. */
enum zr_status zr_ply_read_vertices(struct zr_ply_file *file, const struct zr_ply_plan *plan);

/* Reads binary faces up to the first that is not a triangle or has a fault. Returns the number of faces read. */
size_t zr_ply_read_triangles(struct zr_ply_file *file, const struct zr_ply_plan *plan);

/* Reads the records of any element from number `first` on. */
enum zr_status zr_ply_read_records(struct zr_ply_file *file, const struct zr_ply_plan *plan, size_t first);

/* ASCII: skips white space, and lines of comments if a line begins here. Counts the comments. */
void zr_ply_skip_comments(struct zr_ply_file *file);

/* ply_recenter.c: if a coordinate is beyond the limit, subtracts the middle of the drawn positions from all. */
enum zr_status zr_ply_adjust(struct zr_ply_file *file, struct zr_scene_builder *builder);

/* ply_finish.c: makes the mesh and the warnings. */
enum zr_status zr_ply_finish(struct zr_ply_file *file, struct zr_scene_builder *builder);

/* ---- ply_faces.c ---- */

/* Makes room for this many more faces and corners, and adds missing offsets. False without memory. */
bool zr_ply_faces_reserve(struct zr_ply_file *file, size_t faces, size_t corners);

/* Ends a face whose corners are the last `corners` of the indices. `color` may be NULL: white. False without memory. */
bool zr_ply_faces_end(struct zr_ply_file *file, const zr_vec4 *color);

#endif
