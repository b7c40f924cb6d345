/* Wavefront OBJ, as its specification (Wavefront Advanced Visualizer manual,
 * appendix B1) has it for polygons; curves, surfaces and grouping are passed over.
 * Two passes: the first counts, so that arrays have their size and an index
 * can be judged where it stands, also where its vertex comes later. */
#include "input/input.h"

#include <stdlib.h>
#include <string.h>

#include "base/checked.h"
#include "base/inlined.h"
#include "input/chunk.h"
#include "input/number_quick.h"
#include "input/text.h"

enum { COUNT_MAX = 1 << 30, VERTEX_NUMBERS_MAX = 6 };

/* In each place of a chunk a byte counts the words that begin there: of more chunks it could overflow. */
enum { CHUNKS_TO_COUNT = 255 };

/* Stands in for an index until the zero normal has its place. */
#define CORNER_WITHOUT_NORMAL UINT32_MAX

enum keyword { KEYWORD_V, KEYWORD_VN, KEYWORD_VT, KEYWORD_F, KEYWORD_IGNORED, KEYWORD_UNKNOWN };

/* One statement: a line, with those that a backslash joins to it. */
struct statement {
    const char *at, *end;
    size_t line;
};

struct counts {
    size_t positions, normals, faces, corners;
};

struct reader {
    struct zr_arena *arena;
    const struct zr_limits *limits;
    struct zr_error *error;
    const char *end;
    const char *next; /* the line after the statement */
    size_t next_line;
    struct counts total; /* from the first pass */
    struct counts count; /* so far */
    zr_vec4 *positions, *colors;
    zr_vec3 *normals;
    uint32_t *face_offsets, *indices, *normal_indices;
    bool normal_missing;
    bool bad_syntax; /* what follows would only be noise */
};

/* What all statements go through is inlined, so that the place in the text stays in a register: a quarter of the time.
 */

ZR_INLINED bool is_blank(char byte)
{
    return byte == ' ' || byte == '\t' || byte == '\r' || byte == '\v' || byte == '\f';
}

/* The length of a backslash and the line end that it hides, or 0. */
ZR_INLINED size_t continuation(const char *at, const char *end)
{
    if (*at != '\\' || end - at < 2) return 0;
    if (at[1] == '\n') return 2;
    return end - at >= 3 && at[1] == '\r' && at[2] == '\n' ? 3 : 0;
}

ZR_INLINED void skip_blanks(struct statement *statement)
{
    const char *at = statement->at, *end = statement->end;
    for (size_t length; at < end; at += length) {
        length = is_blank(*at) ? 1 : continuation(at, end);
        if (length == 0) break;
    }
    statement->at = at;
}

/* Behind blanks: nothing more but perhaps a comment? */
ZR_INLINED bool at_end(const struct statement *statement)
{
    return statement->at == statement->end || *statement->at == '#';
}

ZR_INLINED bool ends_token(const struct statement *statement, const char *at)
{
    return at == statement->end || is_blank(*at) || continuation(at, statement->end) > 0;
}

/* A token, to be shown or compared; moves behind it. */
static struct statement next_token(struct statement *statement)
{
    struct statement token = *statement;
    while (!ends_token(statement, statement->at))
        statement->at++;
    token.end = statement->at;
    return token;
}

ZR_INLINED bool hides_line_end(const char *from, const char *line_end)
{
    if (line_end > from && line_end[-1] == '\r') line_end--;
    return line_end > from && line_end[-1] == '\\';
}

/* False at the end of the file. Comments end with their line, backslash or not:
 * a path at the end of a comment must not swallow a vertex. */
