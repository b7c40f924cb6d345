/* The second pass over a file of OBJ: reads its statements. */
#include <math.h>

#include "input/obj/obj_file.h"
#include "input/text/text.h"

enum { VERTEX_NUMBERS_MAX = 6 };

/* Tolerances: colours above 1 by more than rounding have the range 0 to 255. Colours above 255 by more are refused. */
#define COLOR_LEAST    (-1.0f)
#define COLOR_IN_BYTES 2.0f
#define COLOR_MOST     256.0f

/* State of one thread that reads a part. */
struct reader {
    const struct zr_obj_file *file;
    struct zr_obj_text text;
    struct zr_obj_counts count; /* counts since the start of the file */
    struct zr_error *error;
    struct zr_obj_noted notes[ZR_OBJ_NOTES];
    struct zr_obj_statement whole; /* the statement with its keyword */
    uint32_t group;
    float color_most;
    struct zr_box box;
    bool is_far, has_short_faces;
    bool normal_given, normal_missing;
    bool bad_syntax; /* stops reading: any later faults would follow from this one */
};

static void note(struct reader *reader, enum zr_obj_note note)
{
    zr_obj_note(reader->notes, note, &reader->whole);
}

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

/* Reads up to `most` numbers. False at any other word. */
ZR_INLINED bool read_numbers(const struct reader *reader, struct zr_obj_statement *statement, int most, double *out,
                             int *count)
{
    *count = 0;
    for (zr_obj_skip_blanks(statement); !zr_obj_at_end(statement); zr_obj_skip_blanks(statement)) {
        if (*count == most) return false;
        const char *behind = zr_number_next(statement->at, reader->file->end, &out[*count]);
        if (!behind || !zr_obj_ends_word(statement, behind)) return false;
        ++*count;
        statement->at = behind;
    }
    return true;
}

/* Reports a number of v or vn that is beyond the limit. `statement` begins after the keyword. */
static bool limit_fault(struct reader *reader, struct zr_obj_statement statement, int index, double limit)
{
    struct zr_obj_statement word = {0};
    for (int i = 0; i <= index; i++) {
        zr_obj_skip_blanks(&statement);
        word = zr_obj_word(&statement);
    }
    zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: %s is beyond the limit of %.9g", statement.line,
                 zr_quote(word.at, (size_t)(word.end - word.at)).text, limit);
    return false;
}

static bool count_fault(struct reader *reader, const struct zr_obj_statement *statement, const char *expected,
                        int count)
{
    reader->bad_syntax = true;
    zr_error_add(reader->error, ZR_BAD_SYNTAX, NULL, "line %zu: expected %s, found %d", statement->line, expected,
                 count);
    return false;
}

/* ---- vertices ---- */

/* Returns the component in 0..1. */
static float clamp_color(float value, bool *is_clamped)
{
    *is_clamped = *is_clamped || value < 0.0f || value > 1.0f;
    return value < 0.0f ? 0.0f : value > 1.0f ? 1.0f : value;
}

static bool set_color(struct reader *reader, const struct zr_obj_statement *statement, const double *rgb)
{
    float scaled[3];
    bool is_clamped = false;
    for (int i = 0; i < 3; i++) {
        const float value = (float)rgb[i];
        if (!(value >= COLOR_LEAST && value <= COLOR_MOST)) {
            zr_error_add(reader->error, ZR_BAD_SCENE, NULL,
                         "line %zu: a colour component of %.9g is outside of 0 to 1, or 0 to 255", statement->line,
                         (double)value);
            return false;
        }
        if (value > reader->color_most) reader->color_most = value;
        scaled[i] = clamp_color(value / reader->file->color_scale, &is_clamped);
    }
    if (is_clamped) note(reader, ZR_OBJ_NOTE_CLAMPED);
    reader->file->colors[reader->count.positions] = (zr_vec4){scaled[0], scaled[1], scaled[2], 1};
    return true;
}

