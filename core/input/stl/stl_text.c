#include "input/stl/stl_file.h"

#include <stdio.h>

#include "input/text/parts.h"
#include "input/text/text.h"
#include "render_request.h"

/* The shortest text of a vertex, which bounds the vertices of a file. */
#define VERTEX_TEXT "vertex 0 0 0 "

/* Read in a fifth of a millisecond, about the time to wake a thread. */
#ifndef ZR_STL_PART_BYTES /* smaller in tests/unit/formats/test_stl_parts.c */
#define ZR_STL_PART_BYTES (1 << 17)
#endif

/* A part of the text. All but the first begin after a line that is only "endfacet": within a solid, between two
 * facets. If such a line belongs to a normal, the part before it has a fault. From the first part with a fault or an
 * oddity on, one thread reads the rest. */
struct part {
    size_t first;     /* number of its first vertex */
    size_t room;      /* upper bound of its vertices */
    size_t facets;    /* triangles read */
    size_t line_ends; /* line ends read */
    bool is_far;      /* a coordinate is beyond the limit */
    struct zr_box box;
};

/* Data of a file, shared by all threads. */
struct file {
    const struct zr_limits *limits;
    const struct zr_cancel *cancel;
    char line_end;
    size_t part_count;
    size_t room; /* vertices that the positions hold */
    const struct zr_part *texts;
    struct part *parts;
    zr_vec4 *positions;
    const double *origin; /* subtracted from positions; NULL: none */
    bool finds_box;
    struct part rest; /* read by one thread */
    struct zr_stl_notes notes;
};

/* ---- parts ---- */

/* Returns the next 'f' or 'F', or `end`. Numbers have none, so few other words are tested. */
static const char *find_f(const char *at, const char *end)
{
    for (; end - at >= ZR_CHUNK; at += ZR_CHUNK) {
        const size_t place = zr_chunk_first((zr_chunk)((zr_chunk_load(at) | ('a' - 'A')) == 'f'));
        if (place < ZR_CHUNK) return at + place;
    }
    while (at < end && zr_stl_lower(*at) != 'f')
        at++;
    return at;
}

static bool is_blank(char byte)
{
    return byte != '\n' && zr_stl_is_space(byte);
}

