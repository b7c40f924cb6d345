#include <string.h>

#include "input/json_rows.h"
#include "input/json_scene.h"
#include "input/json_text.h"
#include "input/json_walk.h"

enum {
    NAME,
    MATERIAL,
    POSITIONS,
    NORMALS,
    COLORS,
    FACE_COLORS,
    FACES,
    LINES,
    HEIGHTS,
    LOOK,
    KEYS = LOOK + ZR_LOOK_KEYS
};
static const char *const words[] = {"name",  "material", "positions", "normals",     "colors",    "faceColors",
                                    "faces", "lines",    "heights",   ZR_LOOK_WORDS, "texcoords", "data"};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

/* A list that must have one item for each of `wanted` things. */
static struct zr_json_list *list_for_each(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                                          size_t wanted, const char *of)
{
    struct zr_json_list *list = zr_json_large_list(json, path, node);
    if (!list || list->items == wanted) return list;
    zr_json_fault(json, path, "%zu items for %zu %s; one each is needed", list->items, wanted, of);
    return NULL;
}

/* All items of a list; returns how many. */
static size_t read_list(struct zr_json *json, const struct zr_json_path *path, struct zr_json_list *list,
                        zr_json_walk_fn *read, void *context)
{
    struct zr_json_walk walk = zr_json_walk_begin(json, path, list);
    return zr_json_walk_all(&walk, read, context);
}

static void read_color_rows(struct zr_json_walk *walk, void *context)
{
    zr_vec4 *colors = context;
    struct zr_json *json = walk->json;
    cJSON *item;
    while (zr_json_walk_on(walk)) {
        walk->behind = zr_row_color(walk->at, json->text->end, &colors[walk->index]);
        if (walk->behind || !(item = zr_json_walk_parse(walk))) continue;
        zr_json_color(json, ZR_JSON_ITEM(walk->path, walk->index), item, &colors[walk->index]);
        zr_json_walk_drop(walk, item);
    }
}

/* A list of colours, one for each; NULL where it is not given or not right. */
static const zr_vec4 *read_colors(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node,
                                  size_t wanted, const char *of)
{
    struct zr_json *json = &draft->json;
    struct zr_json_list *list = node ? list_for_each(json, path, node, wanted, of) : NULL;
    zr_vec4 *colors = list ? zr_arena_alloc(json->arena, wanted, sizeof *colors) : NULL;
    const size_t faults = json->error->count;
    if (!colors || read_list(json, path, list, read_color_rows, colors) < wanted || json->error->count > faults)
        return NULL;
    zr_draft_note_alpha(draft, colors, wanted);
    return colors;
}

static void read_position_rows(struct zr_json_walk *walk, void *context)
{
    zr_vec4 *positions = context;
    struct zr_json *json = walk->json;
    const double limit = (double)json->limits->coordinate_max;
    cJSON *item;
    while (zr_json_walk_on(walk)) {
        walk->behind = zr_row_position(walk->at, json->text->end, limit, &positions[walk->index]);
        if (walk->behind || !(item = zr_json_walk_parse(walk))) continue;
        zr_json_position(json, ZR_JSON_ITEM(walk->path, walk->index), item, &positions[walk->index]);
        zr_json_walk_drop(walk, item);
    }
}

static void read_positions(struct zr_json *json, const struct zr_json_path *path, const cJSON *node,
                           struct zr_mesh *mesh)
{
    struct zr_json_list *list = zr_json_large_list(json, path, node);
    zr_vec4 *positions = list ? zr_arena_alloc(json->arena, list->items, sizeof *positions) : NULL;
    if (!positions) return;
    read_list(json, path, list, read_position_rows, positions);
    mesh->position_count = (uint32_t)list->items;
    mesh->positions = positions;
}

static void read_normal_rows(struct zr_json_walk *walk, void *context)
{
    zr_vec3 *normals = context;
    struct zr_json *json = walk->json;
    const double limit = (double)json->limits->coordinate_max;
    cJSON *item;
    while (zr_json_walk_on(walk)) {
        walk->behind = zr_row_vec3(walk->at, json->text->end, limit, &normals[walk->index]);
        if (walk->behind || !(item = zr_json_walk_parse(walk))) continue;
        zr_json_vec3(json, ZR_JSON_ITEM(walk->path, walk->index), item, &normals[walk->index]);
        zr_json_walk_drop(walk, item);
    }
}

