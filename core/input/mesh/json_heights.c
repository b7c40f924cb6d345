#include "input/mesh/parsed_mesh.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/checked.h"
#include "input/json/json_array.h"
#include "input/json/json_list.h"
#include "input/json/json_number_rows.h"
#include "input/scene/json_objects.h"

/* Four corners per cell are counted in 32 bits. */
enum { POSITIONS_MAX = INT32_MAX / 4 };

/* Values between two checks for cancellation. */
enum { VALUES_PER_CANCEL_CHECK = 1 << 16 };

/* ---- reading ---- */

/* Reads a number or null, a hole, in usual form. Returns the ',' or ']' after it, or NULL. */
static const char *read_plain(const char *at, const char *end, double limit, float *out)
{
    const char *behind = zr_numbers_next(at, end, -limit, limit, out);
    if (behind) return behind;
    at = zr_json_skip_space(at + 1, end);
    if (end - at < 4 || memcmp(at, "null", 4) != 0) return NULL;
    *out = NAN;
    at = zr_json_skip_space(at + 4, end);
    return at < end && (*at == ',' || *at == ']') ? at : NULL;
}

/* Reads values in usual form; true at the row's end. `json` is before the '['; on false it is at the '[' or ',' before
 * a value in another form. */
static bool read_plain_row(struct zr_json *json, struct zr_heights *heights, size_t *count)
{
    const double limit = (double)json->limits->coordinate_max;
    const char *at = json->at, *behind;
    float *value;
    while ((value = zr_growing_next(&heights->values, json)) && (behind = read_plain(at, json->end, limit, value))) {
        heights->has_holes |= isnan(*value) != 0;
        heights->values.count++;
        ++*count;
        json->at = at = behind;
        if (*at == ']') {
            json->at++;
            return true;
        }
    }
    return false;
}

/* Reads the rest of a row and reports each fault. */
static void read_odd_row(struct zr_json *json, const struct zr_json_path *path, struct zr_heights *heights,
                         size_t *count)
{
    for (; zr_json_item(json); ++*count) {
        float value = NAN, *place = zr_growing_next(&heights->values, json);
        if (!place) return;
        if (zr_json_type(json) == ZR_JSON_NULL)
            zr_json_skip(json);
        else if (!zr_json_coordinate(json, ZR_JSON_ITEM(path, *count), &value))
            value = 0.0f;
        *place = value;
        heights->has_holes |= isnan(value) != 0;
        heights->values.count++;
    }
}

static bool read_row(struct zr_json *json, const struct zr_json_path *path, struct zr_heights *heights)
{
    size_t count = 0;
    if (!zr_json_list(json, path)) return false;
    if (!read_plain_row(json, heights, &count)) {
        if (count == 0)
            zr_json_enter(json, '[');
        else
            json->depth++;
        read_odd_row(json, path, heights, &count);
    }
    if (heights->columns == 0) heights->columns = count;
    if (count < 2) return zr_json_fault(json, path, "values: %zu; a grid needs 2 or more in each row", count);
    return count == heights->columns ||
           zr_json_fault(json, path, "%zu values, but the first row has %zu", count, heights->columns);
}

static void read_rows(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    struct zr_heights *heights = state;
    for (; json->at < until && zr_json_item(json); heights->rows++)
        read_row(json, ZR_JSON_ITEM(path, heights->rows), heights);
}

static bool begin_rows(struct zr_json *json, const void *state, void *part, double share)
{
    const struct zr_heights *all = state;
    struct zr_heights *heights = part;
    *heights = (struct zr_heights){.columns = all->columns};
    return all->columns > 0 && zr_growing_begin_part(json, &all->values, &heights->values, share, 1);
}

static bool join_rows(struct zr_json *json, void *state, const void *part)
{
    struct zr_heights *all = state;
    const struct zr_heights *heights = part;
    all->rows += heights->rows;
    all->has_holes |= heights->has_holes;
    return zr_growing_join(json, &all->values, &heights->values);
}

