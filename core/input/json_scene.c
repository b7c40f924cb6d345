/* The root of a scene: all of it is read first, in the order of the text, and then put together. */
#include "input/json_scene.h"

#include <string.h>

#include "input/defaults.h"
#include "input/input.h"
#include "input/json_objects.h"
#include "input/text.h"

/* Rows of numbers are read without counting levels. This deep an item of a list may be: /meshes/0/heights/values/0/0.
 */
enum { DEPTH_OF_LISTS = 6 };

static const char *const managements[] = {"none", "srgb"};
static const struct zr_names management_names = ZR_NAMES(1, managements);

/* ---- keys ---- */

/* uint32_t: of which this version knows one value, 1. */
static bool read_version(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                         void *out)
{
    uint32_t number;
    (void)out;
    if (!zr_json_whole(json, path, field, &number)) return false;
    return number == 1 || zr_json_fault(json, path, "%u; this is version 1 of the contract", number);
}

static bool read_samples(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                         void *out)
{
    uint32_t number;
    (void)out;
    if (!zr_json_whole(json, path, field, &number)) return false;
    return number == 1 || zr_json_fault(json, path, "%u; only 1 is supported in this version", number);
}

static const struct zr_json_field window_fields[] = {
    {"width", zr_json_whole, offsetof(struct zr_view, width), .unit = "pixels", .otherwise = "640",
     .text = "from left to right"},
    {"height", zr_json_whole, offsetof(struct zr_view, height), .unit = "pixels", .otherwise = "480",
     .text = "from top to bottom"}};
const struct zr_json_object zr_json_object_window = ZR_JSON_OBJECT_OF("window", window_fields);

static bool read_window(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                        void *out)
{
    struct zr_given_scene *root = out;
    uint64_t keys;
    (void)field;
    return zr_json_fields(json, path, &zr_json_object_window, &root->scene->views[0], &keys);
}

enum {
    VERSION,
    WINDOW,
    BACKGROUND,
    VIEW,
    AMBIENT,
    LIGHTS,
    MATERIALS,
    MESHES,
    POLYGONS,
    OUTPUTS,
    COLOR_MANAGEMENT,
    SAMPLES,
    ALGORITHM,
    BASE,
    NODES,
    FOG
};
#define AT(member) offsetof(struct zr_given_scene, member)
static const struct zr_json_field fields[] = {
    [VERSION] = {"version", read_version, 0, .otherwise = "1", .text = "of the contract"},
    [WINDOW] = {"window", read_window, 0, .text = "the size of the picture"},
    [BACKGROUND] = {"background", zr_json_color, AT(background), .otherwise = "white", .text = "where nothing is"},
    [VIEW] = {"view", zr_read_view, 0, .text = "a pose and a projection"},
    [AMBIENT] = {"ambient", zr_json_color, AT(ambient), .text = "light from everywhere"},
    [LIGHTS] = {"lights", zr_read_lights, 0, .otherwise = "two that go with the camera", .text = "lamps"},
    [MATERIALS] = {"materials", zr_read_materials, 0, .otherwise = "[]", .text = "looks that meshes share"},
    [MESHES] = {"meshes", zr_read_meshes, 0, .otherwise = "[]", .text = "positions and faces, lines or heights"},
    [POLYGONS] = {"polygons", zr_read_polygons, 0, .otherwise = "[]", .text = "each with vertices of its own"},
    [OUTPUTS] = {"outputs", zr_read_outputs, 0, .otherwise = "a colour image", .text = "what is asked for"},
    [COLOR_MANAGEMENT] = {"colorManagement", zr_json_choice, AT(color_management), .words = &management_names,
                          .otherwise = "none", .text = "none: colours are computed with as they are given"},
    [SAMPLES] = {"samples", read_samples, 0, .otherwise = "1", .text = "for each pixel"},
    [ALGORITHM] = {"algorithm", zr_json_choice, AT(algorithm), .words = &zr_algorithm_names, .otherwise = "halfspace",
                   .text = "the hidden-surface algorithm; all give the same picture"},
    [BASE] = {"base", zr_json_place, AT(base), .text = "a picture that is drawn into"},
    [NODES] = {"nodes", zr_json_place, AT(nodes), .otherwise = "each mesh where it is", .text = "what places meshes"},
    [FOG] = {"fog", zr_read_fog, 0, .text = "what is farther away fades"},
    ZR_FACE_STYLE_FIELDS(struct zr_given_scene, face_style),
    {.key = "views"},
    {.key = "turntable"}};
const struct zr_json_object zr_json_object_scene = ZR_JSON_OBJECT_OF("scene", fields);

#define ROOT_PATH(which) ZR_JSON_KEY(NULL, fields[which].key)

/* ---- what refers to something else ---- */

/* Meshes in their order, then all polygons as one more. Returns how many meshes are placed
 * by nodes, where there are nodes: all but the polygons. */
