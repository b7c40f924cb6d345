/* Reads the polygons of Wavefront OBJ (obj_text.h); ignores curves, surfaces and grouping.
 *
 * All threads read the parts of the text twice. The first pass counts: arrays get their sizes, each part its first
 * numbers, and an index can be checked before its vertex is read. The second pass reads. From the first part with a
 * fault on, one thread reads again and reports, so that faults come in the order of the text. */
#include "input/input.h"

#include "input/number.h"
#include "input/obj_text.h"
#include "input/parts.h"
#include "input/text.h"

/* Counted and read in a fifth of a millisecond, about the time to wake a thread. */
#ifndef ZR_OBJ_PART_BYTES /* smaller in tests/unit/test_obj_parts.c */
#define ZR_OBJ_PART_BYTES (1 << 16)
#endif

enum { COUNT_MAX = 1 << 30, VERTEX_NUMBERS_MAX = 6 };

/* Replaces the index of a missing normal until the zero normal has its index. */
#define CORNER_WITHOUT_NORMAL UINT32_MAX

struct counts {
    size_t lines, positions, normals, faces, corners;
};

/* Statements that are not drawn. */
struct unread {
    size_t materials, lines, points, curved;
};

/* Counts of one part, which is whole statements. */
struct part {
    struct counts holds, before;
    struct unread unread;
    bool has_colors;
    bool normal_given, normal_missing; /* at a corner; set by the second pass */
};

/* Data of a file, shared by all threads. */
struct file {
    const char *end;
    const struct zr_limits *limits;
    size_t part_count;
    const struct zr_part *texts;
    struct part *parts;
    struct counts total;
    zr_vec4 *positions, *colors; /* NULL: no vertex has a colour */
    zr_vec3 *normals;
    uint32_t *face_offsets, *indices, *normal_indices; /* NULL: the file has no normals */
};

/* State of one thread that reads a part. */
struct reader {
    const struct file *file;
    struct zr_obj_text text;
    struct counts count; /* counts since the start of the file */
    struct zr_error *error;
    bool normal_given, normal_missing;
    bool bad_syntax; /* stops the reader: more faults would only follow from this one */
};

/* ---- parts ---- */

static bool cut(struct file *file, struct zr_arena *arena, const char *bytes)
{
    file->texts = zr_parts_cut(arena, bytes, file->end, ZR_OBJ_PART_BYTES, zr_obj_cut, &file->part_count);
    file->parts = zr_arena_zero(arena, file->part_count, sizeof *file->parts);
    return zr_arena_ok(arena);
}

static bool count_part(void *context, size_t index)
{
    const struct file *file = context;
    struct part *part = &file->parts[index];
    struct zr_obj_text text = {file->texts[index].at, file->texts[index].end, 0};
    struct zr_obj_statement statement, word;
    struct counts count = {0}; /* local, since the structs of other threads share cache lines */
    struct unread unread = {0};
    while (zr_obj_next(&text, &statement)) {
        if (zr_obj_at_end(&statement)) continue;
        switch (zr_obj_next_keyword(&statement, &word)) {
        case ZR_OBJ_V:
            count.positions++;
            if (zr_obj_count_words(&statement, file->end) == VERTEX_NUMBERS_MAX) part->has_colors = true;
            break;
        case ZR_OBJ_VN:
            count.normals++;
            break;
        case ZR_OBJ_F:
            count.faces++;
            count.corners += zr_obj_count_words(&statement, file->end);
            break;
        case ZR_OBJ_MATERIAL:
            unread.materials++;
            break;
        case ZR_OBJ_LINE:
            unread.lines++;
            break;
        case ZR_OBJ_POINT:
            unread.points++;
            break;
        case ZR_OBJ_CURVED:
            unread.curved++;
            break;
        default:
            break;
        }
    }
    count.lines = text.line;
    part->holds = count;
    part->unread = unread;
    return true;
}

static struct counts sum(struct counts a, struct counts b)
{
    return (struct counts){a.lines + b.lines, a.positions + b.positions, a.normals + b.normals, a.faces + b.faces,
                           a.corners + b.corners};
}

static bool add_up(struct file *file)
{
    bool has_colors = false;
    for (size_t i = 0; i < file->part_count; i++) {
        struct part *part = &file->parts[i];
        part->before = file->total;
        file->total = sum(file->total, part->holds);
        has_colors = has_colors || part->has_colors;
    }
    return has_colors;
}

/* ---- statements ---- */

static bool syntax_fault(struct reader *reader, const struct zr_obj_statement *statement,
                         const struct zr_obj_statement *word, const char *expected)
{
    reader->bad_syntax = true;
    bool nothing = word->at == word->end || *word->at == '#';
    zr_error_add(reader->error, ZR_BAD_SYNTAX, NULL, "line %zu: expected %s, found %s", statement->line, expected,
                 nothing ? "the end of the line" : zr_quote(word->at, (size_t)(word->end - word->at)).text);
    return false;
}

