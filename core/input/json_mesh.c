#include <string.h>

#include "input/json_heights.h"
#include "input/json_list.h"
#include "input/json_objects.h"
#include "input/json_rows.h"
#include "input/json_scalars.h"
#include "input/json_scene.h"

/* Corners that a face may have beside those in its list's room, before it is read with more care. */
enum { CORNERS_AT_HAND = 64 };

/* Faces, lines and points while they are read. positions: what indices are known to be below, UINT32_MAX where these
 * come later in the text. */
struct faces {
    struct zr_growing ends, indices; /* ends: of each face in indices, behind a first one that is 0 */
    uint32_t positions;
};

struct lines {
    struct zr_growing ends; /* two a line */
    uint32_t positions;
};

struct points {
    struct zr_growing indices;
    uint32_t positions;
};

/* A mesh as the scene has it. Lists are in arrays; what they must agree on is looked at once all are read. */
struct zr_given_mesh {
    uint64_t keys;               /* those that are there */
    const char *name, *material; /* NULL: no word of it */
    struct zr_face_style face_style;
    struct zr_growing positions, normals, colors, face_colors, texcoords, texcoords1, tangents;
    struct faces faces;
    struct lines lines;
    struct points points;
    float point_size;
    struct zr_heights heights;
    struct zr_scalars scalars;
};

/* ---- lists ---- */

