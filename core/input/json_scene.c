#include "input/json_scene.h"

#include <string.h>

#include "input/defaults.h"
#include "input/input.h"
#include "input/json_text.h"
#include "input/text.h"

enum {
    VERSION,
    WINDOW,
    BACKGROUND,
    LOOK,
    VIEW = LOOK + ZR_LOOK_DOUBLE_SIDED,
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
    FOG,
    KEYS
};
/* A scene's own look is one without sides: those are a body's. */
static const char *const words[] = {"version", "window",          "background", "shading",   "fill",   "outline",
                                    "view",    "ambient",         "lights",     "materials", "meshes", "polygons",
                                    "outputs", "colorManagement", "samples",    "algorithm", "base",   "nodes",
                                    "fog",     "views",           "turntable"};
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
    if (found[WIDTH])
        zr_json_whole(json, ZR_JSON_KEY(path, members[WIDTH]), found[WIDTH], &draft->scene->views[0].width);
    if (found[HEIGHT])
        zr_json_whole(json, ZR_JSON_KEY(path, members[HEIGHT]), found[HEIGHT], &draft->scene->views[0].height);
}

static void read_ambient(struct zr_draft *draft, const cJSON *node)
{
    zr_vec4 color;
    if (zr_json_color(&draft->json, ZR_JSON_KEY(NULL, words[AMBIENT]), node, &color))
        draft->scene->ambient = (zr_vec3){color.x, color.y, color.z};
}

/* Meshes in their order, then all polygons as one more. Returns how many meshes are placed
 * by nodes, where there are nodes: all but the polygons. */
static uint32_t read_meshes(struct zr_draft *draft, const cJSON *meshes, const cJSON *polygons)
{
    struct zr_json *json = &draft->json;
    const struct zr_json_path *meshes_path = ZR_JSON_KEY(NULL, words[MESHES]);
    const struct zr_json_path *polygons_path = ZR_JSON_KEY(NULL, words[POLYGONS]);
    size_t count = 0;
    if (meshes && !zr_json_array(json, meshes_path, meshes, &count)) meshes = NULL;
    struct zr_json_list *soup = polygons ? zr_json_large_list(json, polygons_path, polygons) : NULL;
    if (soup && soup->items > 0) count++;
    struct zr_mesh *made = zr_arena_alloc(json->arena, count, sizeof *made);
    if (!made) return 0;

    size_t number = 0;
    for (const cJSON *node = meshes ? meshes->child : NULL; node && !zr_json_full(json) && !zr_json_stopped(json);
         node = node->next, number++)
        zr_draft_read_mesh(draft, ZR_JSON_ITEM(meshes_path, number), node, &made[number]);
    uint32_t listed = (uint32_t)number;
    if (soup && soup->items > 0 && !zr_json_full(json))
        zr_draft_read_polygons(draft, polygons_path, soup, &made[number++]);
    draft->scene->meshes = made;
    draft->scene->mesh_count = (uint32_t)number;
    return listed;
}

/* Where nodes have the say, they place the `listed` meshes; else each is where it is. The
 * polygons always are. */
static void place_meshes(struct zr_draft *draft, const cJSON *nodes, uint32_t listed)
{
    struct zr_scene *scene = draft->scene;
    uint32_t count = 0, next = nodes ? listed : 0;
    struct zr_instance *instances =
        nodes ? zr_draft_read_nodes(draft, ZR_JSON_KEY(NULL, words[NODES]), nodes, scene->meshes, listed, &count)
              : zr_arena_alloc(draft->json.arena, scene->mesh_count, sizeof *instances);
    if (!instances) return;
    for (; next < scene->mesh_count; next++)
        instances[count++] = (struct zr_instance){.mesh = next, .object_to_world = zr_mat4_identity()};
    scene->instances = instances;
    scene->instance_count = count;
}

/* `listed`: meshes that nodes may place. */
static void finish(struct zr_draft *draft, uint32_t listed)
{
    draft->scene->materials = draft->materials;
    draft->scene->material_count = (uint32_t)draft->material_count;
    if (draft->transparent)
        zr_warning_list_add(draft->json.arena, &draft->warnings,
                            "transparency is not supported in this version: drawn opaque");
    if (draft->unplaced_meshes > 0)
        zr_warning_list_add(draft->json.arena, &draft->warnings,
                            "%u of %u meshes are placed by no node and are not drawn", draft->unplaced_meshes, listed);
    for (size_t i = 0; i < draft->asset_count; i++)
        if (!draft->assets_used[i])
            zr_warning_list_add(draft->json.arena, &draft->warnings, "the asset %s is not used by the scene",
                                zr_quote(draft->assets[i].name, strlen(draft->assets[i].name)).text);
    draft->scene->warnings = draft->warnings.texts;
    draft->scene->warning_count = (uint32_t)draft->warnings.count;
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
    zr_draft_read_look(draft, NULL, &found[LOOK], ZR_LOOK_DOUBLE_SIDED, &draft->look);
    if (found[VIEW]) zr_draft_read_view(draft, ZR_JSON_KEY(NULL, words[VIEW]), found[VIEW]);
    if (found[AMBIENT]) read_ambient(draft, found[AMBIENT]);
    if (found[LIGHTS] && !found[AMBIENT]) draft->scene->ambient = zr_default_ambient_of_own_lights();
    if (found[LIGHTS]) zr_draft_read_lights(draft, ZR_JSON_KEY(NULL, words[LIGHTS]), found[LIGHTS]);
    if (found[FOG]) zr_draft_read_fog(draft, ZR_JSON_KEY(NULL, words[FOG]), found[FOG]);
    if (found[OUTPUTS]) zr_draft_read_outputs(draft, ZR_JSON_KEY(NULL, words[OUTPUTS]), found[OUTPUTS]);
    zr_draft_read_materials(draft, ZR_JSON_KEY(NULL, words[MATERIALS]), found[MATERIALS]);
    if (!zr_arena_ok(json->arena)) return;
    uint32_t listed = read_meshes(draft, found[MESHES], found[POLYGONS]);
    if (!zr_arena_ok(json->arena) || zr_json_full(json)) return;
    place_meshes(draft, found[NODES], listed);
    if (found[BASE]) zr_draft_read_base(draft, ZR_JSON_KEY(NULL, words[BASE]), found[BASE]);
    if (found[VIEW] && zr_arena_ok(json->arena))
        zr_draft_find_fit_mesh(draft, ZR_JSON_KEY(NULL, words[VIEW]), found[VIEW]);
    finish(draft, listed);
}

enum zr_status zr_json_read(struct zr_arena *arena, struct zr_team *team, const struct zr_request *request,
                            const struct zr_limits *limits, struct zr_scene *scene, struct zr_error *error)
{
    struct zr_limits parsed = *limits;
    if (parsed.json_depth_max > CJSON_NESTING_LIMIT) parsed.json_depth_max = CJSON_NESTING_LIMIT;
    struct zr_json_text text = {0};
    struct zr_draft draft = {.json = {arena, team, request->cancel, &parsed, error, &text},
                             .scene = scene,
                             .look = zr_look_unsaid,
                             .asset_count = request->asset_count,
                             .assets = request->assets,
                             .stored = request->stored};
    cJSON *root = zr_json_text_open(&draft.json, request->bytes, request->size);
    draft.assets_used = root ? zr_arena_zero(arena, draft.asset_count, sizeof *draft.assets_used) : NULL;
    if (draft.assets_used && !zr_json_stopped(&draft.json)) build(&draft, root);
    return zr_json_text_close(&draft.json, root);
}
