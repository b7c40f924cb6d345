/* Reads Wavefront OBJ (obj_text.h): faces, lines, points, normals, colours and smoothing groups.
 *
 * All threads read the parts of the text twice. The first pass counts: arrays get their sizes, each part its first
 * numbers, and an index can be checked before its vertex is read. The second pass reads. From the first part with a
 * fault on, one thread reads again and reports, so that faults come in the order of the text. Two kinds of files are
 * read a third time: with coordinates far from the origin, or with colours of 0 to 255. Without faces, lines and
 * points, all vertices are points, unless the file has unknown lines. */
#include "input/formats/input.h"

#include "input/obj/mtl.h"
#include "input/obj/obj_file.h"
#include "input/text/text.h"
#include "render_request.h"
#include "scene/unused_positions.h"

/* Counted and read in a fifth of a millisecond, about the time to wake a thread. */
#ifndef ZR_OBJ_PART_BYTES /* smaller in tests/unit/formats/test_obj_parts.c */
#define ZR_OBJ_PART_BYTES (1 << 16)
#endif

/* A larger colour component means that the range is 0 to 255. Components from 1 to this are clamped to 1. */
#define COLOR_CLAMPED 2.0f

struct parsing {
    struct zr_scene_builder *builder;
    const struct zr_request *request;
    struct zr_error *error;
    struct zr_obj_file file;
};

/* ---- the passes ---- */

static enum zr_status count(struct parsing *parsing)
{
    struct zr_obj_file *file = &parsing->file;
    struct zr_arena *arena = parsing->builder->arena;
    file->texts = zr_parts_cut(arena, file->at, file->end, ZR_OBJ_PART_BYTES, zr_obj_cut, &file->part_count);
    file->parts = zr_arena_zero(arena, file->part_count, sizeof *file->parts);
    if (!zr_arena_ok(arena)) return ZR_NO_MEMORY;
    const struct zr_cancel *cancel = parsing->request->cancel;
    return zr_parts_read(parsing->builder->team, cancel, 0, file->part_count, zr_obj_count_part, file) <
                   file->part_count
               ? ZR_CANCELLED
               : ZR_OK;
}

/* Counts; if lines end in carriage returns alone, counts again in a copy with line feeds. */
static enum zr_status count_lines(struct parsing *parsing)
{
    struct zr_obj_file *file = &parsing->file;
    enum zr_status status = count(parsing);
    size_t returns = 0;
    for (size_t i = 0; status == ZR_OK && i < file->part_count; i++)
        returns += file->parts[i].returns;
    if (status != ZR_OK || returns == 0) return status;
    const size_t size = (size_t)(file->end - file->at);
    char *copy = zr_arena_copy(parsing->builder->arena, file->at, size);
    if (!copy) return ZR_NO_MEMORY;
    zr_obj_replace_returns(copy, copy + size);
    file->at = copy;
    file->end = copy + size;
    status = count(parsing);
    if (status == ZR_OK) file->parts[0].notes[ZR_OBJ_NOTE_RETURNS].count = returns;
    return status;
}

static bool read_part(void *context, size_t index)
{
    struct zr_error error = {.count = 0};
    return zr_obj_read_part(context, index, 1, &error);
}

static enum zr_status read_all(struct parsing *parsing)
{
    struct zr_obj_file *file = &parsing->file;
    const struct zr_cancel *cancel = parsing->request->cancel;
    size_t part = zr_parts_read(parsing->builder->team, cancel, 0, file->part_count, read_part, file);
    while (part < file->part_count && !zr_is_cancelled(cancel) &&
           zr_obj_read_part(file, part, ZR_ERROR_ITEMS, parsing->error))
        part++;
    if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
    return parsing->error->count > 0 ? parsing->error->status : ZR_OK;
}

/* ---- arrays ---- */

/* Allocates one element more than `count`. Returns NULL if `count` is 0. */
static void *allocate_some(struct zr_arena *arena, size_t count, size_t size)
{
    return count > 0 ? zr_arena_alloc(arena, count + 1, size) : NULL;
}

