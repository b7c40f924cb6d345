/* A grid of heights, z = f(x, y) -> positions and quads. */
#include <stdint.h>
#include <string.h>

#include "base/checked.h"
#include "input/json_rows.h"
#include "input/json_scene.h"
#include "input/json_text.h"
#include "input/json_walk.h"

enum { VALUES, X, Y, KEYS };
static const char *const words[] = {"values", "x", "y"};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

/* Corner slots are counted in 32 bits, four a cell. */
enum { POSITIONS_MAX = INT32_MAX / 4 };

struct grid {
    size_t rows, columns;
    float x[2], y[2]; /* of the first and the last column, and row */
};

/* ---- reading ---- */

/* The columns of all rows, if the rows are alike; else not 2 or more, or no matter what. */
static size_t guess_columns(const struct zr_json_list *list)
{
    size_t values = list->numbers;
    return list->items >= 2 && values % list->items == 0 && values <= POSITIONS_MAX ? values / list->items : 0;
}

/* Rows and columns, which all rows must have alike. */
static bool measure(struct zr_json *json, const struct zr_json_path *path, struct zr_json_list *list, struct grid *grid)
{
    size_t count, commas, positions;
    bool good = true;
    grid->rows = list->items;
    if (grid->rows < 2) return zr_json_fault(json, path, "rows: %zu; a grid needs 2 or more", grid->rows);
    struct zr_json_walk walk = zr_json_walk_begin(json, path, list);
    while (zr_json_walk_on(&walk)) {
        const struct zr_json_path *at = ZR_JSON_ITEM(path, walk.index);
        if (*walk.at != '[') {
            cJSON *item = zr_json_walk_parse(&walk);
            if (item) zr_json_array(json, at, item, &count);
            if (item) zr_json_walk_drop(&walk, item);
            return false;
        }
        walk.behind = zr_json_skip(walk.at, json->text->end, json->cancel, &count, &commas);
        if (walk.index == 0) grid->columns = count;
        if (count < 2)
            good = zr_json_fault(json, at, "values: %zu; a grid needs 2 or more in each row", count);
        else if (count != grid->columns)
            good = zr_json_fault(json, at, "%zu values, but the first row has %zu", count, grid->columns);
    }
    list->read = false; /* only passed over */
    if (good && (!zr_mul_size(grid->rows, grid->columns, &positions) || positions > POSITIONS_MAX))
        good = zr_json_fault(json, path, "more than the limit of %d values", (int)POSITIONS_MAX);
    return good;
}

/* Where the first and the last of `count` columns or rows are. */
static bool read_range(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, float out[2])
{
    size_t count;
    if (!zr_json_array(json, path, node, &count)) return false;
    if (count != 2) return zr_json_fault(json, path, "expected 2 numbers, the first and the last, found %zu", count);
    bool good = zr_json_coordinate(json, ZR_JSON_ITEM(path, 0), node->child, &out[0]);
    if (!zr_json_coordinate(json, ZR_JSON_ITEM(path, 1), node->child->next, &out[1]) || !good) return false;
    return out[0] != out[1] ||
           zr_json_fault(json, path, "from %.9g to %.9g: there is nothing between", (double)out[0], (double)out[1]);
}

/* A step of 1 from 0 on, where nothing is said. */
static bool count_range(struct zr_json *json, const struct zr_json_path *path, const char *key, size_t count,
                        float out[2])
{
    double last = (double)(count - 1), limit = (double)json->limits->coordinate_max;
    out[0] = 0.0f;
    out[1] = (float)last;
    return last <= limit ||
           zr_json_fault(json, path, "%zu steps of 1 lead beyond %.9g; give %s", count - 1, limit, key);
}

static bool read_grid(struct zr_json *json, const struct zr_json_path *path, const cJSON *const *found,
                      struct grid *grid)
{
    const struct zr_json_path *x = ZR_JSON_KEY(path, words[X]), *y = ZR_JSON_KEY(path, words[Y]);
    bool good =
        found[X] ? read_range(json, x, found[X], grid->x) : count_range(json, path, words[X], grid->columns, grid->x);
    return (found[Y] ? read_range(json, y, found[Y], grid->y)
                     : count_range(json, path, words[Y], grid->rows, grid->y)) &&
           good;
}

/* The ends are exact. */
static float place(const float range[2], size_t index, size_t count)
{
    double last = (double)(count - 1), i = (double)index;
    return (float)(((double)range[0] * (last - i) + (double)range[1] * i) / last);
}