ZR_INLINED bool next_statement(struct reader *reader, struct statement *statement)
{
    if (reader->next == reader->end) return false;
    *statement = (struct statement){reader->next, reader->next, reader->next_line};
    const char *at = reader->next;
    while (at < reader->end && is_blank(*at))
        at++;
    bool comment = at < reader->end && *at == '#';
    for (;;) {
        const char *line_end = memchr(at, '\n', (size_t)(reader->end - at));
        reader->next_line++;
        if (!line_end) {
            statement->end = reader->next = reader->end;
            break;
        }
        statement->end = line_end;
        reader->next = line_end + 1;
        if (comment || !hides_line_end(at, line_end)) break;
        at = line_end + 1;
    }
    skip_blanks(statement);
    return true;
}

static int compare_words(const void *key, const void *word)
{
    const struct statement *token = key;
    const char *text = *(const char *const *)word;
    size_t length = (size_t)(token->end - token->at);
    int order = strncmp(token->at, text, length);
    return order != 0 ? order : text[length] == '\0' ? 0 : -1;
}

static bool is_ignored(const struct statement *token)
{
    static const char *const words[] = {
        "bevel",      "bmat",   "bsp",   "bzp",    "c_interp", "call",      "cdc",  "cdp",    "con",    "csh",
        "cstype",     "ctech",  "curv",  "curv2",  "d_interp", "deg",       "end",  "g",      "hole",   "l",
        "lod",        "maplib", "mg",    "mtllib", "o",        "p",         "parm", "res",    "s",      "scrv",
        "shadow_obj", "sp",     "stech", "step",   "surf",     "trace_obj", "trim", "usemap", "usemtl", "vp"};
    if (memchr(token->at, '\0', (size_t)(token->end - token->at))) return false;
    return bsearch(token, words, sizeof words / sizeof words[0], sizeof words[0], compare_words) != NULL;
}

ZR_INLINED enum keyword read_keyword(struct statement *statement, struct statement *token)
{
    const char *at = statement->at;
    if ((*at == 'v' || *at == 'f') && ends_token(statement, at + 1)) { /* nearly all */
        statement->at++;
        return *at == 'v' ? KEYWORD_V : KEYWORD_F;
    }
    *token = next_token(statement);
    size_t length = (size_t)(token->end - token->at);
    if (length == 2 && token->at[0] == 'v' && token->at[1] == 'n') return KEYWORD_VN;
    if (length == 2 && token->at[0] == 'v' && token->at[1] == 't') return KEYWORD_VT;
    return is_ignored(token) ? KEYWORD_IGNORED : KEYWORD_UNKNOWN;
}

static size_t count_tokens(struct statement *statement)
{
    size_t count = 0;
    for (skip_blanks(statement); !at_end(statement); skip_blanks(statement), count++)
        next_token(statement);
    return count;
}

/* The same, many bytes at once: of comments, joined lines, very long ones and the file's last, which ends at `end`,
 * count_tokens says it. Room is made for as many corners as are counted here, and read_face, which goes from token to
 * token, fills it. `statement` is behind the keyword. A fifth of the time of reading. */
static size_t count_tokens_quickly(struct statement *statement, const char *end)
{
    zr_chunk begins = {0}, odd = {0};
    for (const char *at = statement->at; at < statement->end; at += ZR_CHUNK) {
        const size_t left = (size_t)(statement->end - at);
        if (end - at < ZR_CHUNK || at - statement->at >= CHUNKS_TO_COUNT * ZR_CHUNK) return count_tokens(statement);
        const zr_chunk bytes = zr_chunk_load(at), within = zr_chunk_of_first(left < ZR_CHUNK ? left : ZR_CHUNK);
        begins -= within & zr_chunk_spaces(zr_chunk_load(at - 1)) & ~zr_chunk_spaces(bytes);
        odd |= within & ((zr_chunk)(bytes == '#') | (zr_chunk)(bytes == '\\'));
    }
    return zr_chunk_first(odd) == ZR_CHUNK ? zr_chunk_sum(begins) : count_tokens(statement);
}

static void rewind_to(struct reader *reader, const char *bytes)
{
    reader->next = bytes;
    reader->next_line = 1;
}

