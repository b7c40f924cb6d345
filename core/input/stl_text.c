#include "input/stl_text.h"

#include <string.h>

#include "input/chunk.h"
#include "input/number_quick.h"
#include "input/parts.h"
#include "input/text.h"

/* The shortest text of one triangle bounds how many a file can hold. */
#define TRIANGLE_TEXT "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 0 vertex 0 0 0 endloop endfacet"

/* Read in a fifth of a millisecond, about as long as it takes to wake a thread. */
enum { PART_BYTES = 1 << 17 };

/* All but the last one end behind a line that is nothing but "endfacet", and all but the first one begin there: in a
 * solid, since a line with "solid" has more, between two facets. Where somebody has written "endfacet" for a normal,
 * the part that it ends is at fault, and who reads on from its beginning knows better. */
struct part {
    const char *at, *end;
    size_t first;     /* of its triangles, room for each */
    size_t triangles; /* that there is room for; once it is read, that there are */
};

/* What all threads share. */
struct file {
    const struct zr_limits *limits;
    size_t part_count;
    struct part *parts;
    zr_vec4 *positions;
};

/* One thread at its part, or at all that is left. */
struct reader {
    const struct zr_limits *limits;
    const char *at, *end;
    size_t line;
    bool inside;   /* of a solid */
    bool goes_on;  /* behind `end` */
    size_t before; /* triangles, of which messages know */
    size_t triangles;
    zr_vec4 *positions; /* of those */
    size_t faults;      /* at which it ends */
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

/* Or the end. Byte by byte, words take a third of the time of all. */
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

/* An empty token at the end of the text. */
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

/* False on bad syntax only: a place out of range is reported, and the rest read. */
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

/* Behind "facet". The normal may be anything: some exporters write "nan". */
static bool read_facet(struct reader *reader)
{
    if (!expect_word(reader, "normal")) return false;
    for (int axis = 0; axis < 3; axis++) {
        struct token token = next_token(reader);
        if (token.size == 0) return syntax_fault(reader, token, "", "a normal");
    }
    if (!expect_word(reader, "outer") || !expect_word(reader, "loop")) return false;
    zr_vec4 corners[3]; /* there is room for whole facets only */
    for (size_t i = 0; i < 3; i++)
        if (!read_vertex(reader, &corners[i])) return false;
    if (!expect_word(reader, "endloop") || !expect_word(reader, "endfacet")) return false;
    memcpy(reader->positions + 3 * reader->triangles++, corners, sizeof corners);
    return true;
}

/* Facets up to the end of their solid, or of a part. False where that is the end of all reading, for a fault or not. */
static bool read_facets(struct reader *reader)
{
    while (reader->error->count < reader->faults) {
        struct token token = next_token(reader);
        if (is_word(token, "endsolid")) return true;
        if (token.size == 0 && reader->goes_on) return false;
        if (!is_word(token, "facet")) return syntax_fault(reader, token, "", "'facet' or 'endsolid'");
        if (!read_facet(reader)) return false;
    }
    return false;
}

/* Solid after solid; names are free text up to the end of their line. */
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

/* Is there nothing but this word? */
static bool is_line_of(const char *at, const char *line_end, const char *word)
{
    struct reader line = {.at = at, .end = line_end};
    return is_word(next_token(&line), word) && next_token(&line).size == 0;
}

/* Behind whole facets of `size` bytes or a little more, or `end`. */
static const char *part_end(const char *at, size_t size, const char *end)
{
    if ((size_t)(end - at) <= size) return end;
    const char *line_end = memchr(at + size, '\n', (size_t)(end - at) - size);
    while (line_end) {
        const char *line = line_end + 1;
        line_end = memchr(line, '\n', (size_t)(end - line));
        if (line_end && is_line_of(line, line_end, "endfacet")) return line_end + 1;
    }
    return end;
}

static bool cut(struct file *file, struct zr_arena *arena, const char *bytes, size_t size)
{
    const char *end = bytes + size;
    file->parts = zr_arena_zero(arena, size / PART_BYTES + 1, sizeof *file->parts);
    if (!file->parts) return false;
    for (const char *at = bytes; at < end; file->part_count++) {
        struct part *part = &file->parts[file->part_count];
        part->at = at;
        part->end = at = part_end(at, PART_BYTES, end);
    }
    return true;
}

/* Of either case. */
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

/* For whole facets, of which each has the x of "vertex" three times, and no shorter text than there is. A name with an
 * x may make it too much. */
static bool make_room(void *context, size_t index)
{
    const struct file *file = context;
    struct part *part = &file->parts[index];
    const size_t most = (size_t)(part->end - part->at) / (sizeof TRIANGLE_TEXT - 1) + 1;
    const size_t vertices = count_letter(part->at, part->end, 'x');
    part->triangles = vertices / 3 < most ? vertices / 3 : most;
    return true;
}

static size_t add_up(struct file *file)
{
    size_t sum = 0;
    for (size_t i = 0; i < file->part_count; i++) {
        file->parts[i].first = sum;
        sum += file->parts[i].triangles;
    }
    return sum;
}

static struct reader reader_of(const struct file *file, size_t index, struct zr_error *error)
{
    const struct part *part = &file->parts[index];
    return (struct reader){.limits = file->limits,
                           .at = part->at,
                           .end = part->end,
                           .line = 1,
                           .inside = index > 0,
                           .positions = file->positions + 3 * part->first,
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
    if (error.count > 0 || reader.inside != reader.goes_on) return false;
    file->parts[index].triangles = reader.triangles;
    return true;
}

/* Moves what is behind room that was not needed; returns how many triangles there are. */
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

/* From a part on that could not be read by itself: to the end, or to as many faults as are told. Returns how many
 * triangles there are. */
static size_t read_on(struct file *file, size_t index, const struct zr_request *request, struct zr_error *error)
{
    const struct part *part = &file->parts[index];
    struct reader reader = reader_of(file, index, error);
    reader.end = request->bytes + request->size;
    reader.line = zr_place_of(request->bytes, (size_t)(part->at - request->bytes)).line;
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
    struct file file = {.limits = limits};
    if (!cut(&file, arena, request->bytes, request->size)) return ZR_NO_MEMORY;
    if (zr_parts_read(team, request->cancel, 0, file.part_count, make_room, &file) < file.part_count)
        return ZR_CANCELLED;
    const size_t room = add_up(&file) + file.part_count; /* for what lies across the end of a part, after all */
    if (room > ZR_STL_TRIANGLES_MAX)
        return zr_error_add(error, ZR_BAD_SCENE, NULL, "%zu triangles, more than the limit of %d", room,
                            ZR_STL_TRIANGLES_MAX);
    file.positions = zr_arena_alloc(arena, room, 3 * sizeof *file.positions);
    if (!file.positions) return ZR_NO_MEMORY;
    const size_t failed = zr_parts_read(team, request->cancel, 0, file.part_count, read_part, &file);
    if (zr_is_cancelled(request->cancel)) return ZR_CANCELLED;
    *positions = file.positions;
    *triangles = failed < file.part_count ? read_on(&file, failed, request, error) : close_gaps(&file, failed);
    return error->count > 0 ? error->status : ZR_OK;
}
