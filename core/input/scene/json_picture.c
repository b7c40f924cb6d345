/* Keys of the picture: the look, and the keys that override it. */
#include <float.h>
#include <string.h>

#include "input/images/environment_image.h"
#include "input/json/json_bytes.h"
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "scene/parsed_picture.h"

#define INTENSITY_MAX 1e6
#define ANGLE_MAX     1e6 /* degrees: larger angles are taken for mistakes */
#define STRENGTH_MAX  10.0
#define RADIUS_MIN    1e-3 /* fractions of the diagonal */
#define RADIUS_MAX    10.0

static const char *const managements[] = {"none", "srgb"};
static const char *const tones[] = {"none", "khronos-neutral", "neutral"};
const struct zr_names zr_management_names = ZR_NAMES(2, managements);
static const char *const file_materials[] = {"look", "keep"};
const struct zr_names zr_file_material_names = ZR_NAMES(2, file_materials);
static const char *const samples[] = {"1", "4", "16", "64"};
const struct zr_names zr_sample_names = ZR_NAMES(4, samples);
const struct zr_names zr_tone_names = ZR_NAMES(ZR_TONE_COUNT, tones);

/* ---- given keys ---- */

void zr_parsed_note_keys(struct zr_parsed_picture *given, const char *name, const struct zr_json_object *object,
                         uint64_t keys)
{
    for (size_t i = 0; i < object->count; i++)
        if (zr_json_gives(keys, (int)i)) zr_picture_give_key(given, name, object->fields[i].key);
}

/* ---- the look ---- */

bool zr_read_look(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    const char *word = "";
    if (!zr_json_string(json, path, &word)) return false;
    root->look = zr_look_find(word);
    root->scene->has_open_look = !strchr(word, '@');
    return root->look || zr_json_fault(json, path, "%s", zr_looks_refuse(word).text);
}

/* ---- up ---- */

/* bool: true for z, false for y. */
bool zr_read_up(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    int axis = 0;
    if (!zr_json_choice(json, path, &axis)) return false;
    *(bool *)out = axis == 1;
    return true;
}

/* ---- samples ---- */

bool zr_read_samples(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    uint32_t side = 1;
    double number;
    if (!zr_json_number_in(json, path, -DBL_MAX, DBL_MAX, &number)) return false;
    while (side < ZR_SAMPLE_SIDE_MAX && (double)(side * side) < number)
        side *= 2;
    if ((double)(side * side) != number) return zr_json_fault(json, path, "%.15g; 1, 4, 16 or 64 are allowed", number);
    root->picture->given.side = side;
    return true;
}

/* ---- the background ---- */

/* zr_vec3 */
static bool read_opaque(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    zr_vec4 color;
    if (!zr_json_opaque(json, path, &color)) return false;
    *(zr_vec3 *)out = (zr_vec3){color.x, color.y, color.z};
    return true;
}

enum { TOP, BOTTOM };
static const struct zr_json_field gradient_fields[] = {
    [TOP] = {"top", read_opaque, offsetof(struct zr_picture, top), .required = true,
             .text = "colour of the upper edge of the picture", .schema = ZR_SCHEMA_OF("opaque")},
    [BOTTOM] = {"bottom", read_opaque, offsetof(struct zr_picture, bottom), .required = true,
                .text = "colour of the lower edge of the picture", .schema = ZR_SCHEMA_OF("opaque")}};
const struct zr_json_object zr_json_object_gradient = ZR_JSON_OBJECT_OF("gradient", gradient_fields);

bool zr_read_background(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct zr_picture *picture = &root->picture->given;
    uint64_t keys;
    zr_picture_give(root->picture, ZR_PICTURE_TOP);
    zr_picture_give(root->picture, ZR_PICTURE_BOTTOM);
    if (zr_json_type(json) != ZR_JSON_OBJECT) return zr_json_color(json, path, &root->background);
    if (!zr_json_fields(json, path, &zr_json_object_gradient, picture, &keys)) return false;
    picture->has_gradient = true;
    root->background = (zr_vec4){picture->top.x, picture->top.y, picture->top.z, 1};
    return true;
}

/* ---- effects ---- */

/* Reads true, false, or an object with values, which means true. */
static bool read_effect(struct zr_json *json, const struct zr_json_path *path, const struct zr_json_object *object,
                        struct zr_parsed_picture *given, void *effect, bool *is_on)
{
    const enum zr_json_type type = zr_json_type(json);
    uint64_t keys;
    if (type == ZR_JSON_BOOL) return zr_json_take_bool(json, is_on);
    if (type != ZR_JSON_OBJECT) return zr_json_expect(json, path, "true, false or an object");
    if (!zr_json_fields(json, path, object, effect, &keys)) return false;
    zr_parsed_note_keys(given, object->name, object, keys);
    *is_on = true;
    return true;
}

