/* STL, binary and ASCII (3D Systems, StereoLithography Interface Specification,
 * 1989). Each triangle keeps three vertices of its own; the normals in the file
 * are passed over, since exporters often write zeros or worse there. */
#include "input/input.h"

#include <string.h>

#include "input/chunk.h"
#include "input/number_quick.h"
#include "input/text.h"

enum {
    HEADER_BYTES = 80,
    COUNT_END = HEADER_BYTES + 4,
    TRIANGLE_BYTES = 50, /* normal, three vertices, two bytes of attributes */
    VERTICES_AT = 12,    /* in a triangle, behind its normal */
    TRIANGLES_MAX = 1 << 29
};

/* The shortest text of one triangle bounds how many a file can hold. */
#define TRIANGLE_TEXT "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 0 vertex 0 0 0 endloop endfacet"

struct reader {
    struct zr_arena *arena;
    const struct zr_limits *limits;
    struct zr_error *error;
    size_t triangles;
    zr_vec4 *positions;
    /* ASCII only */
    const char *at, *end;
    size_t line;
};

struct token {
    const char *at;
    size_t size;
};

static uint32_t read_u32(const char *at)
{
    const unsigned char *b = (const unsigned char *)at;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static float read_f32(const char *at)
{
    uint32_t bits = read_u32(at);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Corner c of face f is position 3f + c. */
static enum zr_status make_mesh(struct reader *reader, struct zr_mesh *mesh)
{
    size_t corners = reader->triangles * 3;
    if (corners == 0)
        return zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "no geometry: the STL file has no triangle");
    uint32_t *face_offsets = zr_arena_alloc(reader->arena, reader->triangles + 1, sizeof *face_offsets);
    uint32_t *indices = zr_arena_alloc(reader->arena, corners, sizeof *indices);
    if (!zr_arena_ok(reader->arena)) return ZR_NO_MEMORY;
    for (size_t i = 0; i <= reader->triangles; i++)
        face_offsets[i] = (uint32_t)(3 * i);
    for (size_t i = 0; i < corners; i++)
        indices[i] = (uint32_t)i;
    *mesh = (struct zr_mesh){.name = "",
                             .position_count = (uint32_t)corners,
                             .positions = reader->positions,
                             .face_count = (uint32_t)reader->triangles,
                             .face_offsets = face_offsets,
                             .indices = indices};
    return ZR_OK;
}

static bool in_range(const struct reader *reader, double value)
{
    double limit = (double)reader->limits->coordinate_max;
    return value >= -limit && value <= limit; /* false for a NaN */
}

static enum zr_status read_binary(struct reader *reader, const char *bytes, size_t count, struct zr_mesh *mesh)
{
    reader->triangles = count;
    reader->positions = zr_arena_alloc(reader->arena, count * 3, sizeof *reader->positions);
    if (!reader->positions) return ZR_NO_MEMORY;
    const char *triangle = bytes + COUNT_END;
    for (size_t i = 0; i < count && reader->error->count < ZR_ERROR_ITEMS; i++, triangle += TRIANGLE_BYTES)
        for (size_t corner = 0; corner < 3; corner++) {
            float v[3];
            bool good = true;
            for (size_t axis = 0; axis < 3; axis++) {
                v[axis] = read_f32(triangle + VERTICES_AT + (corner * 3 + axis) * 4);
                good = in_range(reader, (double)v[axis]) && good;
            }
            reader->positions[i * 3 + corner] = (zr_vec4){v[0], v[1], v[2], 1};
            if (!good)
                zr_error_add(reader->error, ZR_BAD_SCENE, NULL,
                             "triangle %zu of %zu, vertex %zu: (%.9g, %.9g, %.9g) is beyond the limit of %.9g", i + 1,
                             count, corner + 1, (double)v[0], (double)v[1], (double)v[2],
                             (double)reader->limits->coordinate_max);
        }
    return reader->error->count > 0 ? reader->error->status : make_mesh(reader, mesh);
}

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

/* False on bad syntax only: a place out of range is reported, and the rest read. */
static bool read_vertex(struct reader *reader, zr_vec4 *out)
{
    float v[3] = {0, 0, 0};
    if (!expect_word(reader, "vertex")) return false;
    for (int axis = 0; axis < 3; axis++) {
        double value;
        skip_spaces(reader);
        const char *at = reader->at, *behind = zr_number_next(at, reader->end, &value);
        if (!behind || (behind < reader->end && !is_space(*behind)))
            return syntax_fault(reader, next_token(reader), "", "a number");
        reader->at = behind;
        if (in_range(reader, value))
            v[axis] = (float)value;
        else
            zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: %s in triangle %zu is beyond the limit of %.9g",
                         reader->line, zr_quote(at, (size_t)(behind - at)).text, reader->triangles + 1,
                         (double)reader->limits->coordinate_max);
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
    for (size_t corner = 0; corner < 3; corner++)
        if (!read_vertex(reader, &reader->positions[reader->triangles * 3 + corner])) return false;
    if (!expect_word(reader, "endloop") || !expect_word(reader, "endfacet")) return false;
    reader->triangles++;
    return true;
}

/* Behind "solid"; names are free text up to the end of their line. */
static bool read_solid(struct reader *reader)
{
    skip_line(reader);
    while (reader->error->count < ZR_ERROR_ITEMS) {
        struct token token = next_token(reader);
        if (is_word(token, "endsolid")) {
            skip_line(reader);
            return true;
        }
        if (!is_word(token, "facet")) return syntax_fault(reader, token, "", "'facet' or 'endsolid'");
        if (!read_facet(reader)) return false;
    }
    return false;
}

static enum zr_status read_ascii(struct reader *reader, const char *bytes, size_t size, struct zr_mesh *mesh)
{
    size_t triangles_max = size / (sizeof TRIANGLE_TEXT - 1) + 1;
    if (triangles_max > TRIANGLES_MAX)
        return zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "an ASCII STL file of %zu bytes is too large", size);
    reader->positions = zr_arena_alloc(reader->arena, triangles_max * 3, sizeof *reader->positions);
    if (!reader->positions) return ZR_NO_MEMORY;
    reader->at = bytes;
    reader->end = bytes + size;
    reader->line = 1;
    for (;;) {
        struct token token = next_token(reader);
        if (token.size == 0) break;
        if (!is_word(token, "solid")) {
            syntax_fault(reader, token, "'", "solid");
            break;
        }
        if (!read_solid(reader)) break;
    }
    return reader->error->count > 0 ? reader->error->status : make_mesh(reader, mesh);
}