/* The list that is next, into an array, which is there from then on though it may be empty. */
static bool read_array(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_list *list,
                       struct zr_growing *array)
{
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

static void read_position_items(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    zr_rows_read_positions(json, path, state, 0, until);
}

static void read_color_items(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    zr_rows_read_colors(json, path, state, 0, until);
}

static void read_normal_items(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    zr_rows_read_vec3s(json, path, state, 0, until);
}

static void read_texcoord_items(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    zr_rows_read_texcoords(json, path, state, 0, until);
}

static void read_tangent_items(struct zr_json *json, const struct zr_json_path *path, void *state, const char *until)
{
    zr_rows_read_tangents(json, path, state, 0, until);
}

/* struct zr_growing, as the next four */
static bool read_positions(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                           void *out)
{
    static const struct zr_json_list list = {'[', read_position_items, begin_array, join_array};
    (void)field;
    return read_array(json, path, &list, out);
}

static bool read_colors(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                        void *out)
{
    static const struct zr_json_list list = {'[', read_color_items, begin_array, join_array};
    (void)field;
    return read_array(json, path, &list, out);
}

static bool read_normals(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                         void *out)
{
    static const struct zr_json_list list = {'[', read_normal_items, begin_array, join_array};
    (void)field;
    return read_array(json, path, &list, out);
}

static bool read_texcoords(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                           void *out)
{
    static const struct zr_json_list list = {'[', read_texcoord_items, begin_array, join_array};
    (void)field;
    return read_array(json, path, &list, out);
}

static bool read_tangents(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                          void *out)
{
    static const struct zr_json_list list = {'[', read_tangent_items, begin_array, join_array};
    (void)field;
    return read_array(json, path, &list, out);
}

static uint32_t known_positions(const struct zr_given_mesh *given)
{
    return given->positions.items ? (uint32_t)given->positions.count : UINT32_MAX;
}

/* The face at hand, when it is not plainly one. */
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
    struct faces *faces = state;
    struct zr_growing *indices = &faces->indices, *ends = &faces->ends;
    const size_t most = json->limits->polygon_vertices_max;
    uint32_t *end;
    while (json->at < until && zr_json_item(json)) {
        if (!(end = zr_growing_next(ends, json)) || !zr_growing_reserve(indices, json, CORNERS_AT_HAND)) return;
        const size_t room = indices->room - indices->count;
        uint32_t *corners = (uint32_t *)indices->items + indices->count;
        size_t count = 0;
        const char *behind =
            zr_row_indices(json->at, json->end, faces->positions, most < room ? most : room, corners, &count);
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
    const struct faces *all = state;
    struct faces *faces = part;
    faces->positions = all->positions;
    return zr_growing_begin_part(json, &all->ends, &faces->ends, share, 1) &&
           zr_growing_begin_part(json, &all->indices, &faces->indices, share, CORNERS_AT_HAND);
}

static bool join_faces(struct zr_json *json, void *state, const void *part)
{
    struct faces *all = state;
    const struct faces *faces = part;
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

/* struct zr_given_mesh */
static bool read_faces(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                       void *out)
{
    static const struct zr_json_list list = {'[', read_face_items, begin_faces, join_faces};
    struct zr_given_mesh *given = out;
    struct faces *faces = &given->faces;
    uint32_t *first;
    (void)field;
    faces->positions = known_positions(given);
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
    struct lines *lines = state;
    struct zr_growing *ends = &lines->ends;
    uint32_t *line;
    while (json->at < until && zr_json_item(json) && (line = zr_growing_next(ends, json))) {
        size_t count = 0;
        const char *behind = zr_row_indices(json->at, json->end, lines->positions, 2, line, &count);
        if (behind && count == 2)
            json->at = behind;
        else
            read_line(json, ZR_JSON_ITEM(path, ends->count), lines->positions, line);
        ends->count++;
    }
}

static bool begin_lines(struct zr_json *json, const void *state, void *part, double share)
{
    const struct lines *all = state;
    struct lines *lines = part;
    lines->positions = all->positions;
    return zr_growing_begin_part(json, &all->ends, &lines->ends, share, 1);
}

static bool join_lines(struct zr_json *json, void *state, const void *part)
{
    return zr_growing_join(json, &((struct lines *)state)->ends, &((const struct lines *)part)->ends);
}

/* struct zr_given_mesh */
static bool read_lines(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                       void *out)
{
    static const struct zr_json_list list = {'[', read_line_items, begin_lines, join_lines};
    struct zr_given_mesh *given = out;
    (void)field;
    given->lines.positions = known_positions(given);
    if (!zr_json_list(json, path) || !zr_growing_reserve(&given->lines.ends, json, 1)) return false;
    const bool good = zr_json_list_read(json, path, &list, &given->lines);
    zr_growing_trim(&given->lines.ends, json->arena);
    return good;
}

/* struct zr_given_mesh */
static bool read_points(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                        void *out)
{
    struct points *points = &((struct zr_given_mesh *)out)->points;
    struct zr_growing *indices = &points->indices;
    uint32_t *index;
    (void)field;
    points->positions = known_positions(out);
    if (!zr_json_list(json, path) || !zr_growing_reserve(indices, json, 1)) return false;
    for (zr_json_enter(json, '['); zr_json_item(json) && (index = zr_growing_next(indices, json)); indices->count++)
        zr_json_index(json, ZR_JSON_ITEM(path, indices->count), points->positions, "positions", index);
    zr_growing_trim(indices, json->arena);
    return true;
}

/* ---- keys ---- */

enum { POINT_SIZE_MAX = 64 };
enum {
    NAME,
    MATERIAL,
    POSITIONS,
    NORMALS,
    COLORS,
    FACE_COLORS,
    FACES,
    LINES,
    POINTS,
    POINT_SIZE,
    HEIGHTS,
    TEXCOORDS,
    TEXCOORDS1,
    TANGENTS
};
#define AT(member) offsetof(struct zr_given_mesh, member)
static const struct zr_json_field fields[] = {
    [NAME] = {"name", zr_json_string, AT(name), .text = "what nodes and fit may call it by; info has it"},
    [MATERIAL] = {"material", zr_json_string, AT(material), .otherwise = "none", .text = "the name of a material"},
    [POSITIONS] = {"positions", read_positions, AT(positions), .unit = "scene units",
                   .text = "[x,y,z] or [x,y,z,w] of each vertex"},
    [NORMALS] = {"normals", read_normals, AT(normals), .otherwise = "computed", .text = "one for each position"},
    [COLORS] = {"colors", read_colors, AT(colors), .text = "one for each position"},
    [FACE_COLORS] = {"faceColors", read_colors, AT(face_colors), .text = "one for each face"},
    [FACES] = {"faces", read_faces, 0, .text = "three or more indices of positions each, counter-clockwise"},
    [LINES] = {"lines", read_lines, 0, .text = "two indices of positions each"},
    [POINTS] = {"points", read_points, 0, .text = "indices of positions"},
    [POINT_SIZE] = {"pointSize", zr_json_float, AT(point_size), 1, POINT_SIZE_MAX, .unit = "pixels", .otherwise = "1",
                    .text = "along a side of a point, which is a square"},
    [HEIGHTS] = {"heights", zr_read_heights, AT(heights), .unit = "scene units",
                 .text = "a grid instead of positions and faces"},
    [TEXCOORDS] = {"texcoords", read_texcoords, AT(texcoords), .otherwise = "of heights: the image over all of them",
                   .text = "[u,v] of each position; [0,0] is the top left corner of an image"},
    [TEXCOORDS1] = {"texcoords1", read_texcoords, AT(texcoords1), .text = "others, of textures that ask for them"},
    [TANGENTS] = {"tangents", read_tangents, AT(tangents), .otherwise = "along u",
                  .text = "[x,y,z,w] of each position: x of normalTexture, and w, the sign of y"},
    ZR_FACE_STYLE_FIELDS(struct zr_given_mesh, face_style),
    ZR_SCALARS_FIELDS(struct zr_given_mesh, scalars),
    ZR_SIDES_FIELD(struct zr_given_mesh, face_style),
    {.key = "data"}};
const struct zr_json_object zr_json_object_mesh = ZR_JSON_OBJECT_OF("mesh", fields);

bool zr_read_meshes(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field, void *out)
{
    struct zr_growing *list = &((struct zr_given_scene *)out)->meshes;
    (void)field;
    list->size = sizeof(struct zr_given_mesh);
    if (!zr_json_list(json, path)) return false;
    for (zr_json_enter(json, '['); zr_json_item(json); list->count++) {
        /* By itself, so that its lists find it where it is, and can be the newest in the arena. */
        struct zr_given_mesh given = {.face_style = zr_face_style_unset,
                                      .positions.size = sizeof(zr_vec4),
                                      .normals.size = sizeof(zr_vec3),
                                      .colors.size = sizeof(zr_vec4),
                                      .face_colors.size = sizeof(zr_vec4),
                                      .texcoords.size = 2 * sizeof(float),
                                      .texcoords1.size = 2 * sizeof(float),
                                      .tangents.size = sizeof(zr_vec4),
                                      .faces = {.ends.size = sizeof(uint32_t), .indices.size = sizeof(uint32_t)},
                                      .lines.ends.size = 2 * sizeof(uint32_t),
                                      .points.indices.size = sizeof(uint32_t),
                                      .point_size = 1.0f,
                                      .heights.values.size = sizeof(float),
                                      .scalars = ZR_SCALARS_UNSET};
        zr_json_fields(json, ZR_JSON_ITEM(path, list->count), &zr_json_object_mesh, &given, &given.keys);
        struct zr_given_mesh *kept = zr_growing_next(list, json);
        if (!kept) return false;
        *kept = given;
    }
    return true;
}

/* ---- meshes ---- */

static bool gives(const struct zr_given_mesh *given, int key)
{
    return zr_json_gives(given->keys, key);
}

/* Either positions with faces, lines, points or some of these, or heights. */
static void check_shape(struct zr_json *json, const struct zr_json_path *path, const struct zr_given_mesh *given)
{
    static const int others[] = {POSITIONS, FACES, LINES, POINTS};
    if (gives(given, HEIGHTS)) {
        for (size_t i = 0; i < sizeof others / sizeof *others; i++)
            if (gives(given, others[i])) zr_json_fault(json, path, "two shapes: heights and %s", fields[others[i]].key);
        return;
    }
    if (!gives(given, POSITIONS)) zr_json_fault(json, path, "positions is missing");
    if (!gives(given, FACES) && !gives(given, LINES) && !gives(given, POINTS))
        zr_json_fault(json, path, "faces is missing, and so are lines and points");
}

/* The items of a list that must have one for each of `wanted` things; NULL where it is not given or not right. */
static const void *one_each(struct zr_json *json, const struct zr_json_path *path, const struct zr_given_mesh *given,
                            int key, const struct zr_growing *list, size_t wanted, const char *of)
{
    if (!gives(given, key)) return NULL;
    if (list->count != wanted)
        zr_json_fault(json, ZR_JSON_KEY(path, fields[key].key), "%zu items for %zu %s; one each is needed", list->count,
                      wanted, of);
    return list->items;
}

/* Indices that came before the positions that they are of. Item i has the indices offsets[i] to offsets[i + 1] - 1, or,
 * where offsets is NULL, two. */
static void check_indices(struct zr_json *json, const struct zr_json_path *path, const uint32_t *indices,
                          const uint32_t *offsets, size_t items, uint32_t positions)
{
    for (size_t i = 0; i < items; i++) {
        const size_t first = offsets ? offsets[i] : 2 * i, behind = offsets ? offsets[i + 1] : 2 * i + 2;
        for (size_t k = first; k < behind; k++)
            if (indices[k] >= positions && json->error->count < ZR_ERROR_ITEMS)
                zr_json_bad_index(json, ZR_JSON_ITEM(ZR_JSON_ITEM(path, i), k - first), (double)indices[k], positions,
                                  "positions");
    }
}

static void make_faces(struct zr_json *json, const struct zr_json_path *path, const struct zr_given_mesh *given,
                       struct zr_mesh *mesh)
{
    if (gives(given, FACES) && given->faces.ends.count > 0) {
        mesh->face_count = (uint32_t)given->faces.ends.count - 1;
        mesh->face_offsets = given->faces.ends.items;
        mesh->indices = given->faces.indices.items;
        if (given->faces.positions != mesh->position_count)
            check_indices(json, ZR_JSON_KEY(path, fields[FACES].key), mesh->indices, mesh->face_offsets,
                          mesh->face_count, mesh->position_count);
    }
    mesh->line_count = (uint32_t)given->lines.ends.count;
    mesh->lines = given->lines.ends.items;
    if (given->lines.positions != mesh->position_count)
        check_indices(json, ZR_JSON_KEY(path, fields[LINES].key), mesh->lines, NULL, mesh->line_count,
                      mesh->position_count);
}

static void make_points(struct zr_json *json, const struct zr_json_path *path, const struct points *points,
                        struct zr_mesh *mesh)
{
    const uint32_t *indices = points->indices.items;
    mesh->point_count = (uint32_t)points->indices.count;
    mesh->points = indices;
    if (points->positions == mesh->position_count) return;
    for (uint32_t i = 0; i < mesh->point_count; i++)
        if (indices[i] >= mesh->position_count && json->error->count < ZR_ERROR_ITEMS)
            zr_json_bad_index(json, ZR_JSON_ITEM(ZR_JSON_KEY(path, fields[POINTS].key), i), (double)indices[i],
                              mesh->position_count, "positions");
}

/* Both sets side by side; what is not given is 0. */
static void make_texcoords(struct zr_json *json, const struct zr_json_path *path, const struct zr_given_mesh *given,
                           struct zr_mesh *mesh)
{
    const size_t count = mesh->position_count;
    const float *first = one_each(json, path, given, TEXCOORDS, &given->texcoords, count, "positions");
    const float *second = one_each(json, path, given, TEXCOORDS1, &given->texcoords1, count, "positions");
    mesh->tangents = one_each(json, path, given, TANGENTS, &given->tangents, count, "positions");
    if ((!first && !second) || json->error->count > 0) return;
    zr_vec4 *texcoords = zr_arena_alloc(json->arena, count, sizeof *texcoords);
    for (size_t i = 0; texcoords && i < count; i++) {
        const zr_vec4 over_heights = mesh->texcoords ? mesh->texcoords[i] : (zr_vec4){0, 0, 0, 0};
        texcoords[i] = (zr_vec4){first ? first[2 * i] : over_heights.x, first ? first[2 * i + 1] : over_heights.y,
                                 second ? second[2 * i] : 0.0f, second ? second[2 * i + 1] : 0.0f};
    }
    mesh->texcoords = texcoords;
}

static void make_mesh(struct zr_given_scene *root, const struct zr_json_path *path, const struct zr_given_mesh *given,
                      struct zr_mesh *mesh)
{
    struct zr_json *json = &root->json;
    struct zr_style style = {
        .material = root->material_count, .face_style = given->face_style, .is_open = gives(given, HEIGHTS)};
    *mesh = (struct zr_mesh){.name = given->name ? given->name : ""};
    check_shape(json, path, given);
    if (given->material)
        style.material = zr_given_find_material(root, ZR_JSON_KEY(path, fields[MATERIAL].key), given->material);
    if (gives(given, HEIGHTS)) {
        const bool textured = zr_given_has_textures(root, style.material) && !gives(given, TEXCOORDS);
        if (!zr_heights_make(json, ZR_JSON_KEY(path, fields[HEIGHTS].key), &given->heights, textured, mesh)) return;
    } else {
        if (!given->positions.items) return; /* no count to hold the rest against */
        mesh->position_count = (uint32_t)given->positions.count;
        mesh->positions = given->positions.items;
        make_faces(json, path, given, mesh);
        make_points(json, path, &given->points, mesh);
        mesh->point_size = given->point_size;
    }
    mesh->normals = one_each(json, path, given, NORMALS, &given->normals, mesh->position_count, "positions");
    mesh->normal_count = mesh->normals ? mesh->position_count : 0;
    mesh->colors = one_each(json, path, given, COLORS, &given->colors, mesh->position_count, "positions");
    mesh->face_colors = one_each(json, path, given, FACE_COLORS, &given->face_colors, mesh->face_count, "faces");
    zr_scalars_apply(json, path, &given->scalars, gives(given, HEIGHTS) ? given->heights.values.items : NULL,
                     &root->builder->warnings, mesh);
    make_texcoords(json, path, given, mesh);
    if (given->faces.ends.items || gives(given, HEIGHTS))
        zr_given_check_texcoords(root, path, style.material, gives(given, TEXCOORDS) || gives(given, HEIGHTS),
                                 gives(given, TEXCOORDS1));
    if (json->error->count > 0) return;
    zr_scene_builder_note_normals(root->builder, mesh->normals, mesh->normal_count);
    zr_given_note_alpha(root, mesh->colors, mesh->colors ? mesh->position_count : 0);
    zr_given_note_alpha(root, mesh->face_colors, mesh->face_colors ? mesh->face_count : 0);
    mesh->material = zr_given_make_material(root, &style, mesh->colors || mesh->face_colors,
                                            mesh->normals || mesh->colors || gives(given, HEIGHTS));
    const uint32_t cells = mesh->face_count;
    if (gives(given, HEIGHTS)) zr_heights_drop_holes(json->arena, &given->heights, mesh);
    root->scene->counts.left_out_cells += cells - mesh->face_count;
}

void zr_given_make_meshes(struct zr_given_scene *root, const struct zr_json_path *path, struct zr_mesh *meshes)
{
    const struct zr_given_mesh *given = root->meshes.items;
    for (size_t i = 0; i < root->meshes.count && !zr_json_stops(&root->json); i++)
        make_mesh(root, ZR_JSON_ITEM(path, i), &given[i], &meshes[i]);
}
