/* Faces of PLY: growing arrays, and binary triangles, which all threads read. */
#include "input/ply/ply_file.h"
#include "input/text/parts.h"

/* Read in a tenth of a millisecond. */
#ifndef ZR_PLY_PART_TRIANGLES /* smaller in tests/unit/formats/test_ply_parts.c */
#define ZR_PLY_PART_TRIANGLES (1 << 14)
#endif

/* ---- arrays ---- */

static size_t grown(size_t room, size_t wanted)
{
    return wanted > 2 * room ? wanted : 2 * room;
}

static bool reserve_faces(struct zr_ply_file *file, size_t wanted)
{
    struct zr_ply_faces *faces = &file->faces;
    if (!faces->offsets || wanted > faces->room) {
        const size_t room = wanted > faces->room ? grown(faces->room, wanted) : faces->room;
        const size_t old = faces->offsets ? faces->count + 1 : 0;
        faces->offsets = zr_arena_grow(file->arena, faces->offsets, old, room + 1, sizeof *faces->offsets);
        if (!faces->offsets) return false;
        for (size_t i = old; i <= faces->count; i++)
            faces->offsets[i] = (uint32_t)(3 * i);
    }
    if (file->faces_have_colors && (!faces->colors || wanted > faces->room)) {
        faces->colors =
            zr_arena_grow(file->arena, faces->colors, faces->count, grown(faces->room, wanted), sizeof *faces->colors);
        if (!faces->colors) return false;
    }
    if (wanted > faces->room) faces->room = grown(faces->room, wanted);
    return true;
}

bool zr_ply_faces_reserve(struct zr_ply_file *file, size_t more_faces, size_t more_corners)
{
    struct zr_ply_faces *faces = &file->faces;
    const size_t corners = faces->corner_count + more_corners;
    if (corners > ZR_PLY_COUNT_MAX || faces->count + more_faces > ZR_PLY_COUNT_MAX) {
        zr_error_add(file->error, ZR_BAD_SCENE, NULL, "more than %d corners", ZR_PLY_COUNT_MAX);
        return false;
    }
    if (!reserve_faces(file, faces->count + more_faces)) return false;
    if (corners > faces->corner_room) {
        const size_t room = grown(faces->corner_room, corners);
        faces->indices = zr_arena_grow(file->arena, faces->indices, faces->corner_count, room, sizeof *faces->indices);
        if (!faces->indices) return false;
        faces->corner_room = room;
    }
    return true;
}

bool zr_ply_faces_end(struct zr_ply_file *file, const zr_vec4 *color)
{
    struct zr_ply_faces *faces = &file->faces;
    if (!zr_ply_faces_reserve(file, 1, 0)) return false;
    if (file->faces_have_colors) faces->colors[faces->count] = color ? *color : (zr_vec4){1, 1, 1, 1};
    faces->offsets[++faces->count] = (uint32_t)faces->corner_count;
    return true;
}

/* ---- triangles ---- */

struct reading {
    struct zr_ply_file *file;
    const struct zr_ply_plan *plan;
    const char *records;
    size_t count;
    size_t stride;  /* of a record with three corners */
    size_t list_at; /* offset of the list in a record */
    bool is_swapped;
};

/* Reads three indices per record. False if a list has another length or an index is too large. */
ZR_INLINED bool read_indices(const struct reading *reading, size_t begin, size_t end, bool is_swapped)
{
    const char *at = reading->records + begin * reading->stride + reading->list_at;
    const size_t stride = reading->stride, vertices = reading->file->vertex_count;
    uint32_t *out = reading->file->faces.indices + 3 * begin;
    for (size_t i = begin; i < end; i++, at += stride, out += 3) {
        const uint32_t a = zr_ply_word32(at + 1, is_swapped), b = zr_ply_word32(at + 5, is_swapped),
                       c = zr_ply_word32(at + 9, is_swapped);
        if (*at != 3 || a >= vertices || b >= vertices || c >= vertices) return false;
        out[0] = a;
        out[1] = b;
        out[2] = c;
    }
    return true;
}

static void read_colors(const struct reading *reading, size_t begin, size_t end)
{
    struct zr_ply_columns columns;
    for (size_t first = begin; first < end; first += ZR_PLY_BLOCK) {
        const size_t count = end - first < ZR_PLY_BLOCK ? end - first : ZR_PLY_BLOCK;
        for (int slot = ZR_PLY_RED; slot <= ZR_PLY_ALPHA; slot++) {
            const struct zr_ply_property *property = reading->plan->slots[slot];
            if (!property) continue;
            const bool is_behind = property > reading->plan->indices;
            const char *at = reading->records + first * reading->stride + property->offset + (is_behind ? 12 : 0);
            zr_ply_column(at, reading->stride, count, property->type, reading->is_swapped, columns.values[slot]);
        }
        zr_ply_store_colors(reading->file, reading->plan, &columns, count, reading->file->faces.colors + first);
    }
}

static bool read_part(void *context, size_t part)
{
    const struct reading *reading = context;
    const size_t begin = part * ZR_PLY_PART_TRIANGLES, left = reading->count - begin;
    const size_t end = begin + (left < ZR_PLY_PART_TRIANGLES ? left : ZR_PLY_PART_TRIANGLES);
    const bool is_good =
        reading->is_swapped ? read_indices(reading, begin, end, true) : read_indices(reading, begin, end, false);
    if (is_good && reading->file->faces.colors) read_colors(reading, begin, end);
    return is_good;
}

size_t zr_ply_read_triangles(struct zr_ply_file *file, const struct zr_ply_plan *plan)
{
    const struct zr_ply_element *element = plan->element;
    const struct zr_ply_property *list = plan->indices;
    struct zr_ply_faces *faces = &file->faces;
    struct reading reading = {.file = file,
                              .plan = plan,
                              .records = file->at,
                              .count = element->count,
                              .stride = element->least_bytes + 12,
                              .list_at = list->offset,
                              .is_swapped = zr_ply_is_swapped(file->header.form)};
    if (element->list_count != 1 || faces->count > 0 || zr_ply_type_bytes(list->count_type) != 1 ||
        (list->type != ZR_PLY_I32 && list->type != ZR_PLY_U32) ||
        element->count > (size_t)(file->end - file->at) / reading.stride)
        return 0;
    faces->room = element->count;
    faces->corner_room = 3 * element->count;
    faces->indices = zr_arena_alloc(file->arena, faces->corner_room, sizeof *faces->indices);
    if (file->faces_have_colors) faces->colors = zr_arena_alloc(file->arena, faces->room, sizeof *faces->colors);
    if (!zr_arena_ok(file->arena)) return 0;
    const size_t parts = (element->count + ZR_PLY_PART_TRIANGLES - 1) / ZR_PLY_PART_TRIANGLES;
    const size_t good = zr_parts_read(file->team, file->cancel, 0, parts, read_part, &reading);
    faces->count = good < parts ? good * ZR_PLY_PART_TRIANGLES : element->count;
    faces->corner_count = 3 * faces->count;
    file->at += faces->count * reading.stride;
    return faces->count;
}
