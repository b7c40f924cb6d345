#include "input/stl_text.h"

#include <string.h>

#include "input/chunk.h"
#include "input/number.h"
#include "input/parts.h"
#include "input/text.h"

/* The shortest text of a triangle, which bounds the triangles of a file. */
#define TRIANGLE_TEXT "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 0 vertex 0 0 0 endloop endfacet"

/* Read in a fifth of a millisecond, about the time to wake a thread. */
#ifndef ZR_STL_PART_BYTES /* smaller in tests/unit/test_stl_parts.c */
#define ZR_STL_PART_BYTES (1 << 17)
#endif

/* A part of the text. All but the first begin behind a line that is only "endfacet": within a solid, between two
 * facets. If such a line belongs to a normal, the part before it has a fault, and one thread reads on from that
 * part. */
struct part {
    size_t first;     /* number of its first triangle */
    size_t room;      /* triangles that it has room for, at least as many as it has */
    size_t triangles; /* triangles read */
    size_t line_ends; /* line ends read */
};

/* Data of a file, shared by all threads. */
struct file {
    const struct zr_limits *limits;
    const struct zr_cancel *cancel;
    size_t part_count;
    const struct zr_part *texts;
    struct part *parts;
    zr_vec4 *positions;
};

/* State of one thread that reads a part, or the rest of the file. */
struct reader {
    const struct zr_limits *limits;
    const struct zr_cancel *cancel;
    const char *at, *end;
    size_t line;
    bool inside;   /* within a solid */
    bool goes_on;  /* text follows behind `end` */
    size_t before; /* triangles before this text, for messages */
    size_t triangles;
    zr_vec4 *positions; /* of the triangles read here */
    size_t faults;      /* stops at this number of faults */
    struct zr_error *error;
};

struct token {
    const char *at;
    size_t size;
};

/* ---- words ---- */

