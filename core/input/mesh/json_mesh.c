#include <string.h>

#include "input/mesh/parsed_mesh.h"
#include "input/scene/json_objects.h"
#include "input/text/nearest.h"
#include "input/text/recenter.h"
#include "input/text/text.h"

/* ---- keys ---- */

enum { POINT_SIZE_MAX = 64, ITEMS_PER_CANCEL_CHECK = 1 << 16 };
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
    POINT_SHAPE,
    HEIGHTS,
    SHAPE,
    TEXCOORDS,
    TEXCOORDS1,
    TANGENTS,
    FILE_URI,
    FILE_ASSET,
    KEYS
};
static const char *const point_shapes[] = {"square", "round"};
static const struct zr_names point_shape_names = ZR_NAMES(ZR_POINT_SHAPES, point_shapes);

#define AT(member) offsetof(struct zr_parsed_mesh, member)
static const struct zr_json_field fields[] = {
    [NAME] = {"name", zr_json_string, AT(name), .text = "name for nodes, fit and the output info"},
    [MATERIAL] = {"material", zr_json_string, AT(material), .otherwise = "none", .text = "name of a material"},
    [POSITIONS] = {"positions", zr_read_mesh_positions, AT(positions), .unit = "scene units",
                   .text = "list of [x,y,z] or [x,y,z,w], one per vertex"},
    [NORMALS] = {"normals", zr_read_mesh_normals, AT(normals), .otherwise = "computed",
                 .text = "normals, one per position"},
    [COLORS] = {"colors", zr_read_mesh_colors, AT(colors), .text = "colours, one per position"},
    [FACE_COLORS] = {"faceColors", zr_read_mesh_colors, AT(face_colors), .text = "colours, one per face"},
    [FACES] = {"faces", zr_read_mesh_faces, 0,
               .text = "list of faces: 3 or more indices of positions each, counter-clockwise"},
    [LINES] = {"lines", zr_read_mesh_lines, 0, .text = "list of lines: two indices of positions each"},
    [POINTS] = {"points", zr_read_mesh_points, 0, .text = "list of points: indices of positions"},
    [POINT_SIZE] = {"pointSize", zr_json_float, AT(point_size), 1, POINT_SIZE_MAX, .unit = "pixels", .otherwise = "1",
                    .text = "width of a point"},
    [POINT_SHAPE] = {"pointShape", zr_json_choice, AT(point_shape), .words = &point_shape_names, .otherwise = "square",
                     .text = "square, or round: a regular octagon"},
    [HEIGHTS] = {"heights", zr_read_heights, AT(heights), .unit = "scene units",
                 .text = "grid of heights instead of positions and faces"},
    [SHAPE] = {"shape", zr_read_shape, AT(shape), .object = &zr_json_object_shape,
               .text = "box, sphere, cylinder, cone, torus or extrusion instead of positions and faces"},
    [TEXCOORDS] = {"texcoords", zr_read_mesh_texcoords, AT(texcoords),
                   .otherwise = "with heights: one image over the grid",
                   .text = "[u,v] per position; [0,0] is the top left corner of an image"},
    [TEXCOORDS1] = {"texcoords1", zr_read_mesh_texcoords, AT(texcoords1),
                    .text = "second [u,v] per position, for textures with texcoord 1"},
    [TANGENTS] = {"tangents", zr_read_mesh_tangents, AT(tangents), .otherwise = "along u",
                  .text = "[x,y,z,w] per position: direction of u, and the sign of the bitangent"},
    [FILE_URI] = {ZR_BYTES_URI, zr_json_string, AT(file.uri),
                  .text = "data: URI with a model file, instead of positions", .schema = ZR_SCHEMA_OF("dataUri")},
    [FILE_ASSET] = {ZR_BYTES_ASSET, zr_json_string, AT(file.asset),
                    .text = "name of a model file beside the scene (HTTP: of a part), or sha256: and its hash"},
    ZR_FACE_STYLE_FIELDS(struct zr_parsed_mesh, face_style),
    ZR_SCALARS_FIELDS(struct zr_parsed_mesh, scalars),
    ZR_SIDES_FIELD(struct zr_parsed_mesh, face_style),
    {.key = "data"}};
#define FILES  (ZR_KEY(FILE_URI) | ZR_KEY(FILE_ASSET))
#define SHAPES (ZR_KEY(POSITIONS) | ZR_KEY(FACES) | ZR_KEY(LINES) | ZR_KEY(POINTS))
#define LISTS                                                                                                          \
    (SHAPES | ZR_KEY(NORMALS) | ZR_KEY(COLORS) | ZR_KEY(FACE_COLORS) | ZR_KEY(HEIGHTS) | ZR_KEY(SHAPE) |               \
     ZR_KEY(TEXCOORDS) | ZR_KEY(TEXCOORDS1) | ZR_KEY(TANGENTS))