static const struct zr_json_field occlusion_fields[] = {
    {"radius", zr_json_float, offsetof(struct zr_occlusion, radius), RADIUS_MIN, RADIUS_MAX,
     .unit = "shares of the diagonal of the bounds", .otherwise = "the look's; 0.2",
     .text = "largest distance of geometry that occludes"},
    {"strength", zr_json_float, offsetof(struct zr_occlusion, strength), 0, STRENGTH_MAX, .otherwise = "the look's; 2",
     .text = "factor of the darkening"}};
const struct zr_json_object zr_json_object_occlusion = ZR_JSON_OBJECT_OF("occlusion", occlusion_fields);

bool zr_read_occlusion(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_picture *given = ((struct zr_parsed_scene *)out)->picture;
    struct zr_occlusion *occlusion = &given->given.occlusion;
    return read_effect(json, path, &zr_json_object_occlusion, given, occlusion, &occlusion->is_on);
}

static const char *const edge_sources[] = {"samples", "mesh"};
static const struct zr_names edge_source_names = ZR_NAMES(2, edge_sources);

/* bool: true for mesh. */
static bool read_edge_source(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    int source = 0;
    if (!zr_json_choice(json, path, &source)) return false;
    *(bool *)out = source == 1;
    return true;
}

static const struct zr_json_field edge_fields[] = {
    {"color", read_opaque, offsetof(struct zr_edges, color), .otherwise = "the look's; #1f2a36",
     .text = "colour of the lines", .schema = ZR_SCHEMA_OF("opaque")},
    {"width", zr_json_float, offsetof(struct zr_edges, width), 0.1, 64, .unit = "pixels",
     .otherwise = "the look's; 1.5; from the mesh, more in large windows", .text = "width of the lines"},
    {"creaseDegrees", zr_json_float, offsetof(struct zr_edges, crease_degrees), 0, 180, .unit = "degrees",
     .otherwise = "the look's; 30", .text = "smallest angle between faces at a crease"},
    {"from", read_edge_source, offsetof(struct zr_edges, is_from_mesh), .words = &edge_source_names,
     .otherwise = "the look's; samples", .text = "source of the lines: samples of the picture, or edges of the mesh"},
    {"hiddenLines", zr_json_bool, offsetof(struct zr_edges, has_hidden), .otherwise = "the look's; false",
     .text = "hidden lines of the mesh, dashed"}};
const struct zr_json_object zr_json_object_edges = ZR_JSON_OBJECT_OF("edges", edge_fields);

bool zr_read_edges(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_picture *given = ((struct zr_parsed_scene *)out)->picture;
    struct zr_edges *edges = &given->given.edges;
    return read_effect(json, path, &zr_json_object_edges, given, edges, &edges->is_on);
}

/* ---- the environment ---- */

/* Names of enum zr_environment_name, from 1 on. */
static const char *const environments[] = {"studio", "metal", "outdoor"};
static const struct zr_names environment_names = ZR_NAMES(ZR_ENVIRONMENT_COUNT - 1, environments);

enum { FRAME_WORLD, FRAME_CAMERA, FRAMES };
static const char *const frames[] = {"world", "camera"};
static const struct zr_names frame_names = ZR_NAMES(FRAMES, frames);

struct given_environment {
    int name, frame;
    struct zr_bytes_name file;
    float intensity;
    double rotation_degrees;
};

enum { NAME, INTENSITY, ROTATION, FRAME, FILE_URI, FILE_ASSET };
#define AT(member) offsetof(struct given_environment, member)
static const struct zr_json_field environment_fields[] = {
    [NAME] = {"name", zr_json_choice, AT(name), .words = &environment_names, .otherwise = "the look's",
              .text = "name of the environment"},
    [INTENSITY] = {"intensity", zr_json_float, AT(intensity), 0, INTENSITY_MAX, .otherwise = "1",
                   .text = "factor of the light"},
    [ROTATION] = {"rotationDegrees", zr_json_number, AT(rotation_degrees), -ANGLE_MAX, ANGLE_MAX, .unit = "degrees",
                  .otherwise = "0", .text = "rotation around the up axis, counter-clockwise seen from above"},
    [FRAME] = {"frame", zr_json_choice, AT(frame), .words = &frame_names,
               .otherwise = "camera for studio and metal, else world",
               .text =
                   "camera: moves with the camera; world: fixed to the scene's up and the camera's side, or an image's "
                   "+x and +z to the scene's"},
    ZR_BYTES_NAME_FIELDS(struct given_environment, file)};