/* A grid while its values are read, holes too. */
struct values {
    struct zr_json *json;
    struct grid grid;
    zr_vec4 *positions; /* z only, as yet */
    bool *holes;        /* NULL as long as there are none */
};

static bool set_hole(struct values *values, size_t place)
{
    if (!values->holes)
        values->holes = zr_arena_zero(values->json->arena, values->grid.rows * values->grid.columns, sizeof(bool));
    if (values->holes) values->holes[place] = true;
    return values->holes;
}

/* Behind a null, and the space behind that. */
static const char *read_hole(struct values *values, const char *at, const char *end, size_t place)
{
    at = zr_row_skip_space(at, end);
    if (end - at < 4 || memcmp(at, "null", 4) != 0 || !set_hole(values, place)) return NULL;
    values->positions[place].z = 0.0f;
    return zr_row_skip_space(at + 4, end);
}

/* The row at hand; NULL where it is not plainly one, or, ahead, has the first hole: holes take memory. */
static const char *read_row(struct values *values, const struct zr_json_walk *walk)
{
    const char *at = walk->at, *end = values->json->text->end;
    const double limit = (double)values->json->limits->coordinate_max;
    const size_t columns = values->grid.columns, first = walk->index * columns;
    const bool may_have_holes = !walk->ahead || values->holes;
    if (*at != '[') return NULL;
    for (size_t column = 0; column < columns; column++) {
        float *z = &values->positions[first + column].z;
        const char *number = zr_row_next(at, end, -limit, limit, z);
        at = number || !may_have_holes ? number : read_hole(values, at + 1, end, first + column);
        if (!at || at == end || *at != (column + 1 < columns ? ',' : ']')) return NULL;
    }
    return at + 1;
}

/* The same with a complaint for each value that is none. */
static void read_row_slowly(struct values *values, const struct zr_json_path *path, const cJSON *row, size_t first)
{
    size_t column = 0;
    for (const cJSON *item = row->child; item && !zr_json_full(values->json); item = item->next, column++) {
        float *z = &values->positions[first + column].z;
        *z = 0.0f;
        if (!cJSON_IsNull(item))
            zr_json_coordinate(values->json, ZR_JSON_ITEM(path, column), item, z);
        else if (!set_hole(values, first + column))
            return;
    }
}

/* The rows that are plainly of as many values as there are columns. */
static void read_plain_rows(struct zr_json_walk *walk, void *context)
{
    while (zr_json_walk_on(walk))
        walk->behind = read_row(context, walk);
}

static bool read_measured(struct values *values, const struct zr_json_path *path, struct zr_json_list *list)
{
    struct zr_json_walk walk = zr_json_walk_begin(values->json, path, list);
    size_t faults = values->json->error->count;
    cJSON *item;
    while (zr_json_walk_on(&walk)) {
        walk.behind = read_row(values, &walk);
        if (walk.behind || !(item = zr_json_walk_parse(&walk))) continue;
        read_row_slowly(values, ZR_JSON_ITEM(path, walk.index), item, walk.index * values->grid.columns);
        zr_json_walk_drop(&walk, item);
    }
    return walk.index == list->items && values->json->error->count == faults;
}

/* Where each value stands, holes too. */
static void place_values(const struct grid *grid, zr_vec4 *positions)
{
    for (size_t column = 0; column < grid->columns; column++)
        positions[column].x = place(grid->x, column, grid->columns);
    for (size_t row = 0; row < grid->rows; row++) {
        zr_vec4 *position = positions + row * grid->columns;
        float y = place(grid->y, row, grid->rows);
        for (size_t column = 0; column < grid->columns; column++)
            position[column] = (zr_vec4){positions[column].x, y, position[column].z, 1.0f};
    }
}

/* A quad a cell, row by row, counter-clockwise as seen from +z whichever way the axes run. */
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