/* A mesh has heights, a shape, a file, or positions with faces, lines or points. A file brings its lists and colours. */
static const struct zr_json_rule rules[] = {
    {ZR_RULE_AGAINST, .text = "two shapes: %s and %s", .sets = {FILES, LISTS}},
    {ZR_RULE_APART, .text = "only one of uri and asset is needed", .sets = {ZR_KEY(FILE_URI), ZR_KEY(FILE_ASSET)}},
    {ZR_RULE_AGAINST, .text = "two shapes: %s and %s", .sets = {ZR_KEY(HEIGHTS), SHAPES | ZR_KEY(SHAPE)}},
    {ZR_RULE_AGAINST, .text = "two shapes: %s and %s", .sets = {ZR_KEY(SHAPE), SHAPES}},
    {ZR_RULE_SOME, .text = "positions is missing",
     .sets = {ZR_KEY(POSITIONS) | ZR_KEY(HEIGHTS) | ZR_KEY(SHAPE) | FILES}},
    {ZR_RULE_SOME, .text = "faces is missing, and so are lines and points",
     .sets = {ZR_KEY(FACES) | ZR_KEY(LINES) | ZR_KEY(POINTS) | ZR_KEY(HEIGHTS) | ZR_KEY(SHAPE) | FILES}}};
#undef FILES
#undef SHAPES
#undef LISTS
/* clang-format off */
const struct zr_json_object zr_json_object_mesh = {ZR_JSON_FIELDS("mesh", fields), ZR_JSON_RULES(rules),
    .schema = ZR_SCHEMA({
        "dependentSchemas": {
            "uri": {"properties": {"scalars": false, "colormap": false, "range": false}},
            "asset": {"properties": {"scalars": false, "colormap": false, "range": false}},
            "scalars": {"properties": {"colors": false, "faceColors": false}},
            "colormap": {
                "if": {"properties": {"scalars": false}},
                "then": {
                    "not": {"properties": {"heights": false}}, "properties": {"colors": false, "faceColors": false}
                }
            },
            "range": {
                "if": {"properties": {"scalars": false}},
                "then": {"not": {"anyOf": [{"properties": {"heights": false}}, {"properties": {"colormap": false}}]}}
            }
        }
    }),
    .examples = ZR_SCHEMA([
        {"positions": [[0, 0, 0], [2, 0, 0], [1, 2, 0]], "faces": [[0, 1, 2]]},
        {"heights": [[0, 1, 0], [1, 2, 1]], "colormap": "viridis"}, {"asset": "part.stl"},
        {"name": "hole", "shape": {"type": "cylinder", "radius": 2.5, "height": 20}}
    ])};
/* clang-format on */

static bool gives(const struct zr_parsed_mesh *given, int key)
{
    return zr_json_gives(given->keys, key);
}

static bool has_file(const struct zr_parsed_mesh *given)
{
    return gives(given, FILE_URI) || gives(given, FILE_ASSET);
}

/* A model file brings its colours. */
static bool check_file(struct zr_json *json, const struct zr_json_path *path, const struct zr_parsed_mesh *given)
{
    const char *file = fields[gives(given, FILE_URI) ? FILE_URI : FILE_ASSET].key;
    const size_t faults = json->error->count;
    if (given->scalars.values.items)
        zr_json_fault(json, ZR_JSON_KEY(path, "scalars"), "two kinds of colours: %s and scalars", file);
    else
        zr_scalars_check_none(json, path, &given->scalars);
    return !zr_json_failed_since(json, faults);
}

bool zr_read_meshes(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_growing *list = &((struct zr_parsed_scene *)out)->meshes;
    list->size = sizeof(struct zr_parsed_mesh);
    if (!zr_json_list(json, path)) return false;
    json->assets->use |= ZR_USED_BY_GEOMETRY;
    for (zr_json_enter(json, '['); zr_json_item(json); list->count++) {
        /* A local, so that its lists keep their address and can be the arena's newest allocation. */
        struct zr_parsed_mesh given = {.face_style = zr_face_style_unset,
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
                                       .shape.type = -1,
                                       .scalars = ZR_SCALARS_UNSET};
        const struct zr_json_path *at = ZR_JSON_ITEM(path, list->count);
        const size_t faults = json->error->count;
        if (json->far) json->move = zr_far_move(json->far, list->count);
        if (zr_json_fields(json, at, &zr_json_object_mesh, &given, &given.keys) && has_file(&given) &&
            check_file(json, at, &given) && !zr_json_failed_since(json, faults))
            given.model = zr_model_read(out, at, &given.file);
        struct zr_parsed_mesh *kept = zr_growing_next(list, json);
        if (!kept) return false;
        *kept = given;
    }
    json->assets->use = ZR_USED;
    ((struct zr_parsed_scene *)out)->meshes_end = json->at;
    return true;
}