static void set_position(struct reader *reader, const double *v)
{
    const struct zr_obj_file *file = reader->file;
    const size_t index = reader->count.positions;
    file->positions[index] = zr_recenter_position(v, file->origin);
    if (file->used && file->used[index]) zr_box_include(&reader->box, v);
}

static bool set_hole(struct reader *reader)
{
    const struct zr_obj_file *file = reader->file;
    note(reader, ZR_OBJ_NOTE_HOLES);
    file->positions[reader->count.positions] = (zr_vec4){NAN, 0, 0, 1};
    if (file->colors) file->colors[reader->count.positions] = (zr_vec4){1, 1, 1, 1};
    return true;
}

/* Reads v x y z, v x y z w (a weight for curves) or v x y z r g b (written by Meshlab). */
static bool read_vertex(struct reader *reader, struct zr_obj_statement *statement)
{
    const struct zr_limits *limits = reader->file->limits;
    const double near = (double)limits->coordinate_max, far = zr_recenter_limit(limits);
    const struct zr_obj_statement words = *statement;
    double v[VERTEX_NUMBERS_MAX];
    int count;
    if (!read_numbers(reader, statement, VERTEX_NUMBERS_MAX, v, &count)) {
        if (count < 3 && zr_obj_at_not_finite(*statement)) return set_hole(reader);
        if (count < 3 || !zr_obj_is_bad_color(words, reader->file->end))
            return word_fault(reader, statement, count == VERTEX_NUMBERS_MAX ? "the end of the line" : "a number");
        note(reader, ZR_OBJ_NOTE_BAD_COLORS);
        count = 3;
    }
    for (int i = 0; i < count; i++) {
        if (v[i] >= -near && v[i] <= near) continue;
        if (i >= 3 || !(v[i] >= -far && v[i] <= far)) return limit_fault(reader, words, i, i < 3 ? far : near);
        reader->is_far = true;
    }
    if (count != 3 && count != 4 && count != 6)
        return count_fault(reader, statement, "3, 4 or 6 numbers behind v", count);
    set_position(reader, v);
    if (count == 6) return set_color(reader, statement, v + 3);
    if (reader->file->colors) reader->file->colors[reader->count.positions] = (zr_vec4){1, 1, 1, 1};
    return true;
}

/* Reads a normal. Other words than numbers count as zero: exporters write "nan" for faces without area. */
static bool read_normal(struct reader *reader, struct zr_obj_statement *statement)
{
    const double limit = (double)reader->file->limits->coordinate_max;
    const struct zr_obj_statement words = *statement;
    double v[3] = {0, 0, 0};
    int count;
    const bool is_good = read_numbers(reader, statement, 3, v, &count) && count == 3;
    if (!is_good) note(reader, ZR_OBJ_NOTE_BAD_NORMALS);
    for (int i = 0; is_good && i < 3; i++)
        if (!(v[i] >= -limit && v[i] <= limit)) return limit_fault(reader, words, i, limit);
    reader->file->normals[reader->count.normals] =
        is_good ? (zr_vec3){(float)v[0], (float)v[1], (float)v[2]} : (zr_vec3){0, 0, 0};
    return true;
}

/* Reads u, and v if it is given. Words that are no numbers count as zero.
 * Numbers beyond the limit also do, if textures use them. */
static void read_texcoord(struct reader *reader, struct zr_obj_statement *statement)
{
    const double most = (double)ZR_TEXCOORD_MAX;
    zr_vec4 *const texcoords = reader->file->texcoords;
    double v[3] = {0, 0, 0};
    int count;
    bool is_good = read_numbers(reader, statement, 3, v, &count) && count > 0;
    if (count < 2) v[1] = 0;
    if (texcoords) is_good = is_good && fabs(v[0]) <= most && fabs(v[1]) <= most;
    if (!is_good) note(reader, ZR_OBJ_NOTE_BAD_TEXCOORDS);
    if (texcoords)
        texcoords[reader->count.texcoords] =
            is_good ? (zr_vec4){(float)v[0], (float)(1.0 - v[1]), 0, 0} : (zr_vec4){0, 1, 0, 0};
}