static uint32_t make_meshes(struct zr_given_scene *root)
{
    struct zr_scene *scene = root->scene;
    const uint32_t listed = (uint32_t)root->meshes.count;
    struct zr_mesh *meshes = zr_scene_builder_meshes(root->builder, (size_t)listed + 1);
    if (!meshes) return 0;
    zr_given_make_meshes(root, ROOT_PATH(MESHES), meshes);
    scene->mesh_count = listed + zr_given_make_polygons(root, ROOT_PATH(POLYGONS), &meshes[listed]);
    return listed;
}

/* Where nodes have the say, they place the `listed` meshes; else each is where it is. The
 * polygons always are. */
static void place_meshes(struct zr_given_scene *root, uint32_t listed)
{
    struct zr_scene *scene = root->scene;
    uint32_t count = 0, next = root->nodes ? listed : 0;
    struct zr_instance *instances = root->nodes
                                        ? zr_given_read_nodes(root, ROOT_PATH(NODES), scene->meshes, listed, &count)
                                        : zr_arena_alloc(root->json.arena, scene->mesh_count, sizeof *instances);
    if (!instances) return;
    for (; next < scene->mesh_count; next++)
        instances[count++] = (struct zr_instance){.mesh = next, .object_to_world = zr_mat4_identity()};
    zr_scene_builder_place(root->builder, instances, count);
}

/* `listed`: meshes that nodes may place. */
static void warn(struct zr_given_scene *root, uint32_t listed)
{
    struct zr_warning_list *warnings = &root->builder->warnings;
    if (root->transparent)
        zr_warning_list_add(root->json.arena, warnings, "transparency is not supported in this version: drawn opaque");
    if (root->unplaced_meshes > 0)
        zr_warning_list_add(root->json.arena, warnings, "%u of %u meshes are placed by no node and are not drawn",
                            root->unplaced_meshes, listed);
    for (size_t i = 0; i < root->asset_count; i++)
        if (!root->assets_used[i]) zr_warn_of_unused_asset(root->builder, &root->assets[i]);
}

static void use_colors(struct zr_given_scene *root)
{
    struct zr_scene *scene = root->scene;
    scene->algorithm = (enum zr_algorithm)root->algorithm;
    scene->background = root->background;
    if (zr_json_gives(root->keys, AMBIENT))
        scene->ambient = (zr_vec3){root->ambient.x, root->ambient.y, root->ambient.z};
    else if (zr_json_gives(root->keys, LIGHTS))
        scene->ambient = zr_default_ambient_of_own_lights();
    if (!root->fog_has_color) scene->fog.color = (zr_vec3){root->background.x, root->background.y, root->background.z};
}

static void build(struct zr_given_scene *root)
{
    struct zr_json *json = &root->json;
    use_colors(root);
    zr_given_sort_materials(root, ROOT_PATH(MATERIALS));
    const uint32_t listed = make_meshes(root);
    if (zr_json_stops(json)) return;
    place_meshes(root, listed);
    if (root->base) zr_given_read_base(root, ROOT_PATH(BASE));
    if (root->fit_mesh && zr_arena_ok(json->arena)) zr_given_find_fit_mesh(root, ROOT_PATH(VIEW));
    warn(root, listed);
}

/* Looks at the whole text first. */
static bool is_shallow(struct zr_json *json)
{
    struct zr_json there = *json;
    const bool good = zr_json_skip(&there);
    json->ended = there.ended;
    return good;
}

static enum zr_status read_json(struct zr_scene_builder *builder, const struct zr_request *request,
                                const struct zr_limits *limits, struct zr_error *error)
{
    struct zr_scene *scene = builder->scene;
    struct zr_limits used = *limits;
    if (used.json_depth_max > ZR_JSON_DEPTH_MAX) used.json_depth_max = ZR_JSON_DEPTH_MAX;
    struct zr_given_scene root = {.json = {.arena = builder->arena,
                                           .team = builder->team,
                                           .cancel = request->cancel,
                                           .limits = &used,
                                           .error = error},
                                  .builder = builder,
                                  .scene = scene,
                                  .background = scene->background,
                                  .algorithm = (int)scene->algorithm,
                                  .face_style = zr_face_style_unset,
                                  .asset_count = request->asset_count,
                                  .assets = request->assets,
                                  .stored = request->stored};
    struct zr_json *json = &root.json;
    zr_json_open(json, request->bytes, request->size);
    root.assets_used = zr_arena_zero(builder->arena, root.asset_count, sizeof *root.assets_used);
    if (used.json_depth_max < DEPTH_OF_LISTS && !is_shallow(json)) return zr_json_close(json);
    if (root.assets_used && zr_json_fields(json, NULL, &zr_json_object_scene, &root, &root.keys) && zr_json_end(json))
        build(&root);
    return zr_json_close(json);
}

/* An object is all that a scene can be; but whoever sends a list means JSON, too. */
static bool looks_so(const char *bytes, size_t size)
{
    const size_t blanks = zr_count_blanks(bytes, size);
    return blanks < size && (bytes[blanks] == '{' || bytes[blanks] == '[');
}

const struct zr_format_reader zr_reader_JSON = {looks_so, read_json, false};
