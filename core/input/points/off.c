/* Reads OFF, the object file format of Geomview: OFF, COFF, NOFF, STOFF and their combinations, as text. Each vertex and
 * each face begins a line, and may continue on the next ones. Source: "Geomview Manual 1.9", section 4.2.5. */
#include <math.h>
#include <string.h>

#include "base/cancel.h"
#include "input/formats/input.h"
#include "input/points/points_file.h"
#include "input/text/text.h"
#include "render_request.h"

enum { NUMBERS_MAX = 16, LINES_PER_CANCEL_CHECK = 1 << 12, CORNERS_MAX = 1 << 20 };

struct off {
    struct zr_points points;
    struct zr_points_text text;
    bool has_normals, has_colors, has_texcoords;
    size_t vertices, faces; /* by the counts */
    uint32_t *offsets, *indices;
    size_t face_count, corner_count, corner_room;
    zr_vec4 *face_colors; /* NULL until a face has one */
    size_t small_faces, mapped_faces, hole_faces;
};

/* ---- header ---- */

/* Reads the keyword at the start of a line, in which numbers may follow it. False if it is none. */
static bool read_keyword(struct off *off, struct zr_points_line *line)
{
    struct zr_points_line rest = *line;
    const size_t left = (size_t)(rest.end - rest.at);
    if (left >= 2 && memcmp(rest.at, "ST", 2) == 0) {
        off->has_texcoords = true;
        rest.at += 2;
    }
    if (rest.at < rest.end && *rest.at == 'C') {
        off->has_colors = true;
        rest.at++;
    }
    if (rest.at < rest.end && *rest.at == 'N') {
        off->has_normals = true;
        rest.at++;
    }
    if (rest.end - rest.at < 3 || memcmp(rest.at, "OFF", 3) != 0) return false;
    rest.at += 3; /* the counts may follow without a blank, as in ModelNet */
    if (rest.at < rest.end && ((*rest.at | 32) >= 'a' && (*rest.at | 32) <= 'z')) return false;
    *line = rest;
    return true;
}

static enum zr_status read_header(struct off *off)
{
    struct zr_points *points = &off->points;
    struct zr_points_line line;
    double counts[3] = {0};
    if (!zr_points_next(&off->text, &line) || !read_keyword(off, &line))
        return zr_error_add(points->error, ZR_BAD_SYNTAX, NULL,
                            "the first line is not OFF, COFF, NOFF, CNOFF, STOFF or another of three dimensions");
    struct zr_points_line word = line;
    word = zr_points_word(&word);
    if (zr_points_is(&word, "BINARY"))
        return zr_error_add(points->error, ZR_BAD_SYNTAX, NULL,
                            "binary OFF is not read in this version; OFF of text is");
    if (word.at == word.end && !zr_points_next(&off->text, &line))
        line = (struct zr_points_line){off->text.end, off->text.end};
    const int count = zr_points_numbers(&line, counts, 3);
    if (count < 2 || !(counts[0] >= 0 && counts[0] <= ZR_POINTS_MAX) || !(counts[1] >= 0 && counts[1] <= ZR_POINTS_MAX))
        return zr_points_fault(points, off->text.line, "the numbers of vertices and of faces are needed");
    off->vertices = (size_t)counts[0];
    off->faces = (size_t)counts[1];
    const size_t left = (size_t)(off->text.end - off->text.at);
    if (off->vertices > left / 5 || off->faces > left / 2)
        return zr_error_add(points->error, ZR_BAD_SYNTAX, NULL,
                            "the file is cut: %zu vertices and %zu faces by line %zu, and %zu bytes are left",
                            off->vertices, off->faces, off->text.line, left);
    return ZR_OK;
}

/* Reads `least` to `most` numbers of a line. Fewer than a position continue on the next lines, the last of which ends
 * behind the number `least`. Returns their count; less than `least` if it is none of these. */
static int read_numbers(struct off *off, struct zr_points_line *line, double *out, int least, int most)
{
    int count = zr_points_numbers(line, out, most);
    if (count < 0 || count >= 3) return count;
    const int begun = count;
    while (count < least && zr_points_next(&off->text, line)) {
        const int more = zr_points_numbers(line, out + count, least - count);
        if (more < 0 || (count + more == least && line->at < line->end)) return begun;
        count += more;
    }
    return count < least ? begun : count;
}

/* ---- vertices ---- */