static void count_statements(struct reader *reader)
{
    struct statement statement, token;
    while (next_statement(reader, &statement)) {
        if (at_end(&statement)) continue;
        enum keyword keyword = read_keyword(&statement, &token);
        reader->total.positions += keyword == KEYWORD_V;
        reader->total.normals += keyword == KEYWORD_VN;
        if (keyword != KEYWORD_F) continue;
        reader->total.faces++;
        reader->total.corners += count_tokens_quickly(&statement, reader->end);
    }
}

static bool syntax_fault(struct reader *reader, const struct statement *statement, const struct statement *token,
                         const char *expected)
{
    reader->bad_syntax = true;
    bool nothing = token->at == token->end || *token->at == '#';
    zr_error_add(reader->error, ZR_BAD_SYNTAX, NULL, "line %zu: expected %s, found %s", statement->line, expected,
                 nothing ? "the end of the line" : zr_quote(token->at, (size_t)(token->end - token->at)).text);
    return false;
}

/* The token that begins here is at fault. */
static bool token_fault(struct reader *reader, const struct statement *statement, const char *expected)
{
    struct statement shown = *statement, token = next_token(&shown);
    return syntax_fault(reader, statement, &token, expected);
}

/* Numbers up to the end of the statement; false after reporting one that is none
 * or too large, or more than `most`. */
static bool read_numbers(struct reader *reader, struct statement *statement, int most, float *out, int *count)
{
    double limit = (double)reader->limits->coordinate_max;
    *count = 0;
    for (skip_blanks(statement); !at_end(statement); skip_blanks(statement)) {
        double value;
        const char *at = statement->at, *behind = zr_number_next(at, reader->end, &value);
        if (*count == most) return token_fault(reader, statement, "the end of the line");
        if (!behind || !ends_token(statement, behind)) return token_fault(reader, statement, "a number");
        if (!(value >= -limit && value <= limit)) {
            zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: %s is beyond the limit of %.9g", statement->line,
                         zr_quote(at, (size_t)(behind - at)).text, limit);
            return false;
        }
        out[(*count)++] = (float)value;
        statement->at = behind;
    }
    return true;
}

static bool count_fault(struct reader *reader, const struct statement *statement, const char *expected, int count)
{
    reader->bad_syntax = true;
    zr_error_add(reader->error, ZR_BAD_SYNTAX, NULL, "line %zu: expected %s, found %d", statement->line, expected,
                 count);
    return false;
}

static bool set_color(struct reader *reader, const struct statement *statement, const float *rgb)
{
    if (!reader->colors) {
        reader->colors = zr_arena_alloc(reader->arena, reader->total.positions, sizeof *reader->colors);
        if (!reader->colors) return false;
        for (size_t i = 0; i < reader->total.positions; i++)
            reader->colors[i] = (zr_vec4){1, 1, 1, 1};
    }
    for (int i = 0; i < 3; i++)
        if (!(rgb[i] >= 0.0f && rgb[i] <= 1.0f)) {
            zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: a colour component of %.9g is outside of 0 to 1",
                         statement->line, (double)rgb[i]);
            return false;
        }
    reader->colors[reader->count.positions] = (zr_vec4){rgb[0], rgb[1], rgb[2], 1};
    return true;
}

/* v x y z, v x y z w (a weight for curves), v x y z r g b (as Meshlab writes). */
static bool read_vertex(struct reader *reader, struct statement *statement)
{
    float v[VERTEX_NUMBERS_MAX];
    int count;
    if (!read_numbers(reader, statement, VERTEX_NUMBERS_MAX, v, &count)) return false;
    if (count != 3 && count != 4 && count != 6)
        return count_fault(reader, statement, "3, 4 or 6 numbers behind v", count);
    reader->positions[reader->count.positions] = (zr_vec4){v[0], v[1], v[2], 1};
    return count != 6 || set_color(reader, statement, v + 3);
}

