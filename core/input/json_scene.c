/* The root of a scene: all of it is read first, in the order of the text, and then put together. */
#include "input/json_scene.h"

#include <string.h>

#include "input/input.h"
#include "input/json_objects.h"
#include "input/nearest.h"
#include "input/text.h"
#include "scene/defaults.h"

/* Rows of numbers are read without counting levels. This deep an item of a list may be: /meshes/0/heights/values/0/0.
 */
enum { DEPTH_OF_LISTS = 6 };

#define EXPOSURE_MAX 1e6

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

static const struct zr_json_field window_fields[] = {
    {"width", zr_json_whole, offsetof(struct zr_view, width), .unit = "pixels", .otherwise = "640",
     .text = "from left to right"},
    {"height", zr_json_whole, offsetof(struct zr_view, height), .unit = "pixels", .otherwise = "480",
     .text = "from top to bottom"}};
const struct zr_json_object zr_json_object_window = ZR_JSON_OBJECT_OF("window", window_fields);

static bool read_window(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_field *field,
                        void *out)
{
    struct zr_parsed_scene *root = out;
    uint64_t keys;
    (void)field;
    return zr_json_fields(json, path, &zr_json_object_window, &root->scene->views[0], &keys);
}

#define AT(member)      offsetof(struct zr_parsed_scene, member)
#define PICTURE(member) AT(picture.picture.member)
const struct zr_json_field zr_scene_fields[] = {
    [ZR_SCENE_VERSION] = {"version", read_version, 0, .otherwise = "1", .text = "of the contract"},
    [ZR_SCENE_WINDOW] = {"window", read_window, 0, .text = "the size of the picture"},
    [ZR_SCENE_LOOK] = {"look", zr_read_look, 0, .otherwise = "textbook",
                       .text = "what the scene has where it does not say otherwise; NAME@VERSION pins it"},
    [ZR_SCENE_BACKGROUND] = {"background", zr_read_background, 0, .otherwise = "the look's; white",
                             .text = "where nothing is: a colour, or top and bottom of a gradient"},
    [ZR_SCENE_VIEW] = {"view", zr_read_view, 0, .otherwise = "the look's", .text = "a pose and a projection"},
    [ZR_SCENE_UP] = {"up", zr_json_choice, AT(up), .words = &zr_up_names, .otherwise = "y",
                     .text = "the axis that points up: of views, of what an environment has above, and of the ground"},
    [ZR_SCENE_AMBIENT] = {"ambient", zr_json_color, AT(ambient), .text = "light from everywhere"},
    [ZR_SCENE_LIGHTS] = {"lights", zr_read_lights, 0, .otherwise = "the look's", .text = "lamps"},
    [ZR_SCENE_ENVIRONMENT] = {"environment", zr_read_environment, 0, .otherwise = "the look's; false",
                              .text = "light from all around, of the shading pbr: a name, or false"},
    [ZR_SCENE_MATERIALS] = {"materials", zr_read_materials, 0, .otherwise = "[]",
                            .text = "what meshes and polygons share"},
    [ZR_SCENE_MESHES] = {"meshes", zr_read_meshes, 0, .otherwise = "[]",
                         .text = "positions and faces, lines or points, or heights"},
    [ZR_SCENE_POLYGONS] = {"polygons", zr_read_polygons, 0, .otherwise = "[]", .text = "each with vertices of its own"},
    [ZR_SCENE_OUTPUTS] = {"outputs", zr_read_outputs, 0, .otherwise = "a colour image", .text = "what is asked for"},
    [ZR_SCENE_COLOR_MANAGEMENT] = {"colorManagement", zr_json_choice, AT(color_management),
                                   .words = &zr_management_names, .otherwise = "srgb where a key needs it, else none",
                                   .text = "none: colours are computed with as they are given; srgb: in linear light"},
    [ZR_SCENE_TONE_MAPPING] = {"toneMapping", zr_json_choice, AT(tone), .words = &zr_tone_names,
                               .otherwise = "the look's; none",
                               .text = "how what is brighter than white is brought into the picture"},
    [ZR_SCENE_EXPOSURE] = {"exposure", zr_json_float, PICTURE(exposure), 0, EXPOSURE_MAX, .otherwise = "the look's; 1",
                           .text = "a factor of all light, before the tone mapping"},
    [ZR_SCENE_SAMPLES] = {"samples", zr_read_samples, 0, 1, 64, .otherwise = "the look's; 1",
                          .text = "for each pixel: 1, 4, 16 or 64"},
    [ZR_SCENE_LINE_WIDTH] = {"lineWidth", zr_json_float, PICTURE(line_width), 0.1, 64, .unit = "pixels",
                             .otherwise = "1", .text = "of lines and outlines"},
    [ZR_SCENE_OCCLUSION] = {"occlusion", zr_read_occlusion, 0, .otherwise = "the look's; false",
                            .text = "creases and holes get less of the light from all around"},
    [ZR_SCENE_GROUND_SHADOW] = {"groundShadow", zr_json_bool, PICTURE(has_ground), .otherwise = "the look's; false",
                                .text = "a soft shadow on the plane under the scene"},
    [ZR_SCENE_EDGES] = {"edges", zr_read_edges, 0, .otherwise = "the look's; false",
                        .text = "silhouettes and creases are drawn over the picture"},
    [ZR_SCENE_CREASE_DEGREES] = {"creaseDegrees", zr_json_float, PICTURE(crease_degrees), 0, 180, .unit = "degrees",
                                 .otherwise = "the look's; 180",
                                 .text = "faces that meet at less share their normals, where none are given"},
    [ZR_SCENE_ALGORITHM] = {"algorithm", zr_json_choice, AT(algorithm), .words = &zr_algorithm_names,
                            .otherwise = "halfspace",
                            .text = "the hidden-surface algorithm; all give the same picture"},
    [ZR_SCENE_BASE] = {"base", zr_json_place, AT(base), .text = "a picture that is drawn into"},
    [ZR_SCENE_NODES] = {"nodes", zr_json_place, AT(nodes), .otherwise = "each mesh where it is",
                        .text = "what places meshes"},
    [ZR_SCENE_FOG] = {"fog", zr_read_fog, 0, .text = "what is farther away fades"},
    [ZR_SCENE_COLOR_BAR] = {"colorBar", zr_read_color_bar, 0, .otherwise = "false",
                            .text = "the colormap with its numbers is drawn over the picture"},
    ZR_FACE_STYLE_FIELDS(struct zr_parsed_scene, face_style),
    {.key = "views"},
    {.key = "turntable"}};