static void read_normals(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, struct zr_mesh *mesh)
{
    struct zr_json_list *list = list_for_each(json, path, node, mesh->position_count, "positions");
    zr_vec3 *normals = list ? zr_arena_alloc(json->arena, list->items, sizeof *normals) : NULL;
    if (!normals) return;
    read_list(json, path, list, read_normal_rows, normals);
    mesh->normal_count = mesh->position_count;
    mesh->normals = normals;
}

/* Writes a face's corners to `indices`, which has room for all items of `node`, and returns their count; 0 where
 * there is a fault. */
static size_t read_face(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, uint32_t positions,
                        uint32_t *indices)
{
    size_t count, corner = 0;
    bool good = true;
    if (!zr_json_array(json, path, node, &count)) return 0;
    if (count < 3 || count > json->limits->polygon_vertices_max) {
        zr_json_fault(json, path, "a face of %zu corners; 3 to %u are allowed", count,
                      json->limits->polygon_vertices_max);
        return 0;
    }
    for (const cJSON *item = node->child; item && !zr_json_full(json); item = item->next, corner++)
        good = zr_json_index(json, ZR_JSON_ITEM(path, corner), item, positions, "positions", &indices[corner]) && good;
    return good ? count : 0;
}

/* Faces while they are read. */
struct faces {
    uint32_t positions;
    uint32_t *ends; /* of each, in the list of all corners */
    uint32_t *indices;
};

static void read_face_rows(struct zr_json_walk *walk, void *context)
{
    const struct faces faces = *(const struct faces *)context;
    struct zr_json *json = walk->json;
    const size_t most = json->limits->polygon_vertices_max;
    cJSON *item;
    while (zr_json_walk_on(walk)) {
        const size_t room = walk->to.numbers - walk->number;
        uint32_t *indices = faces.indices + walk->number;
        size_t count = 0;
        walk->behind =
            zr_row_indices(walk->at, json->text->end, faces.positions, most < room ? most : room, indices, &count);
        if (walk->behind && count < 3) walk->behind = NULL;
        if (!walk->behind && (item = zr_json_walk_parse(walk))) {
            count = read_face(json, ZR_JSON_ITEM(walk->path, walk->index), item, faces.positions, indices);
            zr_json_walk_drop(walk, item);
        }
        if (walk->behind) walk->number += count;
        faces.ends[walk->index] = (uint32_t)walk->number;
    }
}

static void read_faces(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, struct zr_mesh *mesh)
{
    struct zr_json_list *list = zr_json_large_list(json, path, node);
    if (!list) return;
    uint32_t *offsets = zr_arena_alloc(json->arena, list->items + 1, sizeof *offsets);
    uint32_t *indices = zr_arena_alloc(json->arena, list->numbers, sizeof *indices);
    if (!zr_arena_ok(json->arena)) return;
    offsets[0] = 0;
    struct faces faces = {mesh->position_count, offsets + 1, indices};
    read_list(json, path, list, read_face_rows, &faces);
    mesh->face_count = (uint32_t)list->items; /* where not all was read there is a fault, and nobody looks at them */
    mesh->face_offsets = offsets;
    mesh->indices = indices;
}

static void read_line(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, uint32_t positions,
                      uint32_t line[2])
{
    size_t ends;
    if (!zr_json_array(json, path, node, &ends)) return;
    if (ends != 2) {
        zr_json_fault(json, path, "a line of %zu ends; it has two", ends);
        return;
    }
    const cJSON *end = node->child;
    for (size_t k = 0; k < 2; k++, end = end->next)
        zr_json_index(json, ZR_JSON_ITEM(path, k), end, positions, "positions", &line[k]);
}

struct lines {
    uint32_t positions, *ends;
};

