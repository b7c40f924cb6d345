#include "input/json_scene.h"

#include "base/checked.h"
#include "input/input.h"
#include "input/json_scan.h"

/* What cJSON and the allocator take for a value, beside the bytes of its text. */
enum { TREE_BYTES_A_VALUE = 80 };

enum {
    VERSION,
    WINDOW,
    BACKGROUND,
    SHADING,
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
    KEYS
};
static const char *const words[] = {"version", "window",    "background", "shading",  "view",    "ambient",
                                    "lights",  "materials", "meshes",     "polygons", "outputs", "colorManagement",
                                    "samples", "algorithm", "nodes",      "views",    "fog",     "turntable"};
static const struct zr_names keys = ZR_NAMES(KEYS, words);

static const char *const managements[] = {"none", "srgb"};
static const struct zr_names management_names = ZR_NAMES(1, managements);

/* Keys of which this version knows one value. */
static void read_fixed(struct zr_json *json, const cJSON *const *found)
{
    uint32_t number;
    int choice;
    const struct zr_json_path *version = ZR_JSON_KEY(NULL, words[VERSION]),
                              *samples = ZR_JSON_KEY(NULL, words[SAMPLES]);
    if (found[VERSION] && zr_json_whole(json, version, found[VERSION], &number) && number != 1)
        zr_json_fault(json, version, "%u; this is version 1 of the contract", number);
    if (found[SAMPLES] && zr_json_whole(json, samples, found[SAMPLES], &number) && number != 1)
        zr_json_fault(json, samples, "%u; only 1 is supported in this version", number);
    if (found[COLOR_MANAGEMENT])
        zr_json_choice(json, ZR_JSON_KEY(NULL, words[COLOR_MANAGEMENT]), found[COLOR_MANAGEMENT], &management_names,
                       &choice);
}

static void read_algorithm(struct zr_draft *draft, const cJSON *node)
{
    int choice;
    if (zr_json_choice(&draft->json, ZR_JSON_KEY(NULL, words[ALGORITHM]), node, &zr_algorithm_names, &choice))
        draft->scene->algorithm = (enum zr_algorithm)choice;
}

static void read_window(struct zr_draft *draft, const cJSON *node)
{
    enum { WIDTH, HEIGHT, WINDOW_KEYS };
    static const char *const members[] = {"width", "height"};
    static const struct zr_names names = ZR_NAMES(WINDOW_KEYS, members);
    const struct zr_json_path *path = ZR_JSON_KEY(NULL, words[WINDOW]);
    const cJSON *found[WINDOW_KEYS];
    struct zr_json *json = &draft->json;
    if (!zr_json_object(json, path, node, &names, found)) return;
    if (found[WIDTH]) zr_json_whole(json, ZR_JSON_KEY(path, members[WIDTH]), found[WIDTH], &draft->scene->width);
    if (found[HEIGHT]) zr_json_whole(json, ZR_JSON_KEY(path, members[HEIGHT]), found[HEIGHT], &draft->scene->height);
}

/* The contract's example has three numbers; any form of a colour will do. */
static void read_ambient(struct zr_draft *draft, const cJSON *node)
{
    zr_vec4 color;
    if (zr_json_color(&draft->json, ZR_JSON_KEY(NULL, words[AMBIENT]), node, &color))
        draft->scene->ambient = (zr_vec3){color.x, color.y, color.z};
}

/* Meshes in their order, then all polygons as one more. */
static void read_meshes(struct zr_draft *draft, const cJSON *meshes, const cJSON *polygons)
{
    struct zr_json *json = &draft->json;
    const struct zr_json_path *meshes_path = ZR_JSON_KEY(NULL, words[MESHES]);
    const struct zr_json_path *polygons_path = ZR_JSON_KEY(NULL, words[POLYGONS]);
    size_t count = 0, polygon_count = 0;
    if (meshes && !zr_json_array(json, meshes_path, meshes, &count)) meshes = NULL;
    if (polygons && !zr_json_array(json, polygons_path, polygons, &polygon_count)) polygons = NULL;
    if (polygon_count > 0) count++;
    struct zr_mesh *made = zr_arena_alloc(json->arena, count, sizeof *made);
    struct zr_instance *instances = zr_arena_alloc(json->arena, count, sizeof *instances);
    if (!zr_arena_ok(json->arena)) return;

    size_t number = 0;
    for (const cJSON *node = meshes ? meshes->child : NULL; node && !zr_json_full(json); node = node->next, number++)
        zr_draft_read_mesh(draft, ZR_JSON_ITEM(meshes_path, number), node, &made[number]);
    if (polygon_count > 0 && !zr_json_full(json))
        zr_draft_read_polygons(draft, polygons_path, polygons, &made[number++]);
    for (size_t i = 0; i < number; i++)
        instances[i] = (struct zr_instance){(uint32_t)i, zr_mat4_identity()};
    draft->scene->meshes = made;
    draft->scene->instances = instances;
    draft->scene->mesh_count = draft->scene->instance_count = (uint32_t)number;
}

