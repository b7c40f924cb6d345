#include <math.h>

#include "input/stl/stl_file.h"
#include "input/text/text.h"

/* Keywords that are valid only within a facet. */
static const char *const within_facets[] = {"normal", "outer", "loop", "vertex", "endloop", "endfacet"};

/* Counts an oddity whose text begins at `at`; NULL: it has no text. */
static void note_at(struct zr_stl_reader *reader, enum zr_stl_oddity oddity, size_t line, const char *at)
{
    enum { QUOTED = sizeof(struct zr_quote) };
    struct zr_stl_note *of = &reader->notes->of[oddity];
    if (of->count++ > 0) return;
    of->line = line;
    of->at = at;
    while (at && at + of->size < reader->end && of->size < QUOTED && at[of->size] != '\n' && at[of->size] != '\r')
        of->size++;
}

static void note(struct zr_stl_reader *reader, enum zr_stl_oddity oddity, const char *at)
{
    note_at(reader, oddity, reader->line, at);
}

static void skip_noted(struct zr_stl_reader *reader, enum zr_stl_oddity oddity, struct zr_stl_word word)
{
    note(reader, oddity, word.at);
    zr_stl_skip_line(reader);
}

/* ---- words ---- */

static bool begins_color(struct zr_stl_word word)
{
    return zr_stl_is_word(word, "color") || zr_stl_is_word(word, "colour");
}

/* Returns the next word after any comment and colour lines; an empty word at the end of the text or if cancelled. */
static struct zr_stl_word next_word(struct zr_stl_reader *reader)
{
    for (;;) {
        const size_t line = reader->line;
        const bool is_first = reader->at == reader->begin;
        const struct zr_stl_word word = zr_stl_next(reader);
        reader->starts_line = is_first || reader->line != line;
        if (word.size == 0 || zr_is_cancelled(reader->cancel)) return (struct zr_stl_word){word.at, 0};
        if (!reader->starts_line) return word;
        if (zr_stl_begins_comment(word))
            skip_noted(reader, ZR_STL_COMMENT, word);
        else if (begins_color(word))
            skip_noted(reader, ZR_STL_COLOR, word);
        else
            return word;
    }
}

/* True if the word is `wanted`, such as "endloop", or the two words "end loop". */
static bool is_end(struct zr_stl_reader *reader, struct zr_stl_word word, const char *wanted)
{
    if (zr_stl_is_word(word, wanted)) return true;
    if (!zr_stl_is_word(word, "end")) return false;
    const struct zr_stl_reader before = *reader;
    if (zr_stl_is_word(zr_stl_next(reader), wanted + strlen("end")) && reader->line == before.line) {
        note(reader, ZR_STL_SPLIT_END, word.at);
        return true;
    }
    *reader = before;
    return false;
}

/* ---- facets ---- */

/* Reads from "facet" to the first vertex: the normal and "outer loop". */
static bool read_head(struct zr_stl_reader *reader)
{
    const size_t line = reader->line;
    struct zr_stl_word word = next_word(reader);
    const bool has_normal = zr_stl_is_word(word, "normal");
    int numbers = 0;
    if (has_normal) word = next_word(reader);
    for (; numbers < 3 && word.size > 0 && !zr_stl_is_word(word, "outer") && (has_normal || !reader->starts_line);
         numbers++)
        word = next_word(reader);
    if (!has_normal || numbers < 3) note_at(reader, ZR_STL_NO_NORMAL, line, NULL);
    if (word.size > 0 && !reader->starts_line && !zr_stl_is_word(word, "outer")) {
        skip_noted(reader, ZR_STL_WORDS, word);
        word = next_word(reader);
    }
    if (!zr_stl_is_word(word, "outer")) return zr_stl_fault(reader, word, "'", "outer");
    word = next_word(reader);
    return zr_stl_is_word(word, "loop") || zr_stl_fault(reader, word, "'", "loop");
}

/* Reads vertices up to the end of the loop. */
static bool read_loop(struct zr_stl_reader *reader, size_t *corners)
{
    for (*corners = 0;;) {
        const struct zr_stl_word word = next_word(reader);
        if (zr_stl_is_word(word, "vertex")) {
            if (!zr_stl_read_vertex(reader, &reader->positions[reader->vertices + *corners])) return false;
            ++*corners;
        } else if (*corners >= 3 && is_end(reader, word, "endloop")) {
            return true;
        } else if (word.size == 0 || reader->starts_line) {
            return zr_stl_fault(reader, word, "", *corners < 3 ? "'vertex'" : "'vertex' or 'endloop'");
        } else {
            skip_noted(reader, ZR_STL_WORDS, word);
        }
    }
}

static bool read_end(struct zr_stl_reader *reader)
{
    for (;;) {
        const struct zr_stl_word word = next_word(reader);
        if (is_end(reader, word, "endfacet")) return true;
        if (word.size == 0 || reader->starts_line) return zr_stl_fault(reader, word, "'", "endfacet");
        skip_noted(reader, ZR_STL_WORDS, word);
    }
}

/* Allocates the offsets of facets, and writes those of the facets so far: all are triangles. */
static bool begin_offsets(struct zr_stl_reader *reader)
{
    if (reader->offsets) return true;
    reader->offsets = zr_arena_alloc(reader->arena, reader->facets_most + 1, sizeof *reader->offsets);
    for (size_t i = 0; reader->offsets && i <= reader->before + reader->facets; i++)
        reader->offsets[i] = (uint32_t)(3 * i);
    return reader->offsets != NULL;
}