static bool read_normal(struct reader *reader, struct statement *statement)
{
    float v[3];
    int count;
    if (!read_numbers(reader, statement, 3, v, &count)) return false;
    if (count != 3) return count_fault(reader, statement, "3 numbers behind vn", count);
    reader->normals[reader->count.normals] = (zr_vec3){v[0], v[1], v[2]};
    return true;
}

static bool read_texcoord(struct reader *reader, struct statement *statement)
{
    float v[3];
    int count;
    if (!read_numbers(reader, statement, 3, v, &count)) return false;
    return count > 0 || count_fault(reader, statement, "1 to 3 numbers behind vt", count);
}

/* A whole number with perhaps a sign; saturates, far above any count. */
ZR_INLINED const char *read_integer(const char *at, const char *end, int64_t *value)
{
    bool negative = at < end && *at == '-';
    if (at < end && (*at == '-' || *at == '+')) at++;
    const uint64_t word = zr_eight_bytes(at, end);
    const unsigned count = zr_count_digits(word);
    if (count == 0) return NULL;
    int64_t magnitude = zr_digits_value(word, count);
    at += count;
    for (; count == 8 && at < end && (unsigned char)(*at - '0') < 10; at++)
        if (magnitude < INT64_C(1) << 40) magnitude = magnitude * 10 + (*at - '0');
    *value = negative ? -magnitude : magnitude;
    return at;
}

/* From 1, or backwards from the last one so far (-1) -> from 0. */
ZR_INLINED bool resolve_index(struct reader *reader, const struct statement *statement, int64_t index, const char *of,
                              size_t so_far, size_t total, uint32_t *out)
{
    int64_t resolved = index > 0 ? index - 1 : (int64_t)so_far + index;
    if (index != 0 && resolved >= 0 && resolved < (int64_t)total) {
        *out = (uint32_t)resolved;
        return true;
    }
    if (index < 0)
        zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: relative index %lld, but %zu %s so far",
                     statement->line, (long long)index, so_far, of);
    else
        zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: index %lld of %zu %s; they count from 1",
                     statement->line, (long long)index, total, of);
    return false;
}

static bool set_normal_index(struct reader *reader, size_t corner, uint32_t index)
{
    if (!reader->normal_indices) {
        reader->normal_indices = zr_arena_alloc(reader->arena, reader->total.corners, sizeof *reader->normal_indices);
        if (!reader->normal_indices) return false;
        for (size_t i = 0; i < reader->total.corners; i++)
            reader->normal_indices[i] = CORNER_WITHOUT_NORMAL;
    }
    reader->normal_indices[corner] = index;
    return true;
}

/* v, v/vt, v//vn or v/vt/vn. */
static bool read_corner(struct reader *reader, struct statement *statement, size_t corner)
{
    int64_t position, texcoord, normal = 0;
    const char *end = statement->end, *at = read_integer(statement->at, end, &position);
    bool has_normal = false;
    if (at && at < end && *at == '/') {
        at++;
        if (at == end || *at != '/') at = read_integer(at, end, &texcoord);
        has_normal = at && at < end && *at == '/';
        if (has_normal) at = read_integer(at + 1, end, &normal);
    }
    if (!at || !ends_token(statement, at)) return token_fault(reader, statement, "a corner: v, v/vt, v//vn or v/vt/vn");
    statement->at = at;
    uint32_t normal_index;
    if (!resolve_index(reader, statement, position, "vertices", reader->count.positions, reader->total.positions,
                       &reader->indices[corner]))
        return false;
    if (!has_normal) {
        reader->normal_missing = true;
        return true;
    }
    return resolve_index(reader, statement, normal, "normals", reader->count.normals, reader->total.normals,
                         &normal_index) &&
           set_normal_index(reader, corner, normal_index);
}

