/* stl_file.h - input: types and functions that the readers of STL share; private to them.
 *
 * Source: 3D Systems, StereoLithography Interface Specification, 1989; words in any case, any white space between.
 * Speed:  the functions that split text into words are inlined, since they take most of the reading time. */
#ifndef ZR_STL_FILE_H
#define ZR_STL_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "core.h"
#include "input/text/chunk.h"
#include "input/text/recenter.h"
#include "scene/scene_builder.h"

/* ---- stl_text.c: facets of ASCII STL ---- */

/* The largest number of triangles of an STL file. */
enum { ZR_STL_TRIANGLES_MAX = 1 << 29 };

/* Geometry of a file, in the arena. */
struct zr_stl {
    size_t vertices, facets;
    const zr_vec4 *positions;
    const uint32_t *indices;    /* of the facets' corners; NULL: consecutive positions */
    const uint32_t *offsets;    /* facets + 1: the first corner of each; NULL: all facets are triangles */
    const zr_vec4 *face_colors; /* or NULL */
};

/* True if the first word is "solid", which many binary files begin with, too. */
bool zr_stl_is_text(const char *bytes, size_t size);

/* For zr_parts_cut: returns the end of a line that is only "endfacet", at least `size` bytes after `at`, or `end`.
 * Such a line nearly always ends a facet, but a normal may be any words. There are more than `size` bytes, and at least
 * as many as the word has. */
const char *zr_stl_cut(const char *at, size_t size, const char *end);

/* Reads vertices, and ignores normals. Adds a warning for each kind of oddity. Returns ZR_BAD_SYNTAX or
 * ZR_BAD_SCENE, with details in *error, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_stl_text_read(struct zr_scene_builder *builder, const struct zr_request *request,
                                const struct zr_limits *limits, struct zr_stl *out, struct zr_error *error);

/* Oddities that do not stop reading. Each kind causes one warning. */
enum zr_stl_oddity {
    ZR_STL_CR,        /* lines that end in CR alone */
    ZR_STL_COMMENT,   /* comment lines */
    ZR_STL_COLOR,     /* colour lines */
    ZR_STL_UNKNOWN,   /* other lines between facets */
    ZR_STL_WORDS,     /* extra words after a keyword and its numbers */
    ZR_STL_SPLIT_END, /* "end loop" */
    ZR_STL_NO_NORMAL, /* facets without three words after "normal" */
    ZR_STL_POLYGON,   /* facets of more than three corners */
    ZR_STL_NO_SOLID,  /* facets outside of a solid */
    ZR_STL_NO_END,    /* solids without "endsolid" */
    ZR_STL_HOLE,      /* facets with a coordinate that is not finite */
    ZR_STL_ODDITIES
};

struct zr_stl_note {
    size_t count, line; /* `line`: of the first one */
    const char *at;     /* text of the first one up to the end of its line, or NULL */
    size_t size;
};

/* Initially all zero. */
struct zr_stl_notes {
    struct zr_stl_note of[ZR_STL_ODDITIES];
};

/* ---- words ---- */

/* State of one thread that reads a part, or the rest of the file. */
struct zr_stl_reader {
    const struct zr_limits *limits;
    const struct zr_cancel *cancel;
    struct zr_arena *arena;       /* used if notes is not NULL */
    const char *begin, *at, *end; /* `begin` is the begin of a line */
    char line_end;                /* '\n', or '\r' if lines end in CR alone */
    size_t line;
    bool inside;                /* within a solid */
    bool goes_on;               /* text follows after `end` */
    bool starts_line;           /* lenient reading: the last word is the first of its line */
    size_t before;              /* number of facets before this text, for messages */
    size_t facets;              /* read here */
    size_t vertices;            /* read here: three per facet if notes is NULL */
    zr_vec4 *positions;         /* of the vertices read here */
    const double *origin;       /* subtracted from positions; NULL: none */
    bool is_far;                /* a coordinate is beyond the limit (recenter.h) */
    bool finds_box;             /* bounds are computed, too */
    struct zr_box box;          /* if finds_box: bounds of the vertices read here */
    size_t vertices_before;     /* before this text */
    size_t facets_most;         /* upper bound of the facets before and here */
    uint32_t *offsets;          /* vertices before each facet of the file; NULL: all facets are triangles */
    size_t faults;              /* stops at this number of faults */
    struct zr_stl_notes *notes; /* NULL: every oddity is a fault */
    struct zr_error *error;
};

struct zr_stl_word {
    const char *at;
    size_t size;
};