/* ---- meshes ---- */

/* Returns the items of a list that must have `wanted` items; NULL if it is not given. Reports another length. */
static const void *per_position(struct zr_json *json, const struct zr_json_path *path,
                                const struct zr_parsed_mesh *given, int key, const struct zr_growing *list,
                                size_t wanted, const char *of)
{
    if (!gives(given, key)) return NULL;
    if (list->count != wanted)
        zr_json_fault(json, ZR_JSON_KEY(path, fields[key].key), "%zu items for %zu %s; the counts must be equal",
                      list->count, wanted, of);
    return list->items;
}

/* Checks indices that precede their positions in the text. Item i has the indices offsets[i] to offsets[i + 1] - 1; two
 * per item if offsets is NULL. */
static void check_indices(struct zr_json *json, const struct zr_json_path *path, const uint32_t *indices,
                          const uint32_t *offsets, size_t items, uint32_t positions)
{
    for (size_t i = 0; i < items; i++) {
        if (i % ITEMS_PER_CANCEL_CHECK == 0) zr_json_look(json);
        if (i % ITEMS_PER_CANCEL_CHECK == 0 && zr_json_stops(json)) return;
        const size_t first = offsets ? offsets[i] : 2 * i, behind = offsets ? offsets[i + 1] : 2 * i + 2;
        for (size_t k = first; k < behind; k++)
            if (indices[k] >= positions && json->error->count < ZR_ERROR_ITEMS)
                zr_json_bad_index(json, ZR_JSON_ITEM(ZR_JSON_ITEM(path, i), k - first), (double)indices[k], positions,
                                  "positions");
    }
}