/* Reads an array of rows; NaN is a hole. */
static bool read_value_array(struct zr_json *json, const struct zr_json_path *path, struct zr_heights *heights)
{
    const double limit = (double)json->limits->coordinate_max;
    const struct zr_array_wanted wanted = {
        .least = 2, .most = POSITIONS_MAX, .has_holes = true, .low = -limit, .high = limit};
    struct zr_json_array array;
    if (!zr_json_array_open(json, path, &wanted, &array) || !zr_json_array_floats(json, path, &array, &heights->values))
        return false;
    heights->rows = array.rows;
    const float *values = heights->values.items;
    for (size_t i = 0; i < heights->values.count && !heights->has_holes; i++) {
        if (i % VALUES_PER_CANCEL_CHECK == 0) {
            zr_json_look(json);
            if (zr_json_stops(json)) return false;
        }
        heights->has_holes = isnan(values[i]);
    }
    heights->columns = array.columns;
    return true;
}

/* True if the next value is an object that names an array. */
static bool names_array(const struct zr_json *json)
{
    struct zr_json there = *json;
    struct zr_json_text key;
    return zr_json_enter(&there, '{') && zr_json_member(&there, &key) &&
           (zr_json_is(&key, "asset") || zr_json_is(&key, "uri"));
}

/* struct zr_heights */
static bool read_values(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    static const struct zr_json_list list = {'[', read_rows, begin_rows, join_rows};
    struct zr_heights *heights = out;
    const size_t faults = json->error->count;
    const bool good = zr_json_type(json) == ZR_JSON_OBJECT ? read_value_array(json, path, heights)
                                                           : zr_json_list_read(json, path, &list, heights);
    if (!good) return false;
    zr_growing_trim(&heights->values, json->arena);
    if (heights->rows < 2) zr_json_fault(json, path, "rows: %zu; a grid needs 2 or more", heights->rows);
    if (!zr_json_failed_since(json, faults) && heights->values.count > POSITIONS_MAX)
        zr_json_fault(json, path, "more than the limit of %d values", (int)POSITIONS_MAX);
    if (zr_json_failed_since(json, faults)) heights->columns = 0;
    return heights->columns > 0;
}

/* double[2]: coordinates of the first and the last column or row. They are rounded to float, unless they are moved. */
static bool read_range(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    const double limit = (double)json->limits->coordinate_max;
    double ends[2] = {0, 0};
    size_t count;
    if (!zr_json_list(json, path) || !zr_json_count(json, path, &count)) return false;
    if (count != 2)
        return zr_json_skip(json) &&
               zr_json_fault(json, path, "expected 2 numbers, the first and the last, found %zu", count);
    if (!zr_json_numbers(json, path, (struct zr_json_row){2, 2, -limit, limit}, ends, NULL)) return false;
    if ((float)ends[0] == (float)ends[1])
        return zr_json_fault(json, path, "%.9g to %.9g: the two ends must differ", ends[0], ends[1]);
    for (int i = 0; i < 2 && !json->move; i++)
        ends[i] = zr_rounded(ends[i]);
    memcpy(out, ends, sizeof ends);
    return true;
}

enum { VALUES, X, Y };
static const struct zr_json_field fields[] = {
    [VALUES] = {"values", read_values, 0, .required = true,
                .text = "rows of heights along z, the first at the first y; null for a hole",
                .schema = ZR_SCHEMA_OF("heightRows")},
    [X] = {"x", read_range, offsetof(struct zr_heights, x), .unit = "scene units", .otherwise = "[0, columns - 1]",
           .text = "x of the first and the last column", .schema = ZR_SCHEMA_OF("coordinate2")},
    [Y] = {"y", read_range, offsetof(struct zr_heights, y), .unit = "scene units", .otherwise = "[0, rows - 1]",
           .text = "y of the first and the last row", .schema = ZR_SCHEMA_OF("coordinate2")}};
const struct zr_json_object zr_json_object_heights = ZR_JSON_OBJECT_OF("heights", fields);

bool zr_read_heights(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_heights *heights = out;
    if (zr_json_type(json) != ZR_JSON_OBJECT || names_array(json)) return read_values(json, path, out);
    return zr_json_fields(json, path, &zr_json_object_heights, out, &heights->keys);
}

/* ---- a mesh ---- */

struct grid {
    size_t rows, columns;
    double x[2], y[2], move[3];
};

/* Sets the default range: steps of 1 from 0 on. */
static bool find_range(struct zr_json *json, const struct zr_json_path *path, const struct zr_heights *heights, int key,
                       size_t count, double out[2])
{
    const double last = (double)(count - 1), limit = (double)json->limits->coordinate_max;
    if (zr_json_gives(heights->keys, key)) return true;
    out[0] = 0.0;
    out[1] = last;
    return last <= limit ||
           zr_json_fault(json, path, "%zu steps of 1 lead beyond %.9g; give %s", count - 1, limit, fields[key].key);
}

