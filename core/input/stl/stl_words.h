/* stl_words.h - input: splits the text of ASCII STL into words.
 *
 * Speed: inlined, since it takes most of the reading time. */
#ifndef ZR_STL_WORDS_H
#define ZR_STL_WORDS_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "core.h"
#include "input/stl/stl_notes.h"
#include "input/text/chunk.h"
#include "input/text/recenter.h"
#include "scene/scene.h"

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
 * Reports coordinates out of range and returns true. */
bool zr_stl_read_vertex(struct zr_stl_reader *reader, zr_vec4 *out);

/* stl_facets.c: reads a facet of three corners after "facet", by the syntax of the source, and counts it. */
bool zr_stl_read_facet(struct zr_stl_reader *reader);

/* stl_facets.c: reads all solids by the syntax of the source. Stops at a fault, a cancellation or the end. */
void zr_stl_read_solids(struct zr_stl_reader *reader);

/* stl_lenient.c: reads all solids, also with syntax beyond the source that many programs accept.
 * Counts each kind for a warning. */
void zr_stl_read_leniently(struct zr_stl_reader *reader);

#endif