/* True if one of the corners that were read last is not finite. */
static bool has_hole(const struct zr_stl_reader *reader, size_t corners)
{
    for (size_t i = 0; i < corners; i++)
        if (isnan(reader->positions[reader->vertices + i].x)) return true;
    return false;
}

static bool count_facet(struct zr_stl_reader *reader, size_t corners, size_t line)
{
    if (corners > reader->limits->polygon_vertices_max)
        zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: a facet of %zu corners; 3 to %u are allowed", line,
                     corners, reader->limits->polygon_vertices_max);
    if (corners > 3) note_at(reader, ZR_STL_POLYGON, line, NULL);
    if (corners > 3 && !begin_offsets(reader)) return false;
    reader->vertices += corners;
    reader->facets++;
    if (reader->offsets)
        reader->offsets[reader->before + reader->facets] = (uint32_t)(reader->vertices_before + reader->vertices);
    return true;
}

/* Counts a facet that is finite. Any other one leaves no trace but a note. */
static bool take_facet(struct zr_stl_reader *reader, const struct zr_stl_reader *before, size_t corners)
{
    if (!has_hole(reader, corners)) return count_facet(reader, corners, before->line);
    note_at(reader, ZR_STL_HOLE, before->line, NULL);
    reader->is_far = before->is_far;
    reader->box = before->box;
    return true;
}

/* Reads a facet after "facet". Tries the syntax of the source first, whose normal may be any words, even keywords. */
static bool read_facet(struct zr_stl_reader *reader)
{
    const struct zr_stl_reader before = *reader;
    const size_t faults = reader->error->count;
    if (zr_stl_read_facet(reader)) {
        reader->vertices = before.vertices;
        reader->facets = before.facets;
        return take_facet(reader, &before, 3);
    }
    *reader = before;
    reader->error->count = faults;
    size_t corners;
    return read_head(reader) && read_loop(reader, &corners) && read_end(reader) && take_facet(reader, &before, corners);
}

/* ---- solids ---- */

static bool is_within_facets(struct zr_stl_word word)
{
    for (size_t i = 0; i < sizeof within_facets / sizeof *within_facets; i++)
        if (zr_stl_is_word(word, within_facets[i])) return true;
    return false;
}

/* Skips the rest of a line from an unknown word on. Reports keywords that are valid only within a facet. */
static bool skip_unknown(struct zr_stl_reader *reader, struct zr_stl_word word, const char *expected)
{
    if (word.size == 0 || (reader->starts_line && is_within_facets(word)))
        return zr_stl_fault(reader, word, "", expected);
    skip_noted(reader, reader->starts_line ? ZR_STL_UNKNOWN : ZR_STL_WORDS, word);
    return true;
}

/* True if the text has a facet or an unknown line: then a missing "endsolid" is no fault. */
static bool has_any(const struct zr_stl_reader *reader)
{
    return reader->before + reader->facets > 0 || reader->notes->of[ZR_STL_UNKNOWN].count > 0 ||
           reader->notes->of[ZR_STL_HOLE].count > 0;
}

/* Reads up to the end of a solid or the text. */
static bool read_facets(struct zr_stl_reader *reader)
{
    while (reader->error->count < reader->faults && !zr_is_cancelled(reader->cancel)) {
        const struct zr_stl_word word = next_word(reader);
        const bool is_end_of_text = word.size == 0 && has_any(reader), is_next = zr_stl_is_word(word, "solid");
        if (is_end_of_text || is_next) note(reader, ZR_STL_NO_END, NULL);
        if (is_end_of_text || is_end(reader, word, "endsolid")) return true;
        if (is_next)
            zr_stl_skip_line(reader);
        else if (zr_stl_is_word(word, "facet") ? !read_facet(reader)
                                               : !skip_unknown(reader, word, "'facet' or 'endsolid'"))
            return false;
    }
    return false;
}

/* Reads up to the first facet of the next solid. False at the end of the text and at a fault. */
static bool begin_solid(struct zr_stl_reader *reader)
{
    for (;;) {
        const struct zr_stl_word word = next_word(reader);
        if (word.size == 0) return false;
        if (zr_stl_is_word(word, "facet")) {
            note(reader, ZR_STL_NO_SOLID, NULL);
            reader->at = word.at;
            return true;
        }
        if (zr_stl_is_word(word, "solid")) {
            zr_stl_skip_line(reader);
            return true;
        }
        if (!skip_unknown(reader, word, "'solid'")) return false;
    }
}

/* Reports the first unknown line if the text has no facet: it is no STL. */
static void report_unknown(struct zr_stl_reader *reader)
{
    const struct zr_stl_note *first = &reader->notes->of[ZR_STL_UNKNOWN];
    if (first->count == 0 || reader->before + reader->facets > 0 || reader->error->count > 0) return;
    struct zr_stl_reader at_first = {.line = first->line, .error = reader->error};
    const struct zr_stl_word word = {first->at,
                                     (size_t)(zr_stl_find_space(first->at, first->at + first->size) - first->at)};
    zr_stl_fault(&at_first, word, "", "'solid', 'facet' or 'endsolid'");
}

void zr_stl_read_leniently(struct zr_stl_reader *reader)
{
    while (reader->inside || begin_solid(reader)) {
        reader->inside = false;
        if (!read_facets(reader)) break;
        zr_stl_skip_line(reader);
    }
    report_unknown(reader);
}