const struct zr_json_object zr_json_object_scene = ZR_JSON_OBJECT_OF("scene", zr_scene_fields);

/* ---- what refers to something else ---- */

/* Meshes in their order, then all polygons as one more. Returns how many meshes are placed
 * by nodes, where there are nodes: all but the polygons. */
static uint32_t make_meshes(struct zr_parsed_scene *root)
{
    struct zr_scene *scene = root->scene;
    const uint32_t listed = (uint32_t)root->meshes.count;
    struct zr_mesh *meshes = zr_scene_builder_meshes(root->builder, (size_t)listed + 1);
    if (!meshes) return 0;
    zr_parsed_make_meshes(root, ZR_SCENE_PATH(ZR_SCENE_MESHES), meshes);
    scene->mesh_count = listed + zr_parsed_make_polygons(root, ZR_SCENE_PATH(ZR_SCENE_POLYGONS), &meshes[listed]);
    return listed;
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

/* Where nodes have the say, they place the `listed` meshes; else each is where it is. The
 * polygons always are. */
static void place_meshes(struct zr_parsed_scene *root, uint32_t listed)
{
    struct zr_scene *scene = root->scene;
    uint32_t count = 0, next = root->nodes ? listed : 0;
    struct zr_instance *instances =
        root->nodes ? zr_parsed_read_nodes(root, ZR_SCENE_PATH(ZR_SCENE_NODES), scene->meshes, listed, &count)
                    : zr_arena_alloc(root->json.arena, scene->mesh_count, sizeof *instances);
    if (!instances) return;
    for (; next < scene->mesh_count; next++)
        instances[count++] = (struct zr_instance){.mesh = next, .object_to_world = zr_mat4_identity()};
    zr_scene_builder_place(root->builder, instances, count);
}

/* `listed`: meshes that nodes may place. */
static void warn(struct zr_parsed_scene *root, uint32_t listed)
{
    struct zr_warning_list *warnings = &root->builder->warnings;
    zr_parsed_warn_of_oddities(root);
    zr_parsed_warn_of_materials(root);
    if (root->unplaced_meshes > 0)
        zr_warning_list_add(root->json.arena, warnings, "%u of %u meshes are placed by no node and are not drawn",
                            root->unplaced_meshes, listed);
    for (size_t i = 0; i < root->asset_count; i++)
        if (!root->assets_used[i]) zr_warn_of_unused_asset(root->builder, &root->assets[i]);
}

static void use_colors(struct zr_parsed_scene *root)
{
    struct zr_scene *scene = root->scene;
    scene->algorithm = (enum zr_algorithm)root->algorithm;
    if (!root->fog_has_color)
        scene->fog.color = (zr_vec3){scene->background.x, scene->background.y, scene->background.z};
}

static void build(struct zr_parsed_scene *root)
{
    struct zr_json *json = &root->json;
    zr_parsed_use_look(root);
    use_colors(root);
    zr_parsed_sort_materials(root, ZR_SCENE_PATH(ZR_SCENE_MATERIALS));
    zr_parsed_find_textures(root, ZR_SCENE_PATH(ZR_SCENE_MATERIALS));
    const uint32_t listed = make_meshes(root);
    if (zr_json_stops(json)) return;
    zr_parsed_check_light(root);
    place_meshes(root, listed);
    if (root->base) zr_parsed_read_base(root, ZR_SCENE_PATH(ZR_SCENE_BASE));
    if (root->fit_mesh && zr_arena_ok(json->arena)) zr_parsed_find_fit_mesh(root, ZR_SCENE_PATH(ZR_SCENE_VIEW));
    if (root->color_bar_mesh && zr_arena_ok(json->arena))
        zr_parsed_find_color_bar_mesh(root, ZR_SCENE_PATH(ZR_SCENE_COLOR_BAR));
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
    struct zr_parsed_scene root = {.json = {.arena = builder->arena,
                                            .team = builder->team,
                                            .cancel = request->cancel,
                                            .limits = &used,
                                            .error = error},
                                   .builder = builder,
                                   .scene = scene,
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

const struct zr_format_reader zr_reader_JSON = {looks_so, read_json, false, false};