/* Reports the word at the start of the statement. */
static bool word_fault(struct reader *reader, const struct zr_obj_statement *statement, const char *expected)
{
    struct zr_obj_statement shown = *statement, word = zr_obj_word(&shown);
    return syntax_fault(reader, statement, &word, expected);
}

/* Reads numbers up to the end of the statement. False after reporting a word that is no number or too large, or more
 * than `most` numbers. */
static bool read_numbers(struct reader *reader, struct zr_obj_statement *statement, int most, float *out, int *count)
{
    double limit = (double)reader->file->limits->coordinate_max;
    *count = 0;
    for (zr_obj_skip_blanks(statement); !zr_obj_at_end(statement); zr_obj_skip_blanks(statement)) {
        double value;
        const char *at = statement->at, *behind = zr_number_next(at, reader->file->end, &value);
        if (*count == most) return word_fault(reader, statement, "the end of the line");
        if (!behind || !zr_obj_ends_word(statement, behind)) return word_fault(reader, statement, "a number");
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

static bool count_fault(struct reader *reader, const struct zr_obj_statement *statement, const char *expected,
                        int count)
{
    reader->bad_syntax = true;
    zr_error_add(reader->error, ZR_BAD_SYNTAX, NULL, "line %zu: expected %s, found %d", statement->line, expected,
                 count);
    return false;
}

static bool set_color(struct reader *reader, const struct zr_obj_statement *statement, const float *rgb)
{
    for (int i = 0; i < 3; i++)
        if (!(rgb[i] >= 0.0f && rgb[i] <= 1.0f)) {
            zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: a colour component of %.9g is outside of 0 to 1",
                         statement->line, (double)rgb[i]);
            return false;
        }
    reader->file->colors[reader->count.positions] = (zr_vec4){rgb[0], rgb[1], rgb[2], 1};
    return true;
}

/* Reads v x y z, v x y z w (a weight for curves) or v x y z r g b (written by Meshlab). */
static bool read_vertex(struct reader *reader, struct zr_obj_statement *statement)
{
    float v[VERTEX_NUMBERS_MAX];
    int count;
    if (!read_numbers(reader, statement, VERTEX_NUMBERS_MAX, v, &count)) return false;
    if (count != 3 && count != 4 && count != 6)
        return count_fault(reader, statement, "3, 4 or 6 numbers behind v", count);
    reader->file->positions[reader->count.positions] = (zr_vec4){v[0], v[1], v[2], 1};
    if (count == 6) return set_color(reader, statement, v + 3);
    if (reader->file->colors) reader->file->colors[reader->count.positions] = (zr_vec4){1, 1, 1, 1};
    return true;
}

static bool read_normal(struct reader *reader, struct zr_obj_statement *statement)
{
    float v[3];
    int count;
    if (!read_numbers(reader, statement, 3, v, &count)) return false;
    if (count != 3) return count_fault(reader, statement, "3 numbers behind vn", count);
    reader->file->normals[reader->count.normals] = (zr_vec3){v[0], v[1], v[2]};
    return true;
}

static bool read_texcoord(struct reader *reader, struct zr_obj_statement *statement)
{
    float v[3];
    int count;
    if (!read_numbers(reader, statement, 3, v, &count)) return false;
    return count > 0 || count_fault(reader, statement, "1 to 3 numbers behind vt", count);
}

/* Reads an integer with an optional sign; saturates far above any count. */
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

/* Converts an index from 1, or a negative one relative to the last element so far, to an index from 0. */
ZR_INLINED bool resolve_index(struct reader *reader, const struct zr_obj_statement *statement, int64_t index,
                              const char *of, size_t so_far, size_t total, uint32_t *out)
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

/* Reads a corner: v, v/vt, v//vn or v/vt/vn. */
static bool read_corner(struct reader *reader, struct zr_obj_statement *statement, size_t corner)
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
    if (!at || !zr_obj_ends_word(statement, at))
        return word_fault(reader, statement, "a corner: v, v/vt, v//vn or v/vt/vn");
    statement->at = at;
    uint32_t normal_index;
    if (!resolve_index(reader, statement, position, "vertices", reader->count.positions, reader->file->total.positions,
                       &reader->file->indices[corner]))
        return false;
    if (!has_normal) {
        reader->normal_missing = true;
        if (reader->file->normal_indices) reader->file->normal_indices[corner] = CORNER_WITHOUT_NORMAL;
        return true;
    }
    if (!resolve_index(reader, statement, normal, "normals", reader->count.normals, reader->file->total.normals,
                       &normal_index))
        return false;
    reader->normal_given = true;
    reader->file->normal_indices[corner] = normal_index;
    return true;
}