static void make_faces(struct zr_json *json, const struct zr_json_path *path, const struct zr_parsed_mesh *given,
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

static void make_points(struct zr_json *json, const struct zr_json_path *path, const struct zr_parsed_points *points,
                        struct zr_mesh *mesh)
{
    const uint32_t *indices = points->indices.items;
    mesh->point_count = (uint32_t)points->indices.count;
    mesh->points = indices;
    if (points->positions == mesh->position_count) return;
    for (uint32_t i = 0; i < mesh->point_count; i++) {
        if (i % ITEMS_PER_CANCEL_CHECK == 0) zr_json_look(json);
        if (i % ITEMS_PER_CANCEL_CHECK == 0 && zr_json_stops(json)) return;
        if (indices[i] >= mesh->position_count && json->error->count < ZR_ERROR_ITEMS)
            zr_json_bad_index(json, ZR_JSON_ITEM(ZR_JSON_KEY(path, fields[POINTS].key), i), (double)indices[i],
                              mesh->position_count, "positions");
    }
}

/* Interleaves both sets; a missing set is 0. */
static void make_texcoords(struct zr_json *json, const struct zr_json_path *path, const struct zr_parsed_mesh *given,
                           struct zr_mesh *mesh)
{
    const size_t count = mesh->position_count;
    const float *first = per_position(json, path, given, TEXCOORDS, &given->texcoords, count, "positions");
    const float *second = per_position(json, path, given, TEXCOORDS1, &given->texcoords1, count, "positions");
    mesh->tangents = per_position(json, path, given, TANGENTS, &given->tangents, count, "positions");
    if ((!first && !second) || json->error->count > 0) return;
    zr_vec4 *texcoords = zr_arena_alloc(json->arena, count, sizeof *texcoords);
    for (size_t i = 0; texcoords && i < count; i++) {
        const zr_vec4 over_heights = mesh->texcoords ? mesh->texcoords[i] : (zr_vec4){0, 0, 0, 0};
        texcoords[i] = (zr_vec4){first ? first[2 * i] : over_heights.x, first ? first[2 * i + 1] : over_heights.y,
                                 second ? second[2 * i] : 0.0f, second ? second[2 * i + 1] : 0.0f};
    }
    mesh->texcoords = texcoords;
}

static void make_mesh(struct zr_parsed_scene *root, const struct zr_json_path *path, const struct zr_parsed_mesh *given,
                      struct zr_mesh *meshes)
{
    struct zr_mesh *mesh = &meshes[path->index];
    struct zr_json *json = &root->json;
    struct zr_style style = {.material = root->material_count,
                             .face_style = given->face_style,
                             .is_open = gives(given, HEIGHTS) || given->model,
                             .number = (uint32_t)path->index};
    *mesh = (struct zr_mesh){.name = given->name ? given->name : ""};
    if (has_file(given) && !given->model) return; /* refused before */
    json->move = json->far ? zr_far_move(json->far, path->index) : NULL;
    if (given->material)
        style.material = zr_parsed_find_material(root, ZR_JSON_KEY(path, fields[MATERIAL].key), given->material);
    if (given->model) {
        const bool has_points = zr_model_make(root, path, given, &style, meshes);
        if (gives(given, POINT_SIZE) && !has_points)
            zr_parsed_note_oddity(root, ZR_ODD_POINT_SIZE, style.number, false);
        return;
    }
    if (gives(given, HEIGHTS)) {
        const bool textured = zr_parsed_has_textures(root, style.material) && !gives(given, TEXCOORDS);
        if (!zr_heights_make(json, ZR_JSON_KEY(path, fields[HEIGHTS].key), &given->heights, textured, mesh)) return;
    } else if (gives(given, SHAPE)) {
        struct zr_shape_desc shape = given->shape;
        if (json->move) memcpy(shape.move, json->move, sizeof shape.move);
        if (shape.type < 0 || !zr_shape_make(json->arena, &shape, mesh)) return;
    } else {
        if (!given->positions.items) return; /* the other checks need the count of positions */
        mesh->position_count = (uint32_t)given->positions.count;
        mesh->positions = given->positions.items;
        make_faces(json, path, given, mesh);
        make_points(json, path, &given->points, mesh);
        mesh->point_size = given->point_size;
        mesh->points_are_round = given->point_shape == ZR_POINT_ROUND;
    }
    mesh->normals = per_position(json, path, given, NORMALS, &given->normals, mesh->position_count, "positions");
    mesh->normal_count = mesh->normals ? mesh->position_count : 0;
    mesh->colors = per_position(json, path, given, COLORS, &given->colors, mesh->position_count, "positions");
    mesh->face_colors = per_position(json, path, given, FACE_COLORS, &given->face_colors, mesh->face_count, "faces");
    mesh->move = json->move;
    zr_scalars_apply(json, path, &given->scalars, gives(given, HEIGHTS) ? given->heights.values.items : NULL,
                     &root->builder->color_warnings, mesh);
    make_texcoords(json, path, given, mesh);
    if (given->faces.ends.items || gives(given, HEIGHTS) || gives(given, SHAPE))
        zr_parsed_check_texcoords(root, path, style.material, gives(given, TEXCOORDS) || gives(given, HEIGHTS),
                                  gives(given, TEXCOORDS1));
    if (json->error->count > 0) return;
    zr_scene_builder_note_normals(root->builder, style.number, mesh->normals, mesh->normal_count);
    if (gives(given, POINT_SIZE) && mesh->point_count == 0)
        zr_parsed_note_oddity(root, ZR_ODD_POINT_SIZE, style.number, false);
    mesh->material =
        zr_parsed_make_mesh_material(root, &style, mesh, mesh->normals || mesh->colors || gives(given, HEIGHTS), false);
    const uint32_t cells = mesh->face_count;
    if (gives(given, HEIGHTS)) zr_heights_drop_holes(json->arena, &given->heights, mesh);
    root->scene->counts.left_out_cells += cells - mesh->face_count;
}

void zr_parsed_make_meshes(struct zr_parsed_scene *root, const struct zr_json_path *path, struct zr_mesh *meshes)
{
    const struct zr_parsed_mesh *given = root->meshes.items;
    for (size_t i = 0; i < root->meshes.count && !zr_json_stops(&root->json); i++)
        make_mesh(root, ZR_JSON_ITEM(path, i), &given[i], meshes);
}

bool zr_parsed_find_mesh(struct zr_parsed_scene *root, const struct zr_json_path *path, const char *name, uint32_t *out)
{
    const struct zr_scene *scene = root->scene;
    struct zr_nearest nearest = {.word = name};
    bool found = false;
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        zr_nearest_offer(&nearest, scene->meshes[i].name);
        if (*name == '\0' || strcmp(scene->meshes[i].name, name) != 0) continue;
        if (found)
            return zr_json_fault(&root->json, path, "two meshes have the name %s: %u and %u",
                                 zr_quote(name, strlen(name)).text, *out, i);
        found = true;
        *out = i;
    }
    return found || zr_json_fault(&root->json, path, "no mesh is named %s%s", zr_quote(name, strlen(name)).text,
                                  zr_nearest_text(&nearest).text);
}
