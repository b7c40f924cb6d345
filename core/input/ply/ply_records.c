/* Records of any PLY element, in ASCII and binary, with lists of any length, read in order by one thread. */
#include <math.h>
#include <stdio.h>

#include "input/ply/ply_file.h"
#include "input/text/number.h"
#include "input/text/text.h"

enum { RECORDS_PER_CANCEL_CHECK = 1 << 10, VALUES_PER_CANCEL_CHECK = 1 << 12, CHARACTERS_PER_CANCEL_CHECK = 1 << 18 };

struct reader {
    struct zr_ply_file *file;
    const struct zr_ply_plan *plan;
    bool is_text, is_swapped;
    size_t record;
    size_t first_corner; /* of the record's list */
    size_t strip;        /* corners of the strip so far */
    uint32_t before[2];  /* the last two corners of the strip */
    bool is_flipped;     /* the next triangle of the strip is reversed */
    bool is_bad;         /* the record has a fault after which reading continues */
    struct zr_ply_columns *columns;
};

/* ---- places ---- */

struct place {
    char text[120];
};

/* Formats "line 20: face 12" or "face 12". */
static struct place place_of(const struct reader *reader)
{
    struct place place;
    int used = 0;
    if (reader->is_text) used = snprintf(place.text, sizeof place.text, "line %zu: ", reader->file->line);
    snprintf(place.text + used, sizeof place.text - (size_t)used, "%s %zu",
             zr_ply_printable(reader->plan->element->name).text, reader->record);
    return place;
}

/* Reports a fault that ends reading. Returns false. */
static bool syntax_fault(const struct reader *reader, const char *what, const char *found)
{
    const struct zr_ply_oddities *odd = &reader->file->odd;
    zr_error_add(reader->file->error, ZR_BAD_SYNTAX, NULL, "%s%s%s%s", place_of(reader).text, what,
                 found ? ", not " : "", found ? found : "");
    if (odd->broken_lines > 0)
        zr_error_add(reader->file->error, ZR_BAD_SYNTAX, NULL,
                     "line %zu: %s %zu has another number of values than the header says", odd->first_broken_line,
                     zr_ply_printable(odd->broken_name).text, odd->broken_record);
    return false;
}

static bool end_fault(const struct reader *reader, const char *property)
{
    char what[160];
    snprintf(what, sizeof what, " of %zu: the file ends before its %s", reader->plan->element->count, property);
    return syntax_fault(reader, what, NULL);
}

/* ---- values ---- */