static bool allocate(struct zr_obj_file *file, struct zr_arena *arena)
{
    const struct zr_obj_counts *total = &file->total;
    file->positions = zr_arena_alloc(arena, total->positions, sizeof *file->positions);
    if (file->has_colors) file->colors = zr_arena_alloc(arena, total->positions, sizeof *file->colors);
    file->normals = zr_arena_alloc(arena, total->normals + 1, sizeof *file->normals);
    file->face_offsets = zr_arena_alloc(arena, total->faces + 1, sizeof *file->face_offsets);
    file->indices = zr_arena_alloc(arena, total->corners, sizeof *file->indices);
    if (total->normals > 0) file->normal_indices = zr_arena_alloc(arena, total->corners, sizeof *file->normal_indices);
    if (file->has_groups) file->groups = allocate_some(arena, total->faces, sizeof *file->groups);
    file->names = zr_arena_alloc(arena, total->names, sizeof *file->names);
    if (file->mtl && zr_mtl_has_maps(file->mtl) && total->texcoords > 0) {
        file->texcoords = zr_arena_alloc(arena, total->texcoords, sizeof *file->texcoords);
        file->texcoord_indices = zr_arena_alloc(arena, total->corners, sizeof *file->texcoord_indices);
    }
    file->lines = allocate_some(arena, total->segments, 2 * sizeof *file->lines);
    file->is_cloud = total->faces + total->segments + total->points == 0 && !zr_obj_first_unknown(file);
    const size_t points = file->is_cloud ? total->positions : total->points;
    file->points = zr_arena_alloc(arena, points + 1, sizeof *file->points);
    for (size_t i = 0; file->is_cloud && file->points && i < points; i++)
        file->points[i] = (uint32_t)i;
    return zr_arena_ok(arena);
}

/* Corners without a normal share one zero normal, whose value is computed later. Returns the number of normals. */
static uint32_t finish_normals(struct zr_obj_file *file)
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
        if (file->normal_indices[i] == ZR_OBJ_NO_NORMAL) file->normal_indices[i] = count;
    return count + 1;
}

/* Closes the gaps that wrong statements leave in a list. Returns its length. */
static size_t close_gaps(const struct zr_obj_file *file, bool of_lines)
{
    size_t sum = 0;
    for (size_t i = 0; i < file->part_count; i++) {
        const struct zr_obj_part *part = &file->parts[i];
        const size_t first = of_lines ? part->before.segments : part->before.points;
        const size_t count = of_lines ? part->segments : part->points, words = of_lines ? 2 : 1;
        uint32_t *list = of_lines ? file->lines : file->points;
        if (first != sum && count > 0) memmove(list + words * sum, list + words * first, words * count * sizeof *list);
        sum += count;
    }
    return sum;
}

/* ---- the mesh ---- */

static bool has_holes(const struct zr_obj_file *file)
{
    for (size_t i = 0; i < file->part_count; i++)
        if (file->parts[i].notes[ZR_OBJ_NOTE_HOLES].count > 0) return true;
    return false;
}

static void fill(struct zr_obj_file *file, struct zr_mesh *mesh)
{
    const struct zr_obj_counts *total = &file->total;
    file->face_offsets[total->faces] = (uint32_t)total->corners;
    const uint32_t normals = finish_normals(file);
    *mesh = (struct zr_mesh){.name = "",
                             .position_count = (uint32_t)total->positions,
                             .positions = file->positions,
                             .face_count = (uint32_t)total->faces,
                             .face_offsets = file->face_offsets,
                             .indices = file->indices,
                             .line_count = (uint32_t)close_gaps(file, true),
                             .lines = file->lines,
                             .point_count = (uint32_t)close_gaps(file, false),
                             .points = file->points,
                             .normal_count = normals,
                             .normals = normals ? file->normals : NULL,
                             .normal_indices = normals ? file->normal_indices : NULL,
                             .face_groups = normals ? NULL : file->groups,
                             .colors = file->colors};
    if (file->is_cloud) mesh->point_count = mesh->position_count;
    if (mesh->point_count == 0) mesh->points = NULL;
    if (has_holes(file)) zr_obj_drop_holes(file, mesh);
}

/* Refuses a file without geometry. If it has unknown lines, the message quotes the first one. */
static enum zr_status refuse_empty(struct parsing *parsing)
{
    const struct zr_obj_statement *unknown = zr_obj_first_unknown(&parsing->file);
    if (has_holes(&parsing->file))
        return zr_error_add(parsing->error, ZR_BAD_SCENE, NULL,
                            "no geometry: all that the OBJ file draws is at vertices that are not finite");
    if (!unknown)
        return zr_error_add(parsing->error, ZR_BAD_SCENE, NULL,
                            "no geometry: the OBJ file has no face (f), line (l), point (p) or vertex (v)");
    struct zr_obj_statement rest = *unknown;
    const struct zr_obj_statement word = zr_obj_word(&rest);
    return zr_error_add(parsing->error, ZR_BAD_SYNTAX, NULL, "line %zu: expected a statement of OBJ, found %s",
                        word.line, zr_quote(word.at, (size_t)(word.end - word.at)).text);
}

