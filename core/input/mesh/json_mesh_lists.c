#include "input/json/json_array.h"
#include "input/json/json_list.h"
#include "input/json/json_number_rows.h"
#include "input/mesh/parsed_mesh.h"
#include "scene/texture.h"

/* Free slots of the index array before each face. A face with more corners than free slots goes through read_face. */
enum { CORNERS_AT_HAND = 64 };

/* Rows between two checks for cancellation. */
enum { ROWS_PER_CANCEL_CHECK = 1 << 16 };

/* ---- arrays ---- */

/* Reads the next value, a list or an array, into an array; `items` is not NULL from then on, even if the list
 * is empty. `limit`: the largest magnitude, or 0 for coordinates. */
static bool read_array(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_list *list,
                       struct zr_array_wanted wanted, float limit, struct zr_growing *array)
{
    if (zr_json_type(json) == ZR_JSON_OBJECT) {
        wanted.high = wanted.is_color ? 1.0 : (double)(limit > 0.0f ? limit : json->limits->coordinate_max);
        wanted.low = wanted.is_color ? 0.0 : -wanted.high;
        return zr_json_array_read(json, path, &wanted, array);
    }
    if (!zr_json_list(json, path) || !zr_growing_reserve(array, json, 1)) return false;
    const bool good = zr_json_list_read(json, path, list, array);
    zr_growing_trim(array, json->arena);
    return good;
}

static bool begin_array(struct zr_json *json, const void *state, void *part, double share)
{
    return zr_growing_begin_part(json, state, part, share, 1);
}

static bool join_array(struct zr_json *json, void *state, const void *part)
{
    return zr_growing_join(json, state, part);
}

/* The last arguments are shapes of arrays. zr_unused_positions_move changes positions. */
#define READER(name, read_items, limit, ...)                                                                           \
    bool name(struct zr_json *json, const struct zr_json_path *path, void *out)                                        \
    {                                                                                                                  \
        static const struct zr_json_list list = {'[', read_items, begin_array, join_array};                            \
        return read_array(json, path, &list, (struct zr_array_wanted){__VA_ARGS__}, limit, out);                       \
    }
READER(zr_read_mesh_positions, zr_rows_read_positions, 0, .least = 3, .most = 4, .is_changed = true, .is_place = true)
READER(zr_read_mesh_colors, zr_rows_read_colors, 0, .least = 3, .most = 4, .is_color = true)
READER(zr_read_mesh_normals, zr_rows_read_vec3s, 0, .least = 3, .most = 3)
READER(zr_read_mesh_texcoords, zr_rows_read_texcoords, ZR_TEXCOORD_MAX, .least = 2, .most = 2)
#undef READER

bool zr_read_mesh_tangents(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    static const struct zr_json_list list = {'[', zr_rows_read_tangents, begin_array, join_array};
    const struct zr_growing *array = out;
    const bool is_array = zr_json_type(json) == ZR_JSON_OBJECT;
    if (!read_array(json, path, &list, (struct zr_array_wanted){.least = 4, .most = 4}, 0, out)) return false;
    for (size_t i = 0; is_array && i < array->count; i++) {
        if (i % ROWS_PER_CANCEL_CHECK == 0) zr_json_look(json);
        if (zr_json_stops(json)) return false;
        zr_tangent_check(json, ZR_JSON_ITEM(path, i), (const zr_vec4 *)array->items + i);
    }
    return true;
}

/* ---- indices ---- */

static uint32_t known_positions(const struct zr_parsed_mesh *given)
{
    return given->positions.items ? (uint32_t)given->positions.count : UINT32_MAX;
}