/* Returns the coordinate of column or row `index` minus the move; the first and the last are exact. */
static float place(const double range[2], double move, size_t index, size_t count)
{
    double last = (double)(count - 1), i = (double)index;
    return (float)((range[0] * (last - i) + range[1] * i) / last - move);
}

/* Computes the position of each value; holes have z = 0. */
static void place_values(const struct grid *grid, const float *values, zr_vec4 *positions)
{
    for (size_t column = 0; column < grid->columns; column++)
        positions[column].x = place(grid->x, grid->move[0], column, grid->columns);
    for (size_t row = 0; row < grid->rows; row++) {
        const float *z = values + row * grid->columns, y = place(grid->y, grid->move[1], row, grid->rows);
        zr_vec4 *position = positions + row * grid->columns;
        for (size_t column = 0; column < grid->columns; column++)
            position[column] = (zr_vec4){positions[column].x, y,
                                         isnan(z[column]) ? 0.0f : (float)((double)z[column] - grid->move[2]), 1.0f};
    }
}

/* Makes one quad per cell, row by row. Quads are counter-clockwise seen from +z, for any direction of the axes. */
static bool make_cells(struct zr_arena *arena, const struct grid *grid, struct zr_mesh *mesh)
{
    uint32_t columns = (uint32_t)grid->columns, rows = (uint32_t)grid->rows, cells = (columns - 1) * (rows - 1);
    uint32_t *offsets = zr_arena_alloc(arena, (size_t)cells + 1, sizeof *offsets);
    uint32_t *indices = zr_arena_alloc(arena, cells, 4 * sizeof *indices), *corner = indices;
    if (!zr_arena_ok(arena)) return false;
    bool turned = (grid->x[1] < grid->x[0]) != (grid->y[1] < grid->y[0]);
    for (uint32_t row = 0; row + 1 < rows; row++)
        for (uint32_t column = 0; column + 1 < columns; column++, corner += 4) {
            uint32_t first = row * columns + column;
            corner[0] = first;
            corner[turned ? 3 : 1] = first + 1;
            corner[2] = first + columns + 1;
            corner[turned ? 1 : 3] = first + columns;
        }
    for (uint32_t cell = 0; cell <= cells; cell++)
        offsets[cell] = 4 * cell;
    mesh->face_count = cells;
    mesh->face_offsets = offsets;
    mesh->indices = indices;
    return true;
}

/* Maps an image over the grid: its left edge to column 0, its top edge to the last row. */
static bool make_texcoords(struct zr_arena *arena, const struct grid *grid, struct zr_mesh *mesh)
{
    static const double across[2] = {0, 1}, down[2] = {1, 0};
    zr_vec4 *texcoords = zr_arena_alloc(arena, grid->rows * grid->columns, sizeof *texcoords);
    if (!texcoords) return false;
    for (size_t row = 0; row < grid->rows; row++)
        for (size_t column = 0; column < grid->columns; column++)
            texcoords[row * grid->columns + column] =
                (zr_vec4){place(across, 0.0, column, grid->columns), place(down, 0.0, row, grid->rows), 0.0f, 0.0f};
    mesh->texcoords = texcoords;
    return true;
}

bool zr_heights_make(struct zr_json *json, const struct zr_json_path *path, const struct zr_heights *heights,
                     bool with_texcoords, struct zr_mesh *mesh)
{
    struct grid grid = {.rows = heights->rows, .columns = heights->columns};
    memcpy(grid.x, heights->x, sizeof grid.x);
    memcpy(grid.y, heights->y, sizeof grid.y);
    if (json->move) memcpy(grid.move, json->move, sizeof grid.move);
    if (grid.columns == 0) return false;
    const bool has_x = find_range(json, path, heights, X, grid.columns, grid.x);
    if (!find_range(json, path, heights, Y, grid.rows, grid.y) || !has_x || json->error->count > 0) return false;
    zr_vec4 *positions = zr_arena_alloc(json->arena, heights->values.count, sizeof *positions);
    if (!positions || (with_texcoords && !make_texcoords(json->arena, &grid, mesh))) return false;
    place_values(&grid, heights->values.items, positions);
    if (!make_cells(json->arena, &grid, mesh)) return false;
    mesh->position_count = (uint32_t)heights->values.count;
    mesh->positions = positions;
    mesh->faces_are_fans = true;
    return true;
}