/* Computes the origin of a mesh that is far from 0: the middle of the positions that are drawn. */
static enum zr_status find_origin(struct parsing *parsing, const struct zr_limits *limits, const struct zr_mesh *mesh)
{
    struct zr_obj_file *file = &parsing->file;
    struct zr_arena *arena = parsing->builder->arena;
    file->used = zr_used_positions(arena, parsing->builder->team, mesh);
    if (!file->used) return ZR_NO_MEMORY;
    const enum zr_status status = read_all(parsing);
    if (status != ZR_OK) return status;
    file->used = NULL;
    struct zr_box box = zr_box_empty();
    for (size_t i = 0; i < file->part_count; i++)
        zr_box_join(&box, &file->parts[i].box);
    return zr_recenter_origin(arena, &box, limits, &file->origin, parsing->error);
}

/* Reads again if the coordinates are far from 0 or the range of colours is 0 to 255. */
static enum zr_status adjust(struct parsing *parsing, const struct zr_limits *limits, struct zr_mesh *mesh)
{
    struct zr_obj_file *file = &parsing->file;
    bool is_far = zr_recenter_is_remote(file->positions, file->total.positions), is_bytes = false;
    for (size_t i = 0; i < file->part_count; i++) {
        is_far = is_far || file->parts[i].is_far;
        is_bytes = is_bytes || file->parts[i].color_most > COLOR_CLAMPED;
    }
    if (!is_far && !is_bytes) return ZR_OK;
    if (is_bytes) file->color_scale = 255.0f;
    enum zr_status status = is_far ? find_origin(parsing, limits, mesh) : ZR_OK;
    if (status == ZR_OK) status = read_all(parsing);
    if (status == ZR_OK) fill(file, mesh);
    parsing->builder->scene->origin = file->origin;
    return status;
}

enum zr_status zr_read_OBJ(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    struct parsing parsing = {builder, request, error,
                              .file = {.at = request->bytes,
                                       .end = request->bytes + request->size,
                                       .limits = limits,
                                       .cancel = request->cancel,
                                       .color_scale = 1.0f}};
    struct zr_obj_file *file = &parsing.file;
    enum zr_status status = count_lines(&parsing);
    if (status != ZR_OK) return status;
    zr_obj_add_up(file);
    const struct zr_obj_counts *total = &file->total;
    if (total->positions > ZR_OBJ_COUNT_MAX || total->texcoords > ZR_OBJ_COUNT_MAX ||
        total->normals > ZR_OBJ_COUNT_MAX || total->corners > ZR_OBJ_COUNT_MAX || total->segments > ZR_OBJ_COUNT_MAX ||
        total->points > ZR_OBJ_COUNT_MAX)
        return zr_error_add(error, ZR_BAD_SCENE, NULL, "more than %d vertices, normals or corners", ZR_OBJ_COUNT_MAX);
    if ((status = zr_obj_open_materials(file, builder, request, error)) != ZR_OK) return status;
    if (!allocate(file, builder->arena)) return ZR_NO_MEMORY;
    if ((status = read_all(&parsing)) != ZR_OK) return status;
    struct zr_mesh *mesh = zr_scene_builder_meshes(builder, 1);
    if (!mesh) return ZR_NO_MEMORY;
    fill(file, mesh);
    if (mesh->face_count == 0 && mesh->line_count == 0 && mesh->point_count == 0) return refuse_empty(&parsing);
    if ((status = adjust(&parsing, limits, mesh)) != ZR_OK) return status;
    file->total.faces = mesh->face_count; /* without those at holes */
    if (mesh->normal_count) zr_scene_builder_note_normals(builder, 0, file->normals, total->normals);
    if ((status = zr_obj_name_faces(file, builder, mesh)) != ZR_OK) return status;
    zr_obj_warn(file, builder);
    if (file->mtl) zr_mtl_close(file->mtl);
    return zr_arena_ok(builder->arena) ? ZR_OK : ZR_NO_MEMORY;
}