/* Reads a face with full checks. */
static void read_face(struct zr_json *json, const struct zr_json_path *path, uint32_t positions,
                      struct zr_growing *indices)
{
    const size_t most = json->limits->polygon_vertices_max;
    size_t count = 0;
    uint32_t *corner;
    if (!zr_json_list(json, path)) return;
    for (zr_json_enter(json, '['); zr_json_item(json); count++) {
        if (count >= most) {
            zr_json_skip(json);
            continue;
        }
        if (!(corner = zr_growing_next(indices, json))) return;
        if (zr_json_index(json, ZR_JSON_ITEM(path, count), positions, "positions", corner)) indices->count++;
    }
    if (count < 3 || count > most)
        zr_json_fault(json, path, "a face of %zu corners; 3 to %zu are allowed", count, most);
}

static void read_face_items(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    struct zr_parsed_faces *faces = state;
    struct zr_growing *indices = &faces->indices, *ends = &faces->ends;
    const size_t most = json->limits->polygon_vertices_max;
    uint32_t *end;
    while (json->at < until && zr_json_item(json)) {
        if (!(end = zr_growing_next(ends, json)) || !zr_growing_reserve(indices, json, CORNERS_AT_HAND)) return;
        const size_t room = indices->room - indices->count;
        uint32_t *corners = (uint32_t *)indices->items + indices->count;
        size_t count = 0;
        const char *behind =
            zr_numbers_indices(json->at, json->end, faces->positions, most < room ? most : room, corners, &count);
        if (behind && count >= 3) {
            json->at = behind;
            indices->count += count;
        } else {
            read_face(json, ZR_JSON_ITEM(path, ends->count - 1), faces->positions, indices);
        }
        *end = (uint32_t)indices->count;
        ends->count++;
    }
}

static bool begin_faces(struct zr_json *json, const void *state, void *part, double share)
{
    const struct zr_parsed_faces *all = state;
    struct zr_parsed_faces *faces = part;
    faces->positions = all->positions;
    return zr_growing_begin_part(json, &all->ends, &faces->ends, share, 1) &&
           zr_growing_begin_part(json, &all->indices, &faces->indices, share, CORNERS_AT_HAND);
}

static bool join_faces(struct zr_json *json, void *state, const void *part)
{
    struct zr_parsed_faces *all = state;
    const struct zr_parsed_faces *faces = part;
    const uint32_t before = (uint32_t)all->indices.count, *from = faces->ends.items;
    if (!zr_growing_join(json, &all->indices, &faces->indices) ||
        !zr_growing_reserve(&all->ends, json, faces->ends.count))
        return false;
    uint32_t *to = (uint32_t *)all->ends.items + all->ends.count;
    for (size_t i = 0; i < faces->ends.count; i++)
        to[i] = before + from[i];
    all->ends.count += faces->ends.count;
    return true;
}

/* Reads an array of faces that all have as many corners. */
static bool read_face_array(struct zr_json *json, const struct zr_json_path *path, struct zr_parsed_faces *faces)
{
    const struct zr_array_wanted wanted = {
        .least = 3, .most = json->limits->polygon_vertices_max, .of = "positions", .end = faces->positions};
    struct zr_json_array array;
    if (!zr_json_array_open(json, path, &wanted, &array) ||
        !zr_json_array_indices(json, path, &array, &faces->indices) ||
        !zr_growing_reserve(&faces->ends, json, array.rows + 1))
        return false;
    uint32_t *ends = faces->ends.items, corners = (uint32_t)array.columns;
    for (size_t first = 0; first <= array.rows; first += ROWS_PER_CANCEL_CHECK) {
        const size_t left = array.rows + 1 - first, count = left < ROWS_PER_CANCEL_CHECK ? left : ROWS_PER_CANCEL_CHECK;
        for (size_t i = 0; i < count; i++)
            ends[first + i] = (uint32_t)(first + i) * corners;
        zr_json_look(json);
        if (zr_json_stops(json)) return false;
    }
    faces->ends.count = array.rows + 1;
    return true;
}