/* Nearly always all rows are alike and plain, and read at once; else there is a fault, or a second way to say it. */
static bool read_all(struct values *values, const struct zr_json_path *path, struct zr_json_list *list,
                     const struct zr_json_path *grid_path, const cJSON *const *found)
{
    struct zr_json *json = values->json;
    struct grid *grid = &values->grid;
    *grid = (struct grid){.rows = list->items, .columns = guess_columns(list)};
    bool plain = false;
    if (grid->columns >= 2) {
        values->positions = zr_arena_alloc(json->arena, grid->rows * grid->columns, sizeof *values->positions);
        struct zr_json_walk walk = zr_json_walk_begin(json, path, list);
        plain = values->positions && zr_json_walk_all(&walk, read_plain_rows, values) == list->items;
    }
    if (!plain && (!zr_arena_ok(json->arena) || !measure(json, path, list, grid))) return false;
    if (!read_grid(json, grid_path, found, grid)) return false;
    if (!plain && !values->positions) /* else it has the right size: the values are as many */
        values->positions = zr_arena_alloc(json->arena, grid->rows * grid->columns, sizeof *values->positions);
    return values->positions && (plain || read_measured(values, path, list));
}

const bool *zr_json_read_heights(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                                 struct zr_mesh *mesh)
{
    const cJSON *found[KEYS] = {node, NULL, NULL};
    const struct zr_json_path *at = cJSON_IsObject(node) ? ZR_JSON_KEY(path, words[VALUES]) : path;
    struct values values = {.json = json};
    if (cJSON_IsObject(node)) {
        zr_json_object(json, path, node, &keys, found);
        if (!found[VALUES]) zr_json_fault(json, path, "values is missing");
    }
    struct zr_json_list *list = found[VALUES] ? zr_json_large_list(json, at, found[VALUES]) : NULL;
    if (!list || !read_all(&values, at, list, path, found)) return NULL;
    place_values(&values.grid, values.positions);
    if (!make_cells(json->arena, &values.grid, mesh)) return NULL;
    mesh->position_count = (uint32_t)(values.grid.rows * values.grid.columns);
    mesh->positions = values.positions;
    mesh->faces_are_fans = true;
    return values.holes;
}

/* ---- holes ---- */

/* new_index[p] becomes the number of position p among those that a kept cell touches, or
 * UINT32_MAX. Returns how many cells are kept, and in *positions how many positions. */
static uint32_t choose(const bool *holes, const struct zr_mesh *mesh, uint32_t *kept_cells, uint32_t *new_index,
                       uint32_t *positions)
{
    uint32_t cells = 0;
    *positions = 0;
    for (uint32_t p = 0; p < mesh->position_count; p++)
        new_index[p] = UINT32_MAX;
    for (uint32_t cell = 0; cell < mesh->face_count; cell++) {
        const uint32_t *corner = mesh->indices + (size_t)4 * cell;
        if (holes[corner[0]] || holes[corner[1]] || holes[corner[2]] || holes[corner[3]]) continue;
        kept_cells[cells++] = cell;
        for (int k = 0; k < 4; k++)
            new_index[corner[k]] = 0;
    }
    for (uint32_t p = 0; p < mesh->position_count; p++)
        if (new_index[p] == 0) new_index[p] = (*positions)++;
    return cells;
}

/* The same list without what is dropped: `list` has one item a position. */
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

void zr_heights_drop_holes(struct zr_arena *arena, const bool *holes, struct zr_mesh *mesh)
{
    uint32_t *kept_cells = zr_arena_alloc(arena, mesh->face_count, sizeof *kept_cells), positions;
    uint32_t *new_index = zr_arena_alloc(arena, mesh->position_count, sizeof *new_index);
    if (!zr_arena_ok(arena)) return;
    uint32_t cells = choose(holes, mesh, kept_cells, new_index, &positions);
    uint32_t *indices = zr_arena_alloc(arena, cells, 4 * sizeof *indices);
    zr_vec4 *face_colors = mesh->face_colors ? zr_arena_alloc(arena, cells, sizeof *face_colors) : NULL;
    mesh->normals = keep_normals(arena, mesh, new_index, positions);
    mesh->colors = keep_positions(arena, mesh, mesh->colors, new_index, positions);
    mesh->positions = keep_positions(arena, mesh, mesh->positions, new_index, positions);
    if (!zr_arena_ok(arena)) return;
    for (uint32_t cell = 0; cell < cells; cell++) {
        for (int k = 0; k < 4; k++)
            indices[4 * cell + (uint32_t)k] = new_index[mesh->indices[4 * kept_cells[cell] + (uint32_t)k]];
        if (face_colors) face_colors[cell] = mesh->face_colors[kept_cells[cell]];
    }
    mesh->position_count = positions;
    mesh->normal_count = mesh->normals ? positions : 0;
    mesh->face_count = cells; /* its offsets are those of the cells before: all have four corners */
    mesh->indices = indices;
    mesh->face_colors = face_colors;
}