#ifdef __SSE2__
/* Reads a face of positions alone, with one space before each, the usual form: saves a fifth of the reading time. False
 * for any other form or fault. */
ZR_INLINED bool read_plain_face(struct reader *reader, const struct zr_obj_statement *statement)
{
    const struct file *file = reader->file;
    const char *at = statement->at, *end = statement->end;
    size_t first = reader->count.corners, corners;
    if (file->end - at < ZR_QUICK_ROW_BYTES || *at != ' ') return false;
    const char *behind = zr_number_quick_row(at, ' ', 1, (uint32_t)file->total.positions,
                                             file->limits->polygon_vertices_max, file->indices + first, &corners);
    if (!behind || corners < 3 || !(behind == end || (behind + 1 == end && *behind == '\r'))) return false;
    reader->normal_missing = true;
    for (size_t i = 0; file->normal_indices && i < corners; i++)
        file->normal_indices[first + i] = CORNER_WITHOUT_NORMAL;
    reader->count.corners = first + corners;
    return true;
}
#endif

static bool read_face(struct reader *reader, struct zr_obj_statement *statement)
{
    size_t first = reader->count.corners, corner = first;
    reader->file->face_offsets[reader->count.faces] = (uint32_t)first;
#ifdef __SSE2__
    if (read_plain_face(reader, statement)) return true;
#endif
    for (zr_obj_skip_blanks(statement); !zr_obj_at_end(statement); zr_obj_skip_blanks(statement))
        if (!read_corner(reader, statement, corner++)) return false;
    reader->count.corners = corner;
    size_t corners = corner - first;
    if (corners >= 3 && corners <= reader->file->limits->polygon_vertices_max) return true;
    zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: a face of %zu corners; 3 to %u are allowed",
                 statement->line, corners, reader->file->limits->polygon_vertices_max);
    return false;
}

static void read_statement(struct reader *reader, struct zr_obj_statement *statement)
{
    struct zr_obj_statement word;
    switch (zr_obj_next_keyword(statement, &word)) {
    case ZR_OBJ_V:
        read_vertex(reader, statement);
        reader->count.positions++;
        break;
    case ZR_OBJ_VN:
        read_normal(reader, statement);
        reader->count.normals++;
        break;
    case ZR_OBJ_VT:
        read_texcoord(reader, statement);
        break;
    case ZR_OBJ_F:
        read_face(reader, statement);
        reader->count.faces++;
        break;
    case ZR_OBJ_MATERIAL:
    case ZR_OBJ_LINE:
    case ZR_OBJ_POINT:
    case ZR_OBJ_CURVED:
    case ZR_OBJ_IGNORED:
        break;
    case ZR_OBJ_UNKNOWN:
        syntax_fault(reader, statement, &word, "a statement of OBJ");
        break;
    }
}

/* ---- the whole ---- */

/* Reads a part up to `faults` faults or a syntax error; false then. */
static bool read_up_to(const struct file *file, size_t index, size_t faults, struct zr_error *error)
{
    const struct zr_part *text = &file->texts[index];
    struct part *part = &file->parts[index];
    struct reader reader = {
        .file = file, .text = {text->at, text->end, part->before.lines + 1}, .count = part->before, .error = error};
    struct zr_obj_statement statement;
    while (!reader.bad_syntax && error->count < faults && zr_obj_next(&reader.text, &statement))
        if (!zr_obj_at_end(&statement)) read_statement(&reader, &statement);
    part->normal_given = reader.normal_given;
    part->normal_missing = reader.normal_missing;
    return !reader.bad_syntax && error->count < faults;
}

static bool read_part(void *context, size_t index)
{
    struct zr_error error = {.count = 0};
    return read_up_to(context, index, 1, &error);
}

static bool allocate(struct file *file, struct zr_arena *arena, bool has_colors)
{
    const struct counts *total = &file->total;
    file->positions = zr_arena_alloc(arena, total->positions, sizeof *file->positions);
    if (has_colors) file->colors = zr_arena_alloc(arena, total->positions, sizeof *file->colors);
    file->normals = zr_arena_alloc(arena, total->normals + 1, sizeof *file->normals);
    file->face_offsets = zr_arena_alloc(arena, total->faces + 1, sizeof *file->face_offsets);
    file->indices = zr_arena_alloc(arena, total->corners, sizeof *file->indices);
    if (total->normals > 0) file->normal_indices = zr_arena_alloc(arena, total->corners, sizeof *file->normal_indices);
    return zr_arena_ok(arena);
}