#undef AT
static const struct zr_json_rule environment_rules[] = {{.kind = ZR_RULE_APART,
                                                         .text = "only one of name, uri and asset is needed",
                                                         .sets = {ZR_KEY(NAME), ZR_KEY(FILE_URI), ZR_KEY(FILE_ASSET)}}};
const struct zr_json_object zr_json_object_environment = {ZR_JSON_FIELDS("environment", environment_fields),
                                                          ZR_JSON_RULES(environment_rules)};

/* Finds the file that a text names: a Radiance picture, a data: URI or a stored asset. False: it is another name. */
static bool find_file(const char *word, struct zr_bytes_name *file)
{
    const size_t length = strlen(word), ending = sizeof ZR_ENVIRONMENT_ENDING - 1;
    const bool is_uri = strncmp(word, "data:", 5) == 0;
    if (is_uri) file->uri = word;
    if (!is_uri &&
        ((length > ending && strcmp(word + length - ending, ZR_ENVIRONMENT_ENDING) == 0) || zr_stored_name(word)))
        file->asset = word;
    return file->uri || file->asset;
}

bool zr_parsed_read_environment(struct zr_parsed_scene *root)
{
    struct zr_image_list *images = &root->images;
    struct zr_environment *environment = &root->picture->given.environment;
    const struct zr_bytes_name *name = &root->environment_file;
    const struct zr_json_path *path = ZR_SCENE_PATH(ZR_SCENE_ENVIRONMENT);
    struct zr_environment_map *map = NULL;
    struct zr_reason reason;
    struct zr_parsed_bytes bytes;
    if (environment->map || !(name->uri || name->asset)) return true;
    if (!zr_parsed_read_named(&root->json, path, name, &bytes)) return false;
    if (root->is_bare) root->builder->query_bytes = bytes.bytes;
    if (images->quick) images->quick->is_exceeded = true;
    const struct zr_encoded_image file = {bytes.bytes, bytes.size, images->pixels_max - images->pixels};
    const enum zr_status status =
        images->quick ? ZR_CANCELLED : zr_environment_map_read(root->json.arena, &file, &map, &reason);
    environment->map = map;
    if (status == ZR_OK) images->pixels += map->image_texels;
    return zr_json_check_read(&root->json, path, status, &reason);
}

static bool read_name(struct zr_json *json, const struct zr_json_path *path, struct given_environment *given)
{
    const char *word = "";
    if (!zr_json_string(json, path, &word)) return false;
    given->name = zr_names_find(&environment_names, word);
    return given->name >= 0 || find_file(word, &given->file) ||
           zr_json_fault(json, path, "%s; or false for none", zr_names_refuse(&environment_names, word).text);
}

static bool read_environment(struct zr_json *json, const struct zr_json_path *path, struct given_environment *given,
                             uint64_t *keys)
{
    const enum zr_json_type type = zr_json_type(json);
    bool is_on;
    *keys = UINT64_C(1) << NAME;
    if (type == ZR_JSON_STRING) return read_name(json, path, given);
    if (type == ZR_JSON_OBJECT) return zr_json_fields(json, path, &zr_json_object_environment, given, keys);
    if (type != ZR_JSON_BOOL) return zr_json_expect(json, path, "false, a name or an object");
    return zr_json_take_bool(json, &is_on) &&
           (!is_on || zr_json_fault(json, path, "expected false, a name or an object, not true"));
}

bool zr_read_environment(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    struct zr_parsed_scene *root = out;
    struct zr_parsed_picture *picture = root->picture;
    struct given_environment given = {.name = -1};
    uint64_t keys;
    if (!read_environment(json, path, &given, &keys)) {
        zr_picture_give(picture, ZR_PICTURE_ENVIRONMENT); /* prevents a second report of a missing name */
        return false;
    }
    const bool has_file = given.file.uri || given.file.asset;
    if (has_file) keys |= ZR_KEY(NAME) | (given.file.uri ? ZR_KEY(FILE_URI) : ZR_KEY(FILE_ASSET));
    picture->given.environment =
        (struct zr_environment){.name = has_file ? ZR_ENVIRONMENT_IMAGE : (enum zr_environment_name)(given.name + 1),
                                .intensity = given.intensity,
                                .rotation_degrees = given.rotation_degrees,
                                .camera_frame = given.frame == FRAME_CAMERA};
    zr_parsed_note_keys(picture, zr_json_object_environment.name, &zr_json_object_environment, keys);
    root->environment_file = given.file;
    return root->is_bare || zr_parsed_read_environment(root); /* that of a query is read after the body */
}