static void finish(struct zr_draft *draft)
{
    static const char *const transparent[] = {"transparency is not supported in this version: drawn opaque"};
    draft->scene->materials = draft->materials;
    draft->scene->material_count = (uint32_t)draft->material_count;
    if (!draft->transparent) return;
    draft->scene->warnings = transparent;
    draft->scene->warning_count = 1;
}

static void build(struct zr_draft *draft, const cJSON *root)
{
    struct zr_json *json = &draft->json;
    const cJSON *found[KEYS];
    if (!zr_json_object(json, NULL, root, &keys, found)) return;
    read_fixed(json, found);
    if (found[ALGORITHM]) read_algorithm(draft, found[ALGORITHM]);
    if (found[WINDOW]) read_window(draft, found[WINDOW]);
    if (found[BACKGROUND])
        zr_json_color(json, ZR_JSON_KEY(NULL, words[BACKGROUND]), found[BACKGROUND], &draft->scene->background);
    if (found[SHADING])
        zr_json_choice(json, ZR_JSON_KEY(NULL, words[SHADING]), found[SHADING], &zr_shading_names, &draft->shading);
    if (found[VIEW]) zr_draft_read_view(draft, ZR_JSON_KEY(NULL, words[VIEW]), found[VIEW]);
    if (found[AMBIENT]) read_ambient(draft, found[AMBIENT]);
    if (found[LIGHTS]) zr_draft_read_lights(draft, ZR_JSON_KEY(NULL, words[LIGHTS]), found[LIGHTS]);
    if (found[OUTPUTS]) zr_draft_read_outputs(draft, ZR_JSON_KEY(NULL, words[OUTPUTS]), found[OUTPUTS]);
    zr_draft_read_materials(draft, ZR_JSON_KEY(NULL, words[MATERIALS]), found[MATERIALS]);
    if (!zr_arena_ok(json->arena)) return;
    read_meshes(draft, found[MESHES], found[POLYGONS]);
    finish(draft);
}

/* cJSON allocates outside the arena: about what its tree will take is charged to it. */
static bool charge_tree(struct zr_arena *arena, size_t values, size_t size, size_t *bytes)
{
    return zr_mul_size(values, TREE_BYTES_A_VALUE, bytes) && zr_add_size(*bytes, size, bytes) &&
           zr_arena_charge(arena, *bytes);
}

enum zr_status zr_json_read(struct zr_arena *arena, const struct zr_request *request, const struct zr_limits *limits,
                            struct zr_scene *scene, struct zr_error *error)
{
    struct zr_limits parsed = *limits;
    size_t values, charged;
    if (parsed.json_depth_max > CJSON_NESTING_LIMIT) parsed.json_depth_max = CJSON_NESTING_LIMIT;
    enum zr_status status = zr_json_scan(arena, request->bytes, request->size, &parsed, &values, error);
    if (status != ZR_OK) return status;
    if (!charge_tree(arena, values, request->size, &charged)) return ZR_NO_MEMORY;
    cJSON *root = cJSON_ParseWithLengthOpts(request->bytes, request->size, NULL, false);
    if (!root) return ZR_NO_MEMORY; /* the scan has seen that it is not for bad syntax */

    struct zr_draft draft = {.json = {arena, limits, error}, .scene = scene, .shading = ZR_UNSAID};
    build(&draft, root);
    cJSON_Delete(root);
    zr_arena_refund(arena, charged);
    if (error->count > 0) return error->status;
    return zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}