static void read_line_rows(struct zr_json_walk *walk, void *context)
{
    const struct lines lines = *(const struct lines *)context;
    struct zr_json *json = walk->json;
    size_t ends = 0;
    cJSON *item;
    while (zr_json_walk_on(walk)) {
        uint32_t *line = lines.ends + 2 * walk->index;
        walk->behind = zr_row_indices(walk->at, json->text->end, lines.positions, 2, line, &ends);
        if (walk->behind && ends < 2) walk->behind = NULL;
        if (walk->behind || !(item = zr_json_walk_parse(walk))) continue;
        read_line(json, ZR_JSON_ITEM(walk->path, walk->index), item, lines.positions, line);
        zr_json_walk_drop(walk, item);
    }
}

static void read_lines(struct zr_json *json, const struct zr_json_path *path, const cJSON *node, struct zr_mesh *mesh)
{
    struct zr_json_list *list = zr_json_large_list(json, path, node);
    struct lines lines = {mesh->position_count, NULL};
    lines.ends = list ? zr_arena_alloc(json->arena, list->items, 2 * sizeof *lines.ends) : NULL;
    if (!lines.ends) return;
    read_list(json, path, list, read_line_rows, &lines);
    mesh->line_count = (uint32_t)list->items;
    mesh->lines = lines.ends;
}

/* Either positions with faces, lines or both, or heights. */
static void check_shape(struct zr_json *json, const struct zr_json_path *path, const cJSON *const *found)
{
    static const int others[] = {POSITIONS, FACES, LINES};
    if (found[HEIGHTS]) {
        for (size_t i = 0; i < sizeof others / sizeof *others; i++)
            if (found[others[i]]) zr_json_fault(json, path, "two shapes: heights and %s", words[others[i]]);
        return;
    }
    if (!found[POSITIONS]) zr_json_fault(json, path, "positions is missing");
    if (!found[FACES] && !found[LINES]) zr_json_fault(json, path, "faces is missing, and so is lines");
}

void zr_draft_read_mesh(struct zr_draft *draft, const struct zr_json_path *path, const cJSON *node,
                        struct zr_mesh *mesh)
{
    struct zr_json *json = &draft->json;
    const cJSON *found[KEYS];
    static const uint32_t no_faces[1] = {0};
    *mesh = (struct zr_mesh){.name = "", .face_offsets = no_faces};
    if (!zr_json_object(json, path, node, &keys, found)) return;
    const char *name;
    if (found[NAME] && zr_json_string(json, ZR_JSON_KEY(path, words[NAME]), found[NAME], &name))
        mesh->name = zr_json_keep(json, name);
    check_shape(json, path, found);
    struct zr_style style;
    zr_draft_read_style(draft, path, found[MATERIAL], &found[LOOK], &style);
    style.is_open = found[HEIGHTS] != NULL;
    if (!found[HEIGHTS] && (!found[POSITIONS] || (!found[FACES] && !found[LINES]))) return;

    const bool *holes = NULL;
    if (found[HEIGHTS])
        holes = zr_json_read_heights(json, ZR_JSON_KEY(path, words[HEIGHTS]), found[HEIGHTS], mesh);
    else
        read_positions(json, ZR_JSON_KEY(path, words[POSITIONS]), found[POSITIONS], mesh);
    if (!mesh->positions) return; /* no count to hold the rest against */
    if (found[NORMALS]) read_normals(json, ZR_JSON_KEY(path, words[NORMALS]), found[NORMALS], mesh);
    mesh->colors =
        read_colors(draft, ZR_JSON_KEY(path, words[COLORS]), found[COLORS], mesh->position_count, "positions");
    if (found[FACES] && !found[HEIGHTS]) read_faces(json, ZR_JSON_KEY(path, words[FACES]), found[FACES], mesh);
    if (found[LINES] && !found[HEIGHTS]) read_lines(json, ZR_JSON_KEY(path, words[LINES]), found[LINES], mesh);
    mesh->face_colors =
        read_colors(draft, ZR_JSON_KEY(path, words[FACE_COLORS]), found[FACE_COLORS], mesh->face_count, "faces");
    mesh->material = zr_draft_variant(draft, &style, mesh->colors || mesh->face_colors,
                                      mesh->normals || mesh->colors || found[HEIGHTS]);
    if (holes) zr_heights_drop_holes(json->arena, holes, mesh);
}