static enum zr_status read_vertex(struct off *off, size_t number)
{
    struct zr_points *points = &off->points;
    struct zr_points_line line;
    double v[NUMBERS_MAX];
    if (!zr_points_next(&off->text, &line))
        return zr_error_add(points->error, ZR_BAD_SYNTAX, NULL, "the file is cut: %zu of %zu vertices are there",
                            number, off->vertices);
    const int color = off->has_normals ? 6 : 3, least = color + (off->has_colors ? 3 : 0);
    const size_t begin = off->text.line;
    const int count = read_numbers(off, &line, v, least, NUMBERS_MAX);
    if (count < least) return zr_points_fault(points, begin, "vertex %zu needs %d numbers", number, least);
    zr_points_add(points, v);
    if (off->has_normals && isfinite(v[3] + v[4] + v[5]))
        points->normals[number] = (zr_vec3){(float)v[3], (float)v[4], (float)v[5]};
    else if (off->has_normals)
        points->normals[number] = (zr_vec3){0, 0, 0}; /* computed */
    if (!off->has_colors) return ZR_OK;
    const int parts = count - color - (off->has_texcoords ? 2 : 0);
    points->colors[number] =
        (zr_vec4){(float)v[color], (float)v[color + 1], (float)v[color + 2], parts > 3 ? (float)v[color + 3] : 1.0f};
    return ZR_OK;
}

/* A plain OFF file has colours, too, if its first vertex has 6 or 7 numbers, as some programs write. */
static void look_for_colors(struct off *off)
{
    struct zr_points_text text = off->text;
    struct zr_points_line line;
    double v[NUMBERS_MAX];
    if (off->has_normals || off->has_colors || off->has_texcoords || !zr_points_next(&text, &line)) return;
    const int count = zr_points_numbers(&line, v, NUMBERS_MAX);
    off->has_colors = count == 6 || count == 7;
}

static enum zr_status read_vertices(struct off *off)
{
    struct zr_points *points = &off->points;
    look_for_colors(off);
    points->has_colors = off->has_colors;
    points->has_normals = off->has_normals;
    if (!zr_points_reserve(points, off->vertices)) return ZR_NO_MEMORY;
    for (size_t i = 0; i < off->vertices; i++) {
        if (i % LINES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(points->cancel)) return ZR_CANCELLED;
        const enum zr_status status = read_vertex(off, i);
        if (status != ZR_OK) return status;
    }
    if (points->colors) zr_points_scale_colors(points->colors, points->count, 0.0f);
    return ZR_OK;
}

/* ---- faces ---- */

static bool grow_corners(struct off *off, size_t more)
{
    struct zr_arena *arena = off->points.builder->arena;
    const size_t needed = off->corner_count + more,
                 room = needed > 2 * off->corner_room ? needed : 2 * off->corner_room;
    if (needed <= off->corner_room) return true;
    off->indices = zr_arena_grow(arena, off->indices, off->corner_count, room, sizeof *off->indices);
    off->corner_room = room;
    return off->indices;
}

/* Reads the colour behind the corners: three or four numbers; one is an index into a colour map. */
static bool read_color(struct off *off, struct zr_points_line *line)
{
    double v[4] = {0, 0, 0, 1};
    const int count = zr_points_numbers(line, v, 4);
    off->mapped_faces += count == 1;
    if (count < 3) return true;
    if (!off->face_colors) {
        off->face_colors = zr_arena_alloc(off->points.builder->arena, off->faces, sizeof *off->face_colors);
        for (size_t i = 0; off->face_colors && i < off->face_count; i++)
            off->face_colors[i] = (zr_vec4){.x = ZR_POINTS_NO_COLOR};
    }
    if (!off->face_colors) return false;
    off->face_colors[off->face_count] =
        (zr_vec4){(float)v[0], (float)v[1], (float)v[2], count > 3 ? (float)v[3] : 1.0f};
    return true;
}

/* Reads the corners of a face, up to the last one on its line or on the next lines, where nothing follows it. Sets
 * *has_hole if one is not finite. */
static enum zr_status read_corners(struct off *off, struct zr_points_line *line, size_t face, size_t corners,
                                   bool *has_hole)
{
    struct zr_points *points = &off->points;
    const size_t begin = off->text.line;
    size_t begun = corners; /* those on the first line */
    for (size_t k = 0; k < corners; k++) {
        double index;
        const bool goes_on = line->at == line->end;
        if (goes_on && begun == corners) begun = k;
        if ((goes_on && !zr_points_next(&off->text, line)) || zr_points_numbers(line, &index, 1) != 1 ||
            (begun < corners && k + 1 == corners && line->at < line->end))
            return zr_points_fault(points, begin, "face %zu has %zu of %zu corners", face, k < begun ? k : begun,
                                   corners);
        if (!(index >= 0 && index < (double)points->count) || index != floor(index))
            return zr_points_fault(points, off->text.line, "face %zu names vertex %g, but there are %zu, from 0 on",
                                   face, index, points->count);
        *has_hole = *has_hole || isnan(points->positions[(size_t)index][0]);
        off->indices[off->corner_count + k] = (uint32_t)index;
    }
    return ZR_OK;
}