/* ---- holes ---- */

/* Selects the cells without a hole and the positions that they use. new_index[p] is the new number of position p, or
 * UINT32_MAX. Returns the number of cells; *positions is that of positions. */
static uint32_t choose(const float *values, const struct zr_mesh *mesh, uint32_t *kept_cells, uint32_t *new_index,
                       uint32_t *positions)
{
    uint32_t cells = 0;
    *positions = 0;
    for (uint32_t p = 0; p < mesh->position_count; p++)
        new_index[p] = UINT32_MAX;
    for (uint32_t cell = 0; cell < mesh->face_count; cell++) {
        const uint32_t *corner = mesh->indices + (size_t)4 * cell;
        if (isnan(values[corner[0]] + values[corner[1]] + values[corner[2]] + values[corner[3]])) continue;
        kept_cells[cells++] = cell;
        for (int k = 0; k < 4; k++)
            new_index[corner[k]] = 0;
    }
    for (uint32_t p = 0; p < mesh->position_count; p++)
        if (new_index[p] == 0) new_index[p] = (*positions)++;
    return cells;
}

/* Returns a list of one item per position without the dropped positions. */
static const zr_vec4 *keep_positions(struct zr_arena *arena, const struct zr_mesh *mesh, const zr_vec4 *list,
                                     const uint32_t *new_index, uint32_t positions)
{
    zr_vec4 *kept = list ? zr_arena_alloc(arena, positions, sizeof *kept) : NULL;
    for (uint32_t p = 0; kept && p < mesh->position_count; p++)
        if (new_index[p] != UINT32_MAX) kept[new_index[p]] = list[p];
    return kept;
}

static const zr_vec3 *keep_normals(struct zr_arena *arena, const struct zr_mesh *mesh, const uint32_t *new_index,
                                   uint32_t positions)
{
    zr_vec3 *kept = mesh->normals ? zr_arena_alloc(arena, positions, sizeof *kept) : NULL;
    for (uint32_t p = 0; kept && p < mesh->position_count; p++)
        if (new_index[p] != UINT32_MAX) kept[new_index[p]] = mesh->normals[p];
    return kept;
}

void zr_heights_drop_holes(struct zr_arena *arena, const struct zr_heights *heights, struct zr_mesh *mesh)
{
    if (!heights->has_holes) return;
    uint32_t *kept_cells = zr_arena_alloc(arena, mesh->face_count, sizeof *kept_cells), positions;
    uint32_t *new_index = zr_arena_alloc(arena, mesh->position_count, sizeof *new_index);
    if (!zr_arena_ok(arena)) return;
    uint32_t cells = choose(heights->values.items, mesh, kept_cells, new_index, &positions);
    uint32_t *indices = zr_arena_alloc(arena, cells, 4 * sizeof *indices);
    zr_vec4 *face_colors = mesh->face_colors ? zr_arena_alloc(arena, cells, sizeof *face_colors) : NULL;
    mesh->normals = keep_normals(arena, mesh, new_index, positions);
    mesh->colors = keep_positions(arena, mesh, mesh->colors, new_index, positions);
    mesh->texcoords = keep_positions(arena, mesh, mesh->texcoords, new_index, positions);
    mesh->tangents = keep_positions(arena, mesh, mesh->tangents, new_index, positions);
    mesh->positions = keep_positions(arena, mesh, mesh->positions, new_index, positions);
    if (!zr_arena_ok(arena)) return;
    for (uint32_t cell = 0; cell < cells; cell++) {
        for (int k = 0; k < 4; k++)
            indices[4 * cell + (uint32_t)k] = new_index[mesh->indices[4 * kept_cells[cell] + (uint32_t)k]];
        if (face_colors) face_colors[cell] = mesh->face_colors[kept_cells[cell]];
    }
    mesh->position_count = positions;
    mesh->normal_count = mesh->normals ? positions : 0;
    mesh->face_count = cells; /* face_offsets stays valid: all cells have four corners */
    mesh->indices = indices;
    mesh->face_colors = face_colors;
}