/* Corners without a normal share one zero normal, whose value is computed later. Returns the number of normals. */
static uint32_t finish_normals(struct file *file)
{
    bool given = false, missing = false;
    for (size_t i = 0; i < file->part_count; i++) {
        given = given || file->parts[i].normal_given;
        missing = missing || file->parts[i].normal_missing;
    }
    uint32_t count = (uint32_t)file->total.normals;
    if (!given) return 0;
    if (!missing) return count;
    file->normals[count] = (zr_vec3){0, 0, 0};
    for (size_t i = 0; i < file->total.corners; i++)
        if (file->normal_indices[i] == CORNER_WITHOUT_NORMAL) file->normal_indices[i] = count;
    return count + 1;
}

static void warn_of(struct zr_scene_builder *builder, size_t count, const char *what)
{
    if (count > 0) zr_warning_list_add(builder->arena, &builder->warnings, "OBJ: %zu %s", count, what);
}

static void warn_of_unread(const struct file *file, struct zr_scene_builder *builder)
{
    struct unread all = {0};
    for (size_t i = 0; i < file->part_count; i++) {
        const struct unread *unread = &file->parts[i].unread;
        all.materials += unread->materials;
        all.lines += unread->lines;
        all.points += unread->points;
        all.curved += unread->curved;
    }
    warn_of(builder, all.materials, "statements about materials (mtllib, usemtl) are not read in this version");
    warn_of(builder, all.lines, "lines (l) are not drawn in this version");
    warn_of(builder, all.points, "points (p) are not drawn");
    warn_of(builder, all.curved, "curves and curved surfaces are not drawn");
}

enum zr_status zr_read_OBJ(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    struct zr_arena *arena = builder->arena;
    struct zr_team *team = builder->team;
    struct file file = {.end = request->bytes + request->size, .limits = limits};
    if (!cut(&file, arena, request->bytes)) return ZR_NO_MEMORY;
    if (zr_parts_read(team, request->cancel, 0, file.part_count, count_part, &file) < file.part_count)
        return ZR_CANCELLED;
    const bool has_colors = add_up(&file);
    const struct counts *total = &file.total;
    if (total->positions > COUNT_MAX || total->normals > COUNT_MAX || total->corners > COUNT_MAX)
        return zr_error_add(error, ZR_BAD_SCENE, NULL, "more than %d vertices, normals or corners", COUNT_MAX);
    if (!allocate(&file, arena, has_colors)) return ZR_NO_MEMORY;

    size_t part = zr_parts_read(team, request->cancel, 0, file.part_count, read_part, &file);
    while (part < file.part_count && !zr_is_cancelled(request->cancel) &&
           read_up_to(&file, part, ZR_ERROR_ITEMS, error))
        part++;
    if (zr_is_cancelled(request->cancel)) return ZR_CANCELLED;
    if (error->count > 0) return error->status;
    if (total->faces == 0) return zr_error_add(error, ZR_BAD_SCENE, NULL, "no geometry: the OBJ file has no face (f)");
    file.face_offsets[total->faces] = (uint32_t)total->corners;
    const uint32_t normal_count = finish_normals(&file);
    struct zr_mesh *mesh = zr_scene_builder_meshes(builder, 1);
    if (!mesh) return ZR_NO_MEMORY;
    *mesh = (struct zr_mesh){.name = "",
                             .position_count = (uint32_t)total->positions,
                             .positions = file.positions,
                             .face_count = (uint32_t)total->faces,
                             .face_offsets = file.face_offsets,
                             .indices = file.indices,
                             .normal_count = normal_count,
                             .normals = normal_count ? file.normals : NULL,
                             .normal_indices = normal_count ? file.normal_indices : NULL,
                             .colors = file.colors};
    if (normal_count) zr_scene_builder_note_normals(builder, 0, file.normals, total->normals);
    warn_of_unread(&file, builder);
    return zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* True if the first statement other than a comment begins with a keyword of OBJ. */
bool zr_looks_so_OBJ(const char *bytes, size_t size)
{
    static const char *const words[] = {"v", "vn", "vt", "f", "l", "p", "g", "o", "s", "mtllib", "usemtl"};
    const char *at = bytes, *const end = bytes + (size < ZR_BLANKS_MAX ? size : ZR_BLANKS_MAX);
    for (;;) {
        at += zr_count_blanks(at, (size_t)(end - at));
        if (at == end || *at != '#') break;
        const char *next = memchr(at, '\n', (size_t)(end - at));
        if (!next) return false;
        at = next;
    }
    size_t length = 0;
    while (at + length < end && zr_count_blanks(at + length, 1) == 0)
        length++;
    if (at + length == end) return false;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strlen(words[i]) == length && memcmp(at, words[i], length) == 0) return true;
    return false;
}