const char *zr_stl_cut(const char *at, size_t size, const char *end)
{
    static const char word[] = "endfacet";
    enum { SIZE = sizeof word - 1, F = 3 };
    for (const char *f = find_f(at + size, end); end - f > SIZE - F; f = find_f(f + 1, end)) {
        const char *begin = f - F, *behind = begin + SIZE;
        if (!zr_stl_is_word((struct zr_stl_word){begin, SIZE}, word)) continue;
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
        count += zr_stl_lower(*at) == letter;
    return count;
}

/* Bounds the number of vertices of a part by its letters x, one per "vertex", and by its length.
 * An x in a name only raises the bound. */
static bool make_room(void *context, size_t index)
{
    const struct file *file = context;
    const struct zr_part *text = &file->texts[index];
    const size_t most = (size_t)(text->end - text->at) / (sizeof VERTEX_TEXT - 1) + 1;
    const size_t vertices = count_letter(text->at, text->end, 'x');
    file->parts[index].room = vertices < most ? vertices : most;
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

static struct zr_stl_reader reader_of(const struct file *file, size_t index, struct zr_error *error)
{
    return (struct zr_stl_reader){.limits = file->limits,
                                  .cancel = file->cancel,
                                  .begin = file->texts[index].at,
                                  .at = file->texts[index].at,
                                  .end = file->texts[index].end,
                                  .line_end = file->line_end,
                                  .line = 1,
                                  .inside = index > 0,
                                  .positions = file->positions + file->parts[index].first,
                                  .origin = file->origin,
                                  .finds_box = file->finds_box,
                                  .box = zr_box_empty(),
                                  .error = error};
}

static bool read_part(void *context, size_t index)
{
    const struct file *file = context;
    struct zr_error error = {.count = 0};
    struct zr_stl_reader reader = reader_of(file, index, &error);
    reader.goes_on = index + 1 < file->part_count;
    reader.faults = 1;
    zr_stl_read_solids(&reader);
    file->parts[index].facets = reader.facets;
    file->parts[index].line_ends = reader.line - 1;
    file->parts[index].is_far = reader.is_far;
    file->parts[index].box = reader.box;
    return error.count == 0;
}

/* Closes the gaps that unused room left between parts; returns the number of triangles. */
static size_t close_gaps(struct file *file, size_t parts)
{
    size_t sum = 0;
    for (size_t i = 0; i < parts; i++) {
        const struct part *part = &file->parts[i];
        if (part->first != 3 * sum)
            memmove(file->positions + 3 * sum, file->positions + part->first,
                    3 * part->facets * sizeof *file->positions);
        sum += part->facets;
    }
    return sum;
}

/* Reads leniently from the part `index` on, up to the end of the text or ZR_ERROR_ITEMS faults. */
static void read_on(struct file *file, size_t index, struct zr_arena *arena, struct zr_stl *out, struct zr_error *error)
{
    struct zr_stl_reader reader = reader_of(file, index, error);
    reader.end = file->texts[file->part_count - 1].end;
    for (size_t i = 0; i < index; i++)
        reader.line += file->parts[i].line_ends;
    reader.before = close_gaps(file, index);
    reader.vertices_before = 3 * reader.before;
    reader.positions = file->positions + reader.vertices_before;
    reader.facets_most = file->room / 3;
    reader.arena = arena;
    reader.faults = ZR_ERROR_ITEMS;
    reader.notes = &file->notes;
    zr_stl_read_leniently(&reader);
    if (file->line_end == '\r') file->notes.of[ZR_STL_CR] = (struct zr_stl_note){.count = reader.line - 1, .line = 1};
    file->rest = (struct part){.is_far = reader.is_far, .box = reader.box};
    out->vertices = reader.vertices_before + reader.vertices;
    out->facets = reader.before + reader.facets;
    out->offsets = reader.offsets;
}

/* Reads all parts, then the rest leniently. *failed: the number of parts before the rest. */
static enum zr_status read_all(struct file *file, struct zr_scene_builder *builder, struct zr_stl *out, size_t *failed,
                               struct zr_error *error)
{
    *failed =
        file->line_end == '\r' ? 0 : zr_parts_read(builder->team, file->cancel, 0, file->part_count, read_part, file);
    *out = (struct zr_stl){.positions = file->positions};
    file->notes = (struct zr_stl_notes){0};
    file->rest = (struct part){.box = zr_box_empty()};
    if (*failed < file->part_count) {
        read_on(file, *failed, builder->arena, out, error);
    } else {
        out->facets = close_gaps(file, *failed);
        out->vertices = 3 * out->facets;
    }
    if (zr_is_cancelled(file->cancel)) return ZR_CANCELLED;
    if (error->count > 0) return error->status;
    return zr_arena_ok(builder->arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* If the mesh is far from 0 (recenter.h), reads twice more: for the bounds, and with their middle subtracted. */
static enum zr_status adjust(struct file *file, struct zr_scene_builder *builder, struct zr_stl *out, size_t failed,
                             struct zr_error *error)
{
    bool is_far = file->rest.is_far || zr_recenter_is_remote(file->positions, out->vertices);
    for (size_t i = 0; i < failed; i++)
        is_far = is_far || file->parts[i].is_far;
    if (!is_far) return ZR_OK;
    file->finds_box = true;
    enum zr_status status = read_all(file, builder, out, &failed, error);
    struct zr_box box = file->rest.box;
    for (size_t i = 0; i < failed; i++)
        zr_box_join(&box, &file->parts[i].box);
    file->finds_box = false;
    if (status == ZR_OK) status = zr_recenter_origin(builder->arena, &box, file->limits, &file->origin, error);
    if (status == ZR_OK) status = read_all(file, builder, out, &failed, error);
    builder->scene->origin = file->origin;
    return status;
}

/* ---- warnings ---- */

static const struct {
    const char *one, *many; /* "1 comment line", "2 comment lines" */
    const char *what;
} oddities[ZR_STL_ODDITIES] = {
    [ZR_STL_CR] = {"line", "lines", "that end in CR alone"},
    [ZR_STL_COMMENT] = {"comment line", "comment lines", "ignored"},
    [ZR_STL_COLOR] = {"colour line", "colour lines", "ignored"},
    [ZR_STL_UNKNOWN] = {"unknown line", "unknown lines", "ignored"},
    [ZR_STL_WORDS] = {"line", "lines", "with words that are ignored"},
    [ZR_STL_SPLIT_END] = {"keyword", "keywords", "in two words"},
    [ZR_STL_NO_NORMAL] = {"facet", "facets", "without a normal of three numbers"},
    [ZR_STL_POLYGON] = {"facet", "facets", "of more than three corners"},
    [ZR_STL_NO_SOLID] = {"solid", "solids", "without 'solid'"},
    [ZR_STL_NO_END] = {"solid", "solids", "without 'endsolid'"},
    [ZR_STL_HOLE] = {"triangle", "triangles", "not finite and left out"},
};

static void warn(const struct zr_stl_notes *notes, struct zr_scene_builder *builder)
{
    for (int i = 0; i < ZR_STL_ODDITIES; i++) {
        const struct zr_stl_note *note = &notes->of[i];
        if (note->count == 0) continue;
        const struct zr_quote quote = zr_quote(note->at ? note->at : "", note->size);
        zr_warning_list_add(builder->arena, &builder->warnings, "STL: %zu %s %s, %sline %zu%s%s", note->count,
                            note->count == 1 ? oddities[i].one : oddities[i].many, oddities[i].what,
                            note->count == 1 ? "" : "the first in ", note->line, note->size ? ": " : "",
                            note->size ? quote.text : "");
    }
}

/* ---- the whole ---- */

/* Returns the line end: '\r' if the first line and most others end in CR alone, else '\n'. */
static char find_line_end(const char *at, const char *end)
{
    enum { BYTES = 4096 };
    size_t feeds = 0, returns = 0;
    if (end - at > BYTES) end = at + BYTES;
    while (at < end && zr_stl_is_space(*at))
        at++;
    for (; at < end && (feeds == 0 || returns > 0); at++) {
        feeds += *at == '\n';
        returns += *at == '\r' && at + 1 < end && at[1] != '\n' && at[1] != '\r';
    }
    return returns > feeds ? '\r' : '\n';
}

/* Accepts comments before "solid". */
bool zr_stl_is_text(const char *bytes, size_t size)
{
    const size_t mark = zr_byte_order_mark(bytes, size);
    const char *begin = bytes + mark, *end = bytes + (size < ZR_BLANKS_MAX ? size : ZR_BLANKS_MAX);
    struct zr_stl_reader reader = {.begin = begin, .at = begin, .end = end, .line_end = find_line_end(begin, end)};
    for (;;) {
        const struct zr_stl_word word = zr_stl_next(&reader);
        if (word.size == 0 || !zr_stl_begins_comment(word)) return zr_stl_is_word(word, "solid");
        zr_stl_skip_line(&reader);
    }
}

enum zr_status zr_stl_text_read(struct zr_scene_builder *builder, const struct zr_request *request,
                                const struct zr_limits *limits, struct zr_stl *out, struct zr_error *error)
{
    struct zr_arena *arena = builder->arena;
    struct zr_team *team = builder->team;
    const char *begin = request->bytes + zr_byte_order_mark(request->bytes, request->size),
               *end = request->bytes + request->size;
    struct file file = {.limits = limits, .cancel = request->cancel, .line_end = find_line_end(begin, end)};
    file.texts = zr_parts_cut(arena, begin, end, ZR_STL_PART_BYTES, zr_stl_cut, &file.part_count);
    file.parts = zr_arena_zero(arena, file.part_count, sizeof *file.parts);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    if (zr_parts_read(team, file.cancel, 0, file.part_count, make_room, &file) < file.part_count) return ZR_CANCELLED;
    file.room = add_up(&file);
    if (file.room / 3 > ZR_STL_TRIANGLES_MAX)
        return zr_error_add(error, ZR_BAD_SCENE, NULL, "%zu triangles, more than the limit of %d", file.room / 3,
                            ZR_STL_TRIANGLES_MAX);
    file.positions = zr_arena_alloc(arena, file.room, sizeof *file.positions);
    if (!file.positions) return ZR_NO_MEMORY;
    size_t failed;
    enum zr_status status = read_all(&file, builder, out, &failed, error);
    if (status == ZR_OK) status = adjust(&file, builder, out, failed, error);
    warn(&file.notes, builder);
    return status;
}
