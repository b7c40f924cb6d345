/* obj_text.h - input: splits the text of Wavefront OBJ into statements and words.
 *
 * Source: Wavefront Advanced Visualizer manual, appendix B1.
 * Speed:  the functions that every statement uses are inlined, so that the position stays in a register: saves a
 *         quarter of the time.
 */
#ifndef ZR_OBJ_TEXT_H
#define ZR_OBJ_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "base/inlined.h"

/* Counts carriage returns that end a line alone.
 * Neither a line feed nor `end`, the end of the file, follows their run. */
size_t zr_obj_count_returns(const char *at, const char *behind, const char *end);

/* Replaces carriage returns that end a line alone by line feeds. */
void zr_obj_replace_returns(char *at, const char *end);

/* The rest of the text: whole statements. */
struct zr_obj_text {
    const char *at, *end;
    size_t line; /* line number of `at` */
};

/* One statement: a line, continued by lines after a backslash. */
struct zr_obj_statement {
    const char *at, *end;
    size_t line;
};

enum zr_obj_keyword {
    ZR_OBJ_V,
    ZR_OBJ_VN,
    ZR_OBJ_VT,
    ZR_OBJ_F,
    ZR_OBJ_LINE,    /* l */
    ZR_OBJ_POINT,   /* p */
    ZR_OBJ_SMOOTH,  /* s */
    ZR_OBJ_LIBRARY, /* mtllib; here and below up to ZR_OBJ_CALL, the rest of the line is a name */
    ZR_OBJ_USE,     /* usemtl */
    ZR_OBJ_OBJECT,  /* o */
    ZR_OBJ_GROUP,   /* g */
    ZR_OBJ_MAPS,    /* maps without a material: maplib, usemap */
    ZR_OBJ_NAME,    /* without effect on the picture */
    ZR_OBJ_CALL,    /* includes another file */
    ZR_OBJ_CURVED,  /* curves, surfaces and their vertices */
    ZR_OBJ_IGNORED, /* without effect on the picture: parameters of curves, levels of detail */
    ZR_OBJ_UNKNOWN
};

/* Returns the word up to the next blank and moves past it. */
struct zr_obj_statement zr_obj_word(struct zr_obj_statement *statement);

/* True if the statement that begins at `at` ends with its line, even after a backslash: its last word is a name, or
 * its keyword is unknown. */
bool zr_obj_ends_with_line(const char *at, const char *line_end);

/* Counts the words left. Bytes up to `end` may be read. */
size_t zr_obj_count_words(struct zr_obj_statement *statement, const char *end);

enum { ZR_OBJ_CORNERS_LEAST = 3 }; /* corners per face */

/* True if the rest of a face has too few corners. Bytes up to `end` may be read. */
bool zr_obj_is_short_face(struct zr_obj_statement face, const char *end);

/* True if the statement begins with "nan", "inf" or another word of zr_is_not_finite. */
bool zr_obj_at_not_finite(struct zr_obj_statement statement);

/* True if the rest of a vertex is three words and a colour with "nan" or "inf". Bytes up to `end` may be read. */
bool zr_obj_is_bad_color(struct zr_obj_statement vertex, const char *end);

/* Returns the keyword of a word other than v and f. */
enum zr_obj_keyword zr_obj_rare_keyword(const struct zr_obj_statement *word);

/* For zr_parts_cut: returns the end of a statement at least `size` bytes after `at`, or `end`. There are more than
 * `size` bytes. */
const char *zr_obj_cut(const char *at, size_t size, const char *end);

ZR_INLINED bool zr_obj_is_blank(char byte)
{
    return byte == ' ' || byte == '\t' || byte == '\r' || byte == '\v' || byte == '\f';
}

/* Returns the length of a backslash and the line end after it, or 0. */
ZR_INLINED size_t zr_obj_continuation(const char *at, const char *end)
{
    if (*at != '\\' || end - at < 2) return 0;
    if (at[1] == '\n') return 2;
    return end - at >= 3 && at[1] == '\r' && at[2] == '\n' ? 3 : 0;
}

ZR_INLINED void zr_obj_skip_blanks(struct zr_obj_statement *statement)
{
    const char *at = statement->at, *end = statement->end;
    for (size_t length; at < end; at += length) {
        length = zr_obj_is_blank(*at) ? 1 : zr_obj_continuation(at, end);
        if (length == 0) break;
    }
    statement->at = at;
}

/* True at the end or a comment; `statement` is after blanks. */
ZR_INLINED bool zr_obj_at_end(const struct zr_obj_statement *statement)
{
    return statement->at == statement->end || *statement->at == '#';
}

ZR_INLINED bool zr_obj_ends_word(const struct zr_obj_statement *statement, const char *at)
{
    return at == statement->end || zr_obj_is_blank(*at) || zr_obj_continuation(at, statement->end) > 0;
}

/* True if a backslash precedes the line end. */
ZR_INLINED bool zr_obj_hides_line_end(const char *from, const char *line_end)
{
    if (line_end > from && line_end[-1] == '\r') line_end--;
    return line_end > from && line_end[-1] == '\\';
}

/* True if the line that begins at `at` has a comment. A '#' within a word starts none. */
bool zr_obj_has_comment(const char *at, const char *line_end);

/* Reads the next statement, without leading blanks; false at the end of the text. Comments and names end with their
 * line even after a backslash: a path that ends in one must not hide a vertex. */
ZR_INLINED bool zr_obj_next(struct zr_obj_text *text, struct zr_obj_statement *statement)
{
    if (text->at == text->end) return false;
    while (*text->at == '\n' && text->at + 1 < text->end) { /* empty lines */
        text->at++;
        text->line++;
    }
    *statement = (struct zr_obj_statement){text->at, text->end, text->line};
    const char *at, *line_end;
    do {
        at = text->at;
        line_end = memchr(at, '\n', (size_t)(text->end - at));
        statement->end = line_end ? line_end : text->end;
        text->at = line_end ? line_end + 1 : text->end;
        text->line++;
    } while (line_end && zr_obj_hides_line_end(at, line_end) && !zr_obj_has_comment(at, line_end) &&
             !zr_obj_ends_with_line(statement->at, line_end));
    zr_obj_skip_blanks(statement);
    return true;
}

/* Moves past the keyword. Sets *word unless it is v or f. */
ZR_INLINED enum zr_obj_keyword zr_obj_next_keyword(struct zr_obj_statement *statement, struct zr_obj_statement *word)
{
    const char *at = statement->at;
    if ((*at == 'v' || *at == 'f') && zr_obj_ends_word(statement, at + 1)) { /* nearly all statements */
        statement->at++;
        return *at == 'v' ? ZR_OBJ_V : ZR_OBJ_F;
    }
    *word = zr_obj_word(statement);
    return zr_obj_rare_keyword(word);
}

#endif