static bool is_space(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

static void skip_spaces(struct zr_ply_file *file)
{
    for (; file->at < file->end && is_space(*file->at); file->at++)
        file->line += *file->at == '\n' || (*file->at == '\r' && (file->at + 1 == file->end || file->at[1] != '\n'));
}

/* True at a line that begins with `comment`, as in the header. */
static bool is_comment(const struct zr_ply_file *file)
{
    static const char word[] = "comment";
    const size_t left = (size_t)(file->end - file->at), length = sizeof word - 1;
    return file->line > file->last_line && left >= length && memcmp(file->at, word, length) == 0 &&
           (left == length || is_space(file->at[length]));
}

void zr_ply_skip_comments(struct zr_ply_file *file)
{
    for (skip_spaces(file); is_comment(file) && !zr_is_cancelled(file->cancel); skip_spaces(file)) {
        if (file->odd.comments++ == 0) file->odd.first_comment = file->line;
        for (size_t i = 0; file->at < file->end && *file->at != '\n' && *file->at != '\r'; i++, file->at++)
            if (i % CHARACTERS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(file->cancel)) return;
    }
}

static bool next_text(struct reader *reader, const struct zr_ply_property *property, double *value)
{
    struct zr_ply_file *file = reader->file;
    skip_spaces(file);
    if (file->at == file->end) return end_fault(reader, zr_ply_printable(property->name).text);
    const char *behind = zr_number_next(file->at, file->end, value);
    if (behind && (behind == file->end || is_space(*behind))) {
        file->at = behind;
        return true;
    }
    const char *at = file->at, *end = at;
    while (end < file->end && !is_space(*end) && end - at < 64)
        end++;
    if (!zr_is_not_finite(at, (size_t)(end - at))) {
        char what[160];
        snprintf(what, sizeof what, ": expected a number for %s", zr_ply_printable(property->name).text);
        return syntax_fault(reader, what, zr_quote(at, (size_t)(end - at)).text);
    }
    file->at = end;
    *value = (double)NAN;
    return true;
}

static bool next_value(struct reader *reader, const struct zr_ply_property *property, enum zr_ply_type type,
                       double *value)
{
    struct zr_ply_file *file = reader->file;
    if (reader->is_text) return next_text(reader, property, value);
    const size_t bytes = zr_ply_type_bytes(type);
    if ((size_t)(file->end - file->at) < bytes) return end_fault(reader, zr_ply_printable(property->name).text);
    *value = zr_ply_value(file->at, type, reader->is_swapped);
    file->at += bytes;
    return true;
}

/* ---- lists ---- */

static bool skip_values(struct reader *reader, const struct zr_ply_property *property, size_t count)
{
    struct zr_ply_file *file = reader->file;
    double value;
    if (!reader->is_text) {
        const size_t bytes = zr_ply_type_bytes(property->type);
        if (count > (size_t)(file->end - file->at) / bytes)
            return end_fault(reader, zr_ply_printable(property->name).text);
        file->at += count * bytes;
        return true;
    }
    for (size_t i = 0; i < count; i++) {
        if (i % VALUES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(file->cancel)) return false;
        if (!next_text(reader, property, &value)) return false;
    }
    return true;
}

/* Adds a triangle of a strip, every second one reversed. Skips triangles with two equal corners, which join strips. */
static bool end_triangle(struct reader *reader, uint32_t a, uint32_t b, uint32_t c)
{
    struct zr_ply_faces *faces = &reader->file->faces;
    if (a == b || b == c || a == c) return true;
    if (!zr_ply_faces_reserve(reader->file, 1, 3)) return false;
    const uint32_t corners[3] = {a, b, c};
    memcpy(faces->indices + faces->corner_count, corners, sizeof corners);
    faces->corner_count += 3;
    return zr_ply_faces_end(reader->file, NULL);
}

static bool add_to_strip(struct reader *reader, double value)
{
    bool is_good = true;
    if (value < 0.0) {
        reader->strip = 0;
        return true;
    }
    const uint32_t index = (uint32_t)value, *before = reader->before;
    if (reader->strip++ >= 2) {
        is_good = reader->is_flipped ? end_triangle(reader, before[1], before[0], index)
                                     : end_triangle(reader, before[0], before[1], index);
        reader->is_flipped = !reader->is_flipped;
    } else
        reader->is_flipped = false;
    reader->before[0] = before[1];
    reader->before[1] = index;
    return is_good;
}

/* Adds a vertex to the record's face or strip. False ends reading. */
static bool add_corner(struct reader *reader, double value)
{
    struct zr_ply_file *file = reader->file;
    struct zr_ply_faces *faces = &file->faces;
    const bool is_strip = reader->plan->kind == ZR_PLY_STRIPS;
    const double least = is_strip ? -1.0 : 0.0;
    if (!(value >= least && value < (double)file->vertex_count && value == floor(value))) {
        if (!reader->is_bad)
            zr_error_add(file->error, ZR_BAD_SCENE, NULL, "%s names vertex %.9g, but there are %zu, from 0 on",
                         place_of(reader).text, value, file->vertex_count);
        reader->is_bad = true;
    }
    if (reader->is_bad) return true;
    if (is_strip) return add_to_strip(reader, value);
    faces->indices[faces->corner_count++] = (uint32_t)value;
    return true;
}

static bool check_corners(struct reader *reader, size_t count)
{
    struct zr_ply_file *file = reader->file;
    if (reader->plan->kind == ZR_PLY_STRIPS) return true;
    if (count <= file->limits->polygon_vertices_max) return zr_ply_faces_reserve(file, 0, count);
    zr_error_add(file->error, ZR_BAD_SCENE, NULL, "%s has %zu corners; 3 to %u are allowed", place_of(reader).text,
                 count, file->limits->polygon_vertices_max);
    reader->is_bad = true;
    return true;
}

/* Reads a list. The plan's list holds corners; others are skipped. */
static bool read_list(struct reader *reader, const struct zr_ply_property *property)
{
    struct zr_ply_file *file = reader->file;
    double length, value;
    if (!next_value(reader, property, property->count_type, &length)) return false;
    if (!(length >= 0.0 && length == floor(length))) {
        char what[160];
        snprintf(what, sizeof what, ": a list %s of %.9g values", zr_ply_printable(property->name).text, length);
        return syntax_fault(reader, what, NULL);
    }
    const size_t bytes = reader->is_text ? 1 : zr_ply_type_bytes(property->type);
    if (length > (double)((size_t)(file->end - file->at) / bytes))
        return end_fault(reader, zr_ply_printable(property->name).text);
    const size_t count = (size_t)length;
    if (property != reader->plan->indices) return skip_values(reader, property, count);
    if (!check_corners(reader, count)) return false;
    for (size_t i = 0; i < count; i++) {
        if (i % VALUES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(file->cancel)) return false;
        if (!next_value(reader, property, property->type, &value) || !add_corner(reader, value)) return false;
    }
    return true;
}

/* ---- records ---- */

static bool end_face(struct reader *reader)
{
    struct zr_ply_file *file = reader->file;
    struct zr_ply_faces *faces = &file->faces;
    const size_t corners = faces->corner_count - reader->first_corner;
    if (corners < 3 && !reader->is_bad) {
        if (file->odd.small_faces++ == 0) file->odd.first_small_face = reader->record;
        faces->corner_count = reader->first_corner;
        return true;
    }
    zr_vec4 color = {1, 1, 1, 1};
    if (reader->plan->slots[ZR_PLY_RED]) zr_ply_store_colors(file, reader->plan, reader->columns, 1, &color);
    return zr_ply_faces_end(file, &color);
}

static bool end_edge(struct reader *reader)
{
    struct zr_ply_file *file = reader->file;
    for (int k = 0; k < 2; k++) {
        const double value = reader->columns->values[ZR_PLY_VERTEX1 + k][0];
        if (value >= 0.0 && value < (double)file->vertex_count && value == floor(value)) {
            file->lines[2 * reader->record + (size_t)k] = (uint32_t)value;
            continue;
        }
        zr_error_add(file->error, ZR_BAD_SCENE, NULL, "%s names vertex %.9g, but there are %zu, from 0 on",
                     place_of(reader).text, value, file->vertex_count);
    }
    return true;
}

static bool end_record(struct reader *reader)
{
    switch (reader->plan->kind) {
    case ZR_PLY_VERTEX:
        zr_ply_store_vertices(reader->file, reader->plan, reader->columns, reader->record, 1, ZR_ERROR_ITEMS,
                              reader->file->error);
        return true;
    case ZR_PLY_FACE:
        return end_face(reader);
    case ZR_PLY_EDGE:
        return end_edge(reader);
    case ZR_PLY_STRIPS:
    case ZR_PLY_OTHER:
        break;
    }
    return true;
}

/* `slots`: the slot of each property, or ZR_PLY_SLOTS. */
static bool read_record(struct reader *reader, const uint8_t *slots)
{
    const struct zr_ply_element *element = reader->plan->element;
    double value;
    reader->first_corner = reader->file->faces.corner_count;
    reader->strip = 0;
    reader->is_bad = false;
    for (size_t i = 0; i < element->property_count; i++) {
        const struct zr_ply_property *property = &element->properties[i];
        if (property->is_list) {
            if (!read_list(reader, property)) return false;
            continue;
        }
        if (!next_value(reader, property, property->type, &value)) return false;
        if (slots[i] < ZR_PLY_SLOTS) reader->columns->values[slots[i]][0] = value;
    }
    return end_record(reader);
}

/* Counts a record that shares a line with another one or spans several lines. */
static void note_lines(const struct reader *reader, size_t line)
{
    struct zr_ply_file *file = reader->file;
    struct zr_ply_oddities *odd = &file->odd;
    const size_t line_before = file->last_line;
    file->last_line = file->line;
    if (line > line_before && file->line == line) return;
    if (odd->broken_lines++ > 0) return;
    odd->first_broken_line = line;
    odd->broken_record = reader->record - (line == line_before && reader->record > 0);
    odd->broken_name = reader->plan->element->name;
}

static void find_slots(const struct zr_ply_plan *plan, uint8_t *slots)
{
    memset(slots, ZR_PLY_SLOTS, plan->element->property_count);
    for (int slot = 0; slot < ZR_PLY_SLOTS; slot++)
        if (plan->slots[slot]) slots[plan->slots[slot] - plan->element->properties] = (uint8_t)slot;
}

enum zr_status zr_ply_read_records(struct zr_ply_file *file, const struct zr_ply_plan *plan, size_t first)
{
    struct zr_ply_columns *columns = zr_arena_alloc(file->arena, 1, sizeof *columns);
    uint8_t *slots = zr_arena_alloc(file->arena, plan->element->property_count, sizeof *slots);
    struct reader reader = {.file = file,
                            .plan = plan,
                            .is_text = file->header.form == ZR_PLY_ASCII,
                            .is_swapped = zr_ply_is_swapped(file->header.form),
                            .columns = columns};
    if (!columns || !slots) return ZR_NO_MEMORY;
    find_slots(plan, slots);
    for (reader.record = first; reader.record < plan->element->count; reader.record++) {
        if (reader.record % RECORDS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(file->cancel)) return ZR_CANCELLED;
        if (reader.is_text) zr_ply_skip_comments(file);
        const size_t line = file->line;
        if (!read_record(&reader, slots) || file->error->count >= ZR_ERROR_ITEMS) break;
        if (reader.is_text) note_lines(&reader, line);
    }
    if (zr_is_cancelled(file->cancel)) return ZR_CANCELLED;
    if (!zr_arena_ok(file->arena)) return ZR_NO_MEMORY;
    return file->error->count > 0 ? file->error->status : ZR_OK;
}