static inline bool is_space(char byte)
{
    return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

static inline void skip_spaces(struct reader *reader)
{
    for (; reader->at < reader->end && is_space(*reader->at); reader->at++)
        reader->line += *reader->at == '\n';
}

/* Returns the next white space, or `end`. Byte by byte, this took a third of the reading time. */
static inline const char *find_space(const char *at, const char *end)
{
    while (end - at >= ZR_CHUNK) {
        const size_t place = zr_chunk_first(zr_chunk_spaces(zr_chunk_load(at)));
        at += place;
        if (place < ZR_CHUNK) return at;
    }
    while (at < end && !is_space(*at))
        at++;
    return at;
}

/* Returns an empty token at the end of the text. */
static inline struct token next_token(struct reader *reader)
{
    skip_spaces(reader);
    struct token token = {reader->at, 0};
    reader->at = find_space(reader->at, reader->end);
    token.size = (size_t)(reader->at - token.at);
    return token;
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static inline bool is_word(struct token token, const char *word)
{
    if (token.size != strlen(word)) return false;
    if (memcmp(token.at, word, token.size) == 0) return true;
    for (size_t i = 0; i < token.size; i++)
        if (lower(token.at[i]) != word[i]) return false;
    return true;
}

static bool syntax_fault(struct reader *reader, struct token found, const char *quotes, const char *expected)
{
    zr_error_add(reader->error, ZR_BAD_SYNTAX, NULL, "line %zu: expected %s%s%s, found %s", reader->line, quotes,
                 expected, quotes, found.size ? zr_quote(found.at, found.size).text : "the end of the file");
    return false;
}

static inline bool expect_word(struct reader *reader, const char *word)
{
    struct token token = next_token(reader);
    return is_word(token, word) || syntax_fault(reader, token, "'", word);
}

static void skip_line(struct reader *reader)
{
    const char *line_end = memchr(reader->at, '\n', (size_t)(reader->end - reader->at));
    reader->at = line_end ? line_end : reader->end;
}

/* ---- facets ---- */

/* False for a syntax error only; a coordinate out of range is reported, and reading continues. */
static bool read_vertex(struct reader *reader, zr_vec4 *out)
{
    const double limit = (double)reader->limits->coordinate_max;
    float v[3] = {0, 0, 0};
    if (!expect_word(reader, "vertex")) return false;
    for (int axis = 0; axis < 3; axis++) {
        double value;
        skip_spaces(reader);
        const char *at = reader->at, *behind = zr_number_next(at, reader->end, &value);
        if (!behind || (behind < reader->end && !is_space(*behind)))
            return syntax_fault(reader, next_token(reader), "", "a number");
        reader->at = behind;
        if (value >= -limit && value <= limit)
            v[axis] = (float)value;
        else
            zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: %s in triangle %zu is beyond the limit of %.9g",
                         reader->line, zr_quote(at, (size_t)(behind - at)).text, reader->before + reader->triangles + 1,
                         limit);
    }
    *out = (zr_vec4){v[0], v[1], v[2], 1};
    return true;
}

/* Reads a facet behind "facet". Its normal may be any words: some exporters write "nan". */
static bool read_facet(struct reader *reader)
{
    if (!expect_word(reader, "normal")) return false;
    for (int axis = 0; axis < 3; axis++) {
        struct token token = next_token(reader);
        if (token.size == 0) return syntax_fault(reader, token, "", "a normal");
    }
    if (!expect_word(reader, "outer") || !expect_word(reader, "loop")) return false;
    zr_vec4 corners[3]; /* the array has room for whole facets only */
    for (size_t i = 0; i < 3; i++)
        if (!read_vertex(reader, &corners[i])) return false;
    if (!expect_word(reader, "endloop") || !expect_word(reader, "endfacet")) return false;
    memcpy(reader->positions + 3 * reader->triangles++, corners, sizeof corners);
    return true;
}

/* Reads facets up to the end of the solid. False if reading ends before: at a fault, a cancellation or the end of the
 * part. */
static bool read_facets(struct reader *reader)
{
    while (reader->error->count < reader->faults && !zr_is_cancelled(reader->cancel)) {
        struct token token = next_token(reader);
        if (is_word(token, "endsolid")) return true;
        if (token.size == 0 && reader->goes_on) return false;
        if (!is_word(token, "facet")) return syntax_fault(reader, token, "", "'facet' or 'endsolid'");
        if (!read_facet(reader)) return false;
    }
    return false;
}

/* Reads all solids. A name is free text up to the end of its line. */
static void read_solids(struct reader *reader)
{
    for (;;) {
        if (!reader->inside) {
            struct token token = next_token(reader);
            if (token.size == 0) return;
            if (!is_word(token, "solid")) {
                syntax_fault(reader, token, "'", "solid");
                return;
            }
            skip_line(reader);
            reader->inside = true;
        }
        if (!read_facets(reader)) return;
        skip_line(reader);
        reader->inside = false;
    }
}

/* ---- parts ---- */

/* Returns the next 'f' or 'F', or `end`. Numbers have none, so few other words are tested. */
static const char *find_f(const char *at, const char *end)
{
    for (; end - at >= ZR_CHUNK; at += ZR_CHUNK) {
        const size_t place = zr_chunk_first((zr_chunk)((zr_chunk_load(at) | ('a' - 'A')) == 'f'));
        if (place < ZR_CHUNK) return at + place;
    }
    while (at < end && lower(*at) != 'f')
        at++;
    return at;
}

static bool is_blank(char byte)
{
    return byte != '\n' && is_space(byte);
}

const char *zr_stl_cut(const char *at, size_t size, const char *end)
{
    static const char word[] = "endfacet";
    enum { SIZE = sizeof word - 1, F = 3 };
    for (const char *f = find_f(at + size, end); end - f > SIZE - F; f = find_f(f + 1, end)) {
        const char *begin = f - F, *behind = begin + SIZE;
        if (!is_word((struct token){begin, SIZE}, word)) continue;
        while (begin > at && is_blank(begin[-1]))
            begin--;
        while (behind < end && is_blank(*behind))
            behind++;
        if (behind < end && *behind == '\n' && begin > at && begin[-1] == '\n') return behind + 1;
    }
    return end;
}

/* Counts a letter in both cases. */
static size_t count_letter(const char *at, const char *end, char letter)
{
    size_t count = 0;
    while (end - at >= ZR_CHUNK) {
        zr_chunk sum = {0};
        for (int i = 0; i < UINT8_MAX && end - at >= ZR_CHUNK; i++, at += ZR_CHUNK)
            sum -= (zr_chunk)((zr_chunk_load(at) | ('a' - 'A')) == (uint8_t)letter);
        count += zr_chunk_sum(sum);
    }
    for (; at < end; at++)
        count += lower(*at) == letter;
    return count;
}

/* Bounds the triangles of a part: by its letters x, three per facet in "vertex", and by its length. A name with an x
 * only raises the bound. A facet that began in the part before has its vertices in this one. */
static bool make_room(void *context, size_t index)
{
    const struct file *file = context;
    const struct zr_part *text = &file->texts[index];
    const size_t most = (size_t)(text->end - text->at) / (sizeof TRIANGLE_TEXT - 1) + 1;
    const size_t vertices = count_letter(text->at, text->end, 'x');
    file->parts[index].room = vertices / 3 < most ? vertices / 3 : most;
    return true;
}

static size_t add_up(struct file *file)
{
    size_t sum = 0;
    for (size_t i = 0; i < file->part_count; i++) {
        file->parts[i].first = sum;
        sum += file->parts[i].room;
    }
    return sum;
}

static struct reader reader_of(const struct file *file, size_t index, struct zr_error *error)
{
    return (struct reader){.limits = file->limits,
                           .cancel = file->cancel,
                           .at = file->texts[index].at,
                           .end = file->texts[index].end,
                           .line = 1,
                           .inside = index > 0,
                           .positions = file->positions + 3 * file->parts[index].first,
                           .error = error};
}

static bool read_part(void *context, size_t index)
{
    const struct file *file = context;
    struct zr_error error = {.count = 0};
    struct reader reader = reader_of(file, index, &error);
    reader.goes_on = index + 1 < file->part_count;
    reader.faults = 1;
    read_solids(&reader);
    file->parts[index].triangles = reader.triangles;
    file->parts[index].line_ends = reader.line - 1;
    return error.count == 0;
}

/* Closes the gaps that unused room left between parts; returns the number of triangles. */
static size_t close_gaps(struct file *file, size_t parts)
{
    size_t sum = 0;
    for (size_t i = 0; i < parts; i++) {
        const struct part *part = &file->parts[i];
        if (part->first != sum)
            memmove(file->positions + 3 * sum, file->positions + 3 * part->first,
                    3 * part->triangles * sizeof *file->positions);
        sum += part->triangles;
    }
    return sum;
}

/* Reads from the part `index`, which could not be read by itself, to the end or ZR_ERROR_ITEMS faults. Returns the
 * number of triangles. */
static size_t read_on(struct file *file, size_t index, struct zr_error *error)
{
    struct reader reader = reader_of(file, index, error);
    reader.end = file->texts[file->part_count - 1].end;
    for (size_t i = 0; i < index; i++)
        reader.line += file->parts[i].line_ends;
    reader.before = close_gaps(file, index);
    reader.positions = file->positions + 3 * reader.before;
    reader.faults = ZR_ERROR_ITEMS;
    read_solids(&reader);
    return reader.before + reader.triangles;
}

/* ---- the whole ---- */

bool zr_stl_is_text(const char *bytes, size_t size)
{
    struct reader reader = {.at = bytes, .end = bytes + size};
    return is_word(next_token(&reader), "solid");
}

enum zr_status zr_stl_text_read(struct zr_arena *arena, struct zr_team *team, const struct zr_request *request,
                                const struct zr_limits *limits, zr_vec4 **positions, size_t *triangles,
                                struct zr_error *error)
{
    struct file file = {.limits = limits, .cancel = request->cancel};
    file.texts = zr_parts_cut(arena, request->bytes, request->bytes + request->size, ZR_STL_PART_BYTES, zr_stl_cut,
                              &file.part_count);
    file.parts = zr_arena_zero(arena, file.part_count, sizeof *file.parts);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    if (zr_parts_read(team, file.cancel, 0, file.part_count, make_room, &file) < file.part_count) return ZR_CANCELLED;
    const size_t room = add_up(&file);
    if (room > ZR_STL_TRIANGLES_MAX)
        return zr_error_add(error, ZR_BAD_SCENE, NULL, "%zu triangles, more than the limit of %d", room,
                            ZR_STL_TRIANGLES_MAX);
    file.positions = zr_arena_alloc(arena, room, 3 * sizeof *file.positions);
    if (!file.positions) return ZR_NO_MEMORY;
    const size_t failed = zr_parts_read(team, file.cancel, 0, file.part_count, read_part, &file);
    *positions = file.positions;
    *triangles = failed < file.part_count ? read_on(&file, failed, error) : close_gaps(&file, failed);
    if (zr_is_cancelled(file.cancel)) return ZR_CANCELLED;
    return error->count > 0 ? error->status : ZR_OK;
}