static bool read_face(struct reader *reader, struct statement *statement)
{
    size_t first = reader->count.corners, corner = first;
    reader->face_offsets[reader->count.faces] = (uint32_t)first;
    for (skip_blanks(statement); !at_end(statement); skip_blanks(statement))
        if (!read_corner(reader, statement, corner++)) return false;
    reader->count.corners = corner;
    size_t corners = corner - first;
    if (corners >= 3 && corners <= reader->limits->polygon_vertices_max) return true;
    zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: a face of %zu corners; 3 to %u are allowed",
                 statement->line, corners, reader->limits->polygon_vertices_max);
    return false;
}

static void read_statement(struct reader *reader, struct statement *statement)
{
    struct statement token;
    switch (read_keyword(statement, &token)) {
    case KEYWORD_V:
        read_vertex(reader, statement);
        reader->count.positions++;
        break;
    case KEYWORD_VN:
        read_normal(reader, statement);
        reader->count.normals++;
        break;
    case KEYWORD_VT:
        read_texcoord(reader, statement);
        break;
    case KEYWORD_F:
        read_face(reader, statement);
        reader->count.faces++;
        break;
    case KEYWORD_IGNORED:
        break;
    case KEYWORD_UNKNOWN:
        syntax_fault(reader, statement, &token, "a statement of OBJ");
        break;
    }
}

static bool allocate(struct reader *reader)
{
    const struct counts *total = &reader->total;
    reader->positions = zr_arena_alloc(reader->arena, total->positions, sizeof *reader->positions);
    reader->normals = zr_arena_alloc(reader->arena, total->normals + 1, sizeof *reader->normals);
    reader->face_offsets = zr_arena_alloc(reader->arena, total->faces + 1, sizeof *reader->face_offsets);
    reader->indices = zr_arena_alloc(reader->arena, total->corners, sizeof *reader->indices);
    return zr_arena_ok(reader->arena);
}

/* Corners without a normal share a zero one, which is computed later. */
static uint32_t finish_normals(struct reader *reader)
{
    if (!reader->normal_indices) return 0;
    uint32_t count = (uint32_t)reader->total.normals;
    if (!reader->normal_missing) return count;
    reader->normals[count] = (zr_vec3){0, 0, 0};
    for (size_t i = 0; i < reader->total.corners; i++)
        if (reader->normal_indices[i] == CORNER_WITHOUT_NORMAL) reader->normal_indices[i] = count;
    return count + 1;
}

enum zr_status zr_obj_read(struct zr_arena *arena, const char *bytes, size_t size, const struct zr_limits *limits,
                           struct zr_mesh *mesh, struct zr_error *error)
{
    struct reader reader = {.arena = arena, .limits = limits, .error = error, .end = bytes + size};
    rewind_to(&reader, bytes);
    count_statements(&reader);
    const struct counts *total = &reader.total;
    if (total->positions > COUNT_MAX || total->normals > COUNT_MAX || total->corners > COUNT_MAX)
        return zr_error_add(error, ZR_BAD_SCENE, NULL, "more than %d vertices, normals or corners", COUNT_MAX);
    if (!allocate(&reader)) return ZR_NO_MEMORY;

    struct statement statement;
    rewind_to(&reader, bytes);
    while (!reader.bad_syntax && zr_arena_ok(arena) && error->count < ZR_ERROR_ITEMS &&
           next_statement(&reader, &statement))
        if (!at_end(&statement)) read_statement(&reader, &statement);
    if (error->count > 0) return error->status;
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    if (total->faces == 0) return zr_error_add(error, ZR_BAD_SCENE, NULL, "no geometry: the OBJ file has no face (f)");
    reader.face_offsets[total->faces] = (uint32_t)total->corners;
    uint32_t normal_count = finish_normals(&reader);
    *mesh = (struct zr_mesh){.name = "",
                             .position_count = (uint32_t)total->positions,
                             .positions = reader.positions,
                             .face_count = (uint32_t)total->faces,
                             .face_offsets = reader.face_offsets,
                             .indices = reader.indices,
                             .normal_count = normal_count,
                             .normals = normal_count ? reader.normals : NULL,
                             .normal_indices = reader.normal_indices,
                             .colors = reader.colors};
    return ZR_OK;
}
