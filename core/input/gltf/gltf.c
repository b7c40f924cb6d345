/* Reads glTF 2.0, binary (GLB) or JSON.
 * The body, data: URIs or parts of the request hold the bytes of buffers and images. */
#include "input/gltf/gltf_file.h"

#include <stdio.h>
#include <string.h>

#include "input/formats/input.h"
#include "input/text/text.h"
#include "render_request.h"

/* ---- the version ---- */

enum { VERSION_SIZE = 16 };

struct given_asset {
    const char *version, *minimum;
};

/* Reads a string, or a number, which some exporters write: 2 is "2.0". `out`: const char *. */
static bool read_version(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    double number = 0.0;
    if (zr_json_type(json) != ZR_JSON_NUMBER) return zr_json_string(json, path, out);
    if (!zr_json_number_in(json, path, 0.0, 1e3, &number)) return false;
    char *text = zr_arena_alloc(json->arena, VERSION_SIZE, 1);
    if (text) snprintf(text, VERSION_SIZE, "%.1f", number);
    *(const char **)out = text;
    return text != NULL;
}

enum { VERSION, MINIMUM };
static const struct zr_json_field asset_fields[] = {
    [VERSION] = {"version", read_version, offsetof(struct given_asset, version), .required = true,
                 .text = "version of glTF"},
    [MINIMUM] = {.key = "minVersion", .read = zr_json_string, .offset = offsetof(struct given_asset, minimum)},
    {.key = "generator", .read = zr_gltf_ignore},
    {.key = "copyright", .read = zr_gltf_ignore},
    ZR_GLTF_COMMON};
static const struct zr_json_object asset_object = ZR_JSON_OBJECT_OF("asset", asset_fields);

static void check_version(struct zr_gltf *file)
{
    const struct zr_json_path *path = ZR_JSON_KEY(NULL, zr_gltf_word(ZR_GLTF_ASSET));
    struct given_asset given = {NULL, NULL};
    if (!file->places[ZR_GLTF_ASSET]) {
        zr_json_fault(&file->json, NULL, "asset is missing: it gives the version of glTF");
        return;
    }
    zr_gltf_fields_at(file, file->places[ZR_GLTF_ASSET], path, &asset_object, &given);
    if (given.version && strncmp(given.version, "2.", 2) != 0)
        zr_json_fault(&file->json, ZR_JSON_KEY(path, asset_fields[VERSION].key), "glTF of version %s; 2.0 is read",
                      zr_quote(given.version, strlen(given.version)).text);
    if (given.minimum && strcmp(given.minimum, "2.0") != 0)
        zr_json_fault(&file->json, ZR_JSON_KEY(path, asset_fields[MINIMUM].key),
                      "the file needs a reader of version %s; this one reads 2.0",
                      zr_quote(given.minimum, strlen(given.minimum)).text);
}

/* ---- reading ---- */

static bool count_lists(struct zr_gltf *file)
{
    for (int key = ZR_GLTF_ACCESSORS; key < ZR_GLTF_KEYS; key++) {
        size_t count = 0;
        if (!file->places[key] || key == ZR_GLTF_SCENE) continue;
        struct zr_json there = zr_json_at(&file->json, file->places[key]);
        if (zr_json_count(&there, ZR_JSON_KEY(NULL, zr_gltf_word((enum zr_gltf_key)key)), &count))
            file->counts[key] = (uint32_t)count;
    }
    return file->json.error->count == 0;
}

static bool is_good(const struct zr_gltf *file)
{
    return file->json.error->count == 0 && zr_arena_ok(file->json.arena);
}

static void build(struct zr_gltf *file, const struct zr_request *request)
{
    check_version(file);
    zr_gltf_check_extensions(file);
    if (!is_good(file) || !count_lists(file)) return;
    if (!zr_gltf_read_buffers(file) || !zr_gltf_read_accessors(file) || !zr_gltf_read_textures(file) ||
        !zr_gltf_read_materials(file) || !zr_gltf_read_cameras(file) || !zr_gltf_choose_animation(file, request) ||
        !zr_gltf_read_lights(file) || !zr_gltf_read_nodes(file) || !zr_gltf_read_skins(file) || !is_good(file))
        return;
    zr_gltf_keep_cameras(file);
    if (file->counts[ZR_GLTF_MESHES] > 0 && zr_gltf_count_unplaced(file) == file->counts[ZR_GLTF_MESHES])
        zr_json_fault(&file->json, NULL, "no geometry: no node of the scene has a mesh");
    if (!is_good(file) || !zr_gltf_read_meshes(file) || !is_good(file)) return;
    zr_gltf_place(file);
    if (is_good(file)) zr_gltf_warn(file);
}

static uint64_t count_bytes(const struct zr_request *request)
{
    uint64_t bytes = request->size;
    for (size_t i = 0; i < request->asset_count; i++)
        bytes += request->assets[i].size;
    return bytes;
}

static enum zr_status read(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    struct zr_limits used = *limits;
    const struct zr_parsed_bytes all = {request->bytes, request->size};
    struct zr_parsed_bytes text;
    struct zr_gltf *file = zr_arena_zero(builder->arena, 1, sizeof *file);
    struct zr_model_scene *made = zr_arena_zero(builder->arena, 1, sizeof *made);
    if (!file || !made) return ZR_NO_MEMORY;
    if (used.json_depth_max > ZR_JSON_DEPTH_MAX) used.json_depth_max = ZR_JSON_DEPTH_MAX;
    const enum zr_status status = zr_gltf_unpack(builder, &all, &text, &file->chunk, error);
    if (status != ZR_OK) return status;
    file->made = made;
    file->size = request->size;
    file->bytes = count_bytes(request);
    file->json = (struct zr_json){
        .arena = builder->arena, .team = builder->team, .cancel = request->cancel, .limits = &used, .error = error};
    file->builder = builder;
    file->assets = zr_parsed_assets_of(builder, request);
    file->decoded = zr_image_list_of(builder, request, limits);
    struct zr_json *json = &file->json;
    json->assets = &file->assets;
    json->uris = &file->uris;
    file->uris = (struct zr_json_uris){.arena = json->arena, .cancel = json->cancel, .kept = request->texts};
    zr_json_open(json, text.bytes, text.size);
    if (file->assets.uses && zr_gltf_fields(file, json, NULL, &zr_gltf_root, file->places) && zr_json_end(json))
        build(file, request);
    builder->file = made;
    builder->scene->file.unit = "metre";
    return zr_json_close(json);
}

enum zr_status zr_read_GLB(struct zr_scene_builder *builder, const struct zr_request *request,
                           const struct zr_limits *limits, struct zr_error *error)
{
    return read(builder, request, limits, error);
}

enum zr_status zr_read_GLTF(struct zr_scene_builder *builder, const struct zr_request *request,
                            const struct zr_limits *limits, struct zr_error *error)
{
    return read(builder, request, limits, error);
}