bool zr_read_mesh_faces(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    static const struct zr_json_list list = {'[', read_face_items, begin_faces, join_faces};
    struct zr_parsed_mesh *given = out;
    struct zr_parsed_faces *faces = &given->faces;
    uint32_t *first;
    faces->positions = known_positions(given);
    if (zr_json_type(json) == ZR_JSON_OBJECT) return read_face_array(json, path, faces);
    if (!zr_json_list(json, path) || !(first = zr_growing_next(&faces->ends, json))) return false;
    *first = 0;
    faces->ends.count = 1;
    const bool good = zr_json_list_read(json, path, &list, faces);
    zr_growing_trim(&faces->indices, json->arena);
    zr_growing_trim(&faces->ends, json->arena);
    zr_growing_trim(&faces->indices, json->arena);
    return good;
}

static void read_line(struct zr_json *json, const struct zr_json_path *path, uint32_t positions, uint32_t line[2])
{
    size_t ends = 0;
    if (!zr_json_list(json, path)) return;
    for (zr_json_enter(json, '['); zr_json_item(json); ends++) {
        if (ends < 2)
            zr_json_index(json, ZR_JSON_ITEM(path, ends), positions, "positions", &line[ends]);
        else
            zr_json_skip(json);
    }
    if (ends != 2) zr_json_fault(json, path, "a line of %zu ends; it has two", ends);
}

static void read_line_items(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    struct zr_parsed_lines *lines = state;
    struct zr_growing *ends = &lines->ends;
    uint32_t *line;
    while (json->at < until && zr_json_item(json) && (line = zr_growing_next(ends, json))) {
        size_t count = 0;
        const char *behind = zr_numbers_indices(json->at, json->end, lines->positions, 2, line, &count);
        if (behind && count == 2)
            json->at = behind;
        else
            read_line(json, ZR_JSON_ITEM(path, ends->count), lines->positions, line);
        ends->count++;
    }
}

static bool begin_lines(struct zr_json *json, const void *state, void *part, double share)
{
    const struct zr_parsed_lines *all = state;
    struct zr_parsed_lines *lines = part;
    lines->positions = all->positions;
    return zr_growing_begin_part(json, &all->ends, &lines->ends, share, 1);
}

static bool join_lines(struct zr_json *json, void *state, const void *part)
{
    return zr_growing_join(json, &((struct zr_parsed_lines *)state)->ends,
                           &((const struct zr_parsed_lines *)part)->ends);
}

/* Reads an array of lines or points: `columns` indices each. */
static bool read_index_array(struct zr_json *json, const struct zr_json_path *path, size_t columns, uint32_t positions,
                             struct zr_growing *indices)
{
    const struct zr_array_wanted wanted = {.least = columns, .most = columns, .of = "positions", .end = positions};
    struct zr_json_array array;
    return zr_json_array_open(json, path, &wanted, &array) && zr_json_array_indices(json, path, &array, indices);
}

bool zr_read_mesh_lines(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    static const struct zr_json_list list = {'[', read_line_items, begin_lines, join_lines};
    struct zr_parsed_mesh *given = out;
    given->lines.positions = known_positions(given);
    if (zr_json_type(json) == ZR_JSON_OBJECT)
        return read_index_array(json, path, 2, given->lines.positions, &given->lines.ends);
    if (!zr_json_list(json, path) || !zr_growing_reserve(&given->lines.ends, json, 1)) return false;
    const bool good = zr_json_list_read(json, path, &list, &given->lines);
    zr_growing_trim(&given->lines.ends, json->arena);
    return good;
}

bool zr_read_mesh_points(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_points *points = &((struct zr_parsed_mesh *)out)->points;
    struct zr_growing *indices = &points->indices;
    uint32_t *index;
    points->positions = known_positions(out);
    if (zr_json_type(json) == ZR_JSON_OBJECT) return read_index_array(json, path, 1, points->positions, indices);
    if (!zr_json_list(json, path) || !zr_growing_reserve(indices, json, 1)) return false;
    for (zr_json_enter(json, '['); zr_json_item(json) && (index = zr_growing_next(indices, json)); indices->count++)
        zr_json_index(json, ZR_JSON_ITEM(path, indices->count), points->positions, "positions", index);
    zr_growing_trim(indices, json->arena);
    return true;
}