static inline bool zr_stl_is_space(char byte)
{
    return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

static inline void zr_stl_skip_spaces(struct zr_stl_reader *reader)
{
    for (; reader->at < reader->end && zr_stl_is_space(*reader->at); reader->at++)
        reader->line += *reader->at == reader->line_end;
}

/* Returns the next white space, or `end`. A loop over bytes would take a third of the reading time. */
static inline const char *zr_stl_find_space(const char *at, const char *end)
{
    while (end - at >= ZR_CHUNK) {
        const size_t place = zr_chunk_first(zr_chunk_spaces(zr_chunk_load(at)));
        at += place;
        if (place < ZR_CHUNK) return at;
    }
    while (at < end && !zr_stl_is_space(*at))
        at++;
    return at;
}

/* Returns an empty word at the end of the text. */
static inline struct zr_stl_word zr_stl_next(struct zr_stl_reader *reader)
{
    zr_stl_skip_spaces(reader);
    struct zr_stl_word word = {reader->at, 0};
    reader->at = zr_stl_find_space(reader->at, reader->end);
    word.size = (size_t)(reader->at - word.at);
    return word;
}

static inline char zr_stl_lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static inline bool zr_stl_is_word(struct zr_stl_word word, const char *wanted)
{
    if (word.size != strlen(wanted)) return false;
    if (memcmp(word.at, wanted, word.size) == 0) return true;
    for (size_t i = 0; i < word.size; i++)
        if (zr_stl_lower(word.at[i]) != wanted[i]) return false;
    return true;
}

/* Moves to the end of the line. */
static inline void zr_stl_skip_line(struct zr_stl_reader *reader)
{
    const char *line_end = memchr(reader->at, reader->line_end, (size_t)(reader->end - reader->at));
    reader->at = line_end ? line_end : reader->end;
}

static inline bool zr_stl_begins_comment(struct zr_stl_word word)
{
    return memchr("#;!%", *word.at, 4) || (word.size >= 2 && memcmp(word.at, "//", 2) == 0);
}

/* stl_facets.c: reports that `expected`, in `quotes`, was not found. Returns false. */
bool zr_stl_fault(struct zr_stl_reader *reader, struct zr_stl_word found, const char *quotes, const char *expected);

/* stl_facets.c: reads the numbers of a vertex. False at a syntax error.
 * Reports coordinates out of range and returns true. With notes, words such as "nan" are numbers; x of such a vertex is
 * NaN. */
bool zr_stl_read_vertex(struct zr_stl_reader *reader, zr_vec4 *out);

/* stl_facets.c: reads a facet of three corners after "facet", by the syntax of the source, and counts it. */
bool zr_stl_read_facet(struct zr_stl_reader *reader);

/* stl_facets.c: reads all solids by the syntax of the source. Stops at a fault, a cancellation or the end. */
void zr_stl_read_solids(struct zr_stl_reader *reader);

/* stl_lenient.c: reads all solids, also with syntax beyond the source that many programs accept.
 * Counts each kind for a warning. */
void zr_stl_read_leniently(struct zr_stl_reader *reader);

/* ---- stl_color.c: colours of facets in binary STL, in the two bytes of attributes after each triangle ----
 *
 * VisCAM and SolidView: bit 15 is set if the facet has a colour, with red in bits 10 to 14, blue in bits 0 to 4.
 * Magics:  the header has "COLOR=" and four bytes, the colour of the part. Bit 15 is clear if the facet has its own
 *          colour, with red in bits 0 to 4, blue in bits 10 to 14.
 * MeshLab: as Magics, but with bit 15 set on each facet, although the colours differ.
 * Others:  many programs leave arbitrary bytes there. */

/* Bits of a set of attributes. For the empty set, `all` is UINT16_MAX and the others are 0. */
struct zr_stl_attributes {
    uint16_t any, all; /* set in any, in all of them */
    uint16_t unmarked; /* set in any of those without bit 15 */
    uint16_t colored;  /* clear in any of those with bit 15 */
};

static inline void zr_stl_attributes_add(struct zr_stl_attributes *bits, uint16_t attribute)
{
    const uint16_t marked = (uint16_t) - (attribute >> 15);
    bits->any |= attribute;
    bits->all &= attribute;
    bits->unmarked |= attribute & (uint16_t)~marked;
    bits->colored |= (uint16_t)~attribute & marked;
}

enum zr_stl_dialect {
    ZR_STL_PLAIN,  /* no colours */
    ZR_STL_PART,   /* one colour for all facets */
    ZR_STL_VISCAM, /* this and the next ones: a colour per facet */
    ZR_STL_MAGICS,
    ZR_STL_MESHLAB
};

/* Colours of a file. */
struct zr_stl_colors {
    enum zr_stl_dialect dialect;
    zr_vec4 part; /* colour of facets without their own */
};

/* `header`: 80 bytes. */
struct zr_stl_colors zr_stl_colors_of(const char *header, const struct zr_stl_attributes *bits);

zr_vec4 zr_stl_facet_color(const struct zr_stl_colors *colors, uint16_t attribute);

#endif