/* ---- indices ---- */

static bool index_fault(struct reader *reader, const struct zr_obj_statement *statement, int64_t index)
{
    const size_t so_far = reader->count.positions;
    if (index < 0)
        zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: relative index %lld, but %zu vertices so far",
                     statement->line, (long long)index, so_far);
    else
        zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: index %lld of %zu vertices; they count from 1",
                     statement->line, (long long)index, reader->file->total.positions);
    return false;
}

/* ---- faces ---- */

static void set_texcoord(struct reader *reader, const struct zr_obj_corner *corner, size_t slot)
{
    const struct zr_obj_file *file = reader->file;
    uint32_t *out = &file->texcoord_indices[slot];
    if (corner->has_texcoord &&
        zr_obj_resolve_index(corner->texcoord, reader->count.texcoords, file->total.texcoords, out))
        return;
    if (corner->has_texcoord) note(reader, ZR_OBJ_NOTE_WRONG_TEXCOORDS);
    *out = ZR_OBJ_NO_TEXCOORD;
}

ZR_INLINED bool read_corner(struct reader *reader, struct zr_obj_statement *statement, size_t slot, bool is_textured)
{
    const struct zr_obj_file *file = reader->file;
    struct zr_obj_corner corner;
    if (!zr_obj_read_indices(statement, is_textured, &corner))
        return word_fault(reader, statement, "a corner: v, v/vt, v//vn or v/vt/vn");
    if (!zr_obj_resolve_index(corner.position, reader->count.positions, file->total.positions, &file->indices[slot]))
        return index_fault(reader, statement, corner.position);
    if (corner.has_gap) note(reader, ZR_OBJ_NOTE_EMPTY_INDICES);
    if (is_textured) set_texcoord(reader, &corner, slot);
    if (corner.has_normal) {
        uint32_t normal;
        if (zr_obj_resolve_index(corner.normal, reader->count.normals, file->total.normals, &normal)) {
            reader->normal_given = true;
            file->normal_indices[slot] = normal;
            return true;
        }
        note(reader, ZR_OBJ_NOTE_WRONG_NORMALS);
    }
    reader->normal_missing = true;
    if (file->normal_indices) file->normal_indices[slot] = ZR_OBJ_NO_NORMAL;
    return true;
}

static bool read_textured_corner(struct reader *reader, struct zr_obj_statement *statement, size_t slot)
{
    return read_corner(reader, statement, slot, true);
}

#ifdef __SSE2__
/* Reads a face of positions alone, with one space before each, the usual form: saves a fifth of the reading time. False
 * for any other form or fault. */
ZR_INLINED bool read_plain_face(struct reader *reader, const struct zr_obj_statement *statement)
{
    const struct zr_obj_file *file = reader->file;
    const char *at = statement->at, *end = statement->end;
    size_t first = reader->count.corners, corners;
    if (file->end - at < ZR_QUICK_ROW_BYTES || *at != ' ') return false;
    const char *behind = zr_number_quick_row(at, ' ', 1, (uint32_t)file->total.positions,
                                             file->limits->polygon_vertices_max, file->indices + first, &corners);
    if (!behind || corners < 3 || !(behind == end || (behind + 1 == end && *behind == '\r'))) return false;
    reader->normal_missing = true;
    for (size_t i = 0; file->normal_indices && i < corners; i++)
        file->normal_indices[first + i] = ZR_OBJ_NO_NORMAL;
    for (size_t i = 0; file->texcoord_indices && i < corners; i++)
        file->texcoord_indices[first + i] = ZR_OBJ_NO_TEXCOORD;
    reader->count.corners = first + corners;
    return true;
}
#endif