static bool begins_with_solid(const char *bytes, size_t size)
{
    struct reader reader = {.at = bytes, .end = bytes + size};
    return is_word(next_token(&reader), "solid");
}

enum zr_status zr_stl_read(struct zr_arena *arena, const char *bytes, size_t size, const struct zr_limits *limits,
                           struct zr_mesh *mesh, struct zr_error *error)
{
    struct reader reader = {.arena = arena, .limits = limits, .error = error};
    /* The size decides: many binary files begin with "solid" too. */
    uint32_t count = size >= COUNT_END ? read_u32(bytes + HEADER_BYTES) : 0;
    uint64_t wanted = COUNT_END + (uint64_t)count * TRIANGLE_BYTES;
    bool binary = size >= COUNT_END && wanted == size;
    if (!binary && begins_with_solid(bytes, size)) return read_ascii(&reader, bytes, size, mesh);
    if (size < COUNT_END)
        return zr_error_add(error, ZR_BAD_SYNTAX, NULL,
                            "neither 'solid' nor a binary header: at least %d bytes expected, got %zu", COUNT_END,
                            size);
    if (!binary)
        return zr_error_add(error, ZR_BAD_SYNTAX, NULL, "%llu bytes expected for %u triangles, got %zu",
                            (unsigned long long)wanted, count, size);
    if (count > TRIANGLES_MAX)
        return zr_error_add(error, ZR_BAD_SCENE, NULL, "%u triangles, more than the limit of %d", count, TRIANGLES_MAX);
    return read_binary(&reader, bytes, count, mesh);
}