static enum zr_status read_face(struct off *off, size_t face)
{
    struct zr_points *points = &off->points;
    struct zr_points_line line;
    double corners;
    bool has_hole = false;
    if (!zr_points_next(&off->text, &line))
        return zr_error_add(points->error, ZR_BAD_SYNTAX, NULL, "the file is cut: %zu of %zu faces are there", face,
                            off->faces);
    if (zr_points_numbers(&line, &corners, 1) != 1 || !(corners >= 0 && corners <= CORNERS_MAX) ||
        corners != floor(corners))
        return zr_points_fault(points, off->text.line, "face %zu does not begin with a number of corners", face);
    if (!grow_corners(off, (size_t)corners)) return ZR_NO_MEMORY;
    const enum zr_status status = read_corners(off, &line, face, (size_t)corners, &has_hole);
    if (status != ZR_OK) return status;
    off->small_faces += corners < 3;
    off->hole_faces += corners >= 3 && has_hole;
    if (corners < 3 || has_hole) return ZR_OK;
    if (off->face_colors) off->face_colors[off->face_count] = (zr_vec4){.x = ZR_POINTS_NO_COLOR};
    if (!read_color(off, &line)) return ZR_NO_MEMORY;
    off->corner_count += (size_t)corners;
    off->offsets[++off->face_count] = (uint32_t)off->corner_count;
    return ZR_OK;
}

static enum zr_status read_faces(struct off *off)
{
    struct zr_points *points = &off->points;
    off->offsets = zr_arena_alloc(points->builder->arena, off->faces + 1, sizeof *off->offsets);
    if (!off->offsets || !grow_corners(off, 3 * off->faces + 1)) return ZR_NO_MEMORY;
    off->offsets[0] = 0;
    for (size_t i = 0; i < off->faces; i++) {
        if (i % LINES_PER_CANCEL_CHECK == 0 && zr_is_cancelled(points->cancel)) return ZR_CANCELLED;
        const enum zr_status status = read_face(off, i);
        if (status != ZR_OK) return status;
    }
    if (off->face_colors) zr_points_scale_colors(off->face_colors, off->face_count, 0.0f);
    return ZR_OK;
}

/* ---- all ---- */

static void warn(struct off *off, bool is_of_color, size_t count, const char *one, const char *many)
{
    struct zr_scene_builder *builder = off->points.builder;
    if (count > 0)
        zr_warning_list_add(builder->arena, is_of_color ? &builder->color_warnings : &builder->warnings, "OFF: %zu %s",
                            count, count == 1 ? one : many);
}

static enum zr_status draw_faces(struct off *off, struct zr_mesh *mesh)
{
    struct zr_points *points = &off->points;
    if (!mesh) return points->error->count > 0 ? points->error->status : ZR_NO_MEMORY;
    mesh->face_count = (uint32_t)off->face_count;
    mesh->face_offsets = off->offsets;
    mesh->indices = off->indices;
    if (off->face_colors && !mesh->colors) mesh->face_colors = off->face_colors;
    if (points->normals) {
        mesh->normals = points->normals;
        mesh->normal_count = mesh->position_count;
        zr_scene_builder_note_normals(points->builder, 0, points->normals, points->count);
    }
    return ZR_OK;
}

bool zr_looks_so_OFF(const char *bytes, size_t size)
{
    struct off off = {.faces = 0};
    struct zr_points_text text = {.at = bytes, .end = bytes + (size < ZR_BLANKS_MAX ? size : ZR_BLANKS_MAX)};
    struct zr_points_line line;
    return zr_points_next(&text, &line) && read_keyword(&off, &line);
}

enum zr_status zr_read_OFF(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    struct off off = {.points = zr_points_open(builder, request->cancel, limits, error, "OFF"),
                      .text = {.at = request->bytes, .end = request->bytes + request->size, .cancel = request->cancel}};
    enum zr_status status = read_header(&off);
    if (status == ZR_OK) status = read_vertices(&off);
    if (status == ZR_OK) status = read_faces(&off);
    if (status != ZR_OK) return zr_points_status(&off.points, status);
    warn(&off, false, off.small_faces, "face has fewer than 3 corners and is left out",
         "faces have fewer than 3 corners and are left out");
    warn(&off, false, off.hole_faces, "face at a vertex that is not finite is left out",
         "faces at vertices that are not finite are left out");
    warn(&off, true, off.mapped_faces, "face has an index into a colour map, which is not read",
         "faces have indices into a colour map, which is not read");
    struct zr_mesh *mesh = zr_points_make(&off.points);
    return off.face_count > 0 ? draw_faces(&off, mesh) : zr_points_draw(&off.points, mesh);
}