static bool read_face(struct reader *reader, struct zr_obj_statement *statement)
{
    size_t first = reader->count.corners, corner = first;
    if (reader->has_short_faces && zr_obj_is_short_face(*statement, reader->file->end)) return true;
    reader->count.faces++;
    reader->file->face_offsets[reader->count.faces - 1] = (uint32_t)first;
    if (reader->file->groups) reader->file->groups[reader->count.faces - 1] = reader->group;
#ifdef __SSE2__
    if (read_plain_face(reader, statement)) return true;
#endif
    for (zr_obj_skip_blanks(statement); !zr_obj_at_end(statement); zr_obj_skip_blanks(statement))
        if (!(reader->file->texcoord_indices ? read_textured_corner(reader, statement, corner++)
                                             : read_corner(reader, statement, corner++, false)))
            return false;
    reader->count.corners = corner;
    size_t corners = corner - first;
    if (corners >= 3 && corners <= reader->file->limits->polygon_vertices_max) return true;
    zr_error_add(reader->error, ZR_BAD_SCENE, NULL, "line %zu: a face of %zu corners; 3 to %u are allowed",
                 statement->line, corners, reader->file->limits->polygon_vertices_max);
    return false;
}

/* ---- the whole part ---- */

static void read_name(struct reader *reader)
{
    const struct zr_obj_statement *whole = &reader->whole;
    const size_t length = (size_t)(whole->end - whole->at);
    reader->file->names[reader->count.names++] = (struct zr_obj_name){
        whole->at, length < UINT32_MAX ? (uint32_t)length : UINT32_MAX, (uint32_t)reader->count.faces};
}

static void read_statement(struct reader *reader, struct zr_obj_statement *statement)
{
    struct zr_obj_statement word;
    reader->whole = *statement;
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
        reader->count.texcoords++;
        break;
    case ZR_OBJ_F:
        read_face(reader, statement);
        break;
    case ZR_OBJ_LINE:
        if (!zr_obj_read_line(reader->file, statement, &reader->count)) note(reader, ZR_OBJ_NOTE_BAD_LINES);
        break;
    case ZR_OBJ_POINT:
        if (!zr_obj_read_points(reader->file, statement, &reader->count)) note(reader, ZR_OBJ_NOTE_BAD_POINTS);
        break;
    case ZR_OBJ_SMOOTH:
        zr_obj_read_group(statement, &reader->group);
        break;
    case ZR_OBJ_USE:
    case ZR_OBJ_OBJECT:
    case ZR_OBJ_GROUP:
        read_name(reader);
        break;
    default:
        break;
    }
}

bool zr_obj_read_part(const struct zr_obj_file *file, size_t index, size_t faults, struct zr_error *error)
{
    const struct zr_part *text = &file->texts[index];
    struct zr_obj_part *part = &file->parts[index];
    struct reader reader = {.file = file,
                            .text = {text->at, text->end, part->before.lines + 1},
                            .count = part->before,
                            .error = error,
                            .group = part->group_before,
                            .has_short_faces = part->notes[ZR_OBJ_NOTE_SHORT_FACES].count > 0,
                            .box = zr_box_empty()};
    struct zr_obj_statement statement;
    while (!reader.bad_syntax && error->count < faults && zr_obj_next(&reader.text, &statement))
        if (!zr_obj_at_end(&statement)) read_statement(&reader, &statement);
    memcpy(part->notes + ZR_OBJ_NOTE_SECOND, reader.notes + ZR_OBJ_NOTE_SECOND,
           sizeof part->notes - ZR_OBJ_NOTE_SECOND * sizeof *part->notes);
    part->normal_given = reader.normal_given;
    part->normal_missing = reader.normal_missing;
    part->is_far = reader.is_far;
    part->color_most = reader.color_most;
    part->segments = reader.count.segments - part->before.segments;
    part->points = reader.count.points - part->before.points;
    part->box = reader.box;
    return !reader.bad_syntax && error->count < faults;
}
