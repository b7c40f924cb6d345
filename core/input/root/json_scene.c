/* Reads a scene: the whole root first, in the order of the text, then its references are resolved. */
#include "input/scene/json_scene.h"

#include "input/formats/input.h"
#include "input/root/json_far.h"
#include "input/scene/json_model_scene.h"
#include "input/scene/json_objects.h"
#include "input/scene/kept.h"
#include "render_request.h"
#include "scene/camera/view_set.h"
#include "scene/parsed_picture.h"

/* The deepest item of a list, /meshes/0/heights/values/0/0. Rows of numbers are read without counting levels. */
enum { DEPTH_OF_LISTS = 6 };

/* ---- references ---- */

/* Makes the meshes of the list, one mesh of all polygons, and the second and later meshes of each model file. */
static void make_meshes(struct zr_parsed_scene *root)
{
    const uint32_t listed = (uint32_t)root->meshes.count, first = listed + zr_parsed_has_polygons(root);
    const size_t count = (size_t)first + zr_parsed_number_models(root, first);
    struct zr_mesh *meshes = zr_scene_builder_meshes(root->builder, count);
    if (!meshes) return;
    zr_parsed_make_meshes(root, ZR_SCENE_PATH(ZR_SCENE_MESHES), meshes);
    if (first > listed) zr_parsed_make_polygons(root, ZR_SCENE_PATH(ZR_SCENE_POLYGONS), &meshes[listed]);
}

static void place_meshes(struct zr_parsed_scene *root)
{
    struct zr_scene *scene = root->scene;
    uint32_t count;
    const struct zr_keeping *keeping = root->builder->keeping;
    if (!root->nodes && keeping && keeping->poses)
        zr_json_fault(&root->json, ZR_JSON_KEY(NULL, ZR_POSES), "the scene has no nodes");
    if (!root->nodes && scene->view_set && scene->view_set->animation)
        zr_json_fault(&root->json, ZR_JSON_KEY(ZR_SCENE_PATH(ZR_SCENE_ANIMATE), "nodes"), "the scene has no nodes");
    const struct zr_instance *instances = zr_parsed_make_instances(root, NULL, &count);
    if (instances) zr_scene_builder_place(root->builder, instances, count);
}

static void warn(struct zr_parsed_scene *root)
{
    struct zr_warning_list *warnings = &root->builder->warnings;
    zr_parsed_warn_of_oddities(root);
    zr_parsed_warn_of_materials(root);
    if (root->unplaced_meshes > 0)
        zr_warning_list_add(root->json.arena, warnings, "%u of %u meshes are placed by no node and are not drawn",
                            root->unplaced_meshes, (uint32_t)root->meshes.count);
    zr_parsed_warn_of_unused_assets(&root->assets, root->builder);
}

static void build(struct zr_parsed_scene *root)
{
    struct zr_json *json = &root->json;
    zr_parsed_use_look(root);
    zr_parsed_sort_materials(root, ZR_SCENE_PATH(ZR_SCENE_MATERIALS));
    zr_parsed_find_textures(root, ZR_SCENE_PATH(ZR_SCENE_MATERIALS));
    make_meshes(root);
    if (zr_json_stops(json)) return;
    zr_parsed_check_light(root);
    if (root->model_firsts) zr_parsed_drop_maps(root);
    place_meshes(root);
    if ((root->flow.view || root->flow.poses) && !zr_json_stops(json) && json->error->count == 0)
        zr_parsed_find_flow(root);
    if (root->base) zr_parsed_read_base(root, ZR_SCENE_PATH(ZR_SCENE_BASE));
    if (root->fit_mesh && zr_arena_ok(json->arena)) zr_parsed_find_fit_mesh(root, ZR_SCENE_PATH(ZR_SCENE_VIEW));
    if (root->color_bar_mesh && zr_arena_ok(json->arena))
        zr_parsed_find_color_bar_mesh(root, ZR_SCENE_PATH(ZR_SCENE_COLOR_BAR));
    warn(root);
}

/* Keeps the root if the caller wants it. False without memory. */
static bool save(struct zr_parsed_scene *root)
{
    const struct zr_keeping *keeping = root->builder->keeping;
    if (!keeping || !keeping->into || root->json.error->count > 0) return true;
    return (keeping->if_views && !root->scene->view_set) || zr_kept_save(keeping->into, root);
}

/* Sides of the window, views and the sheet of the query override those of the text. A sheet that chooses its own views
 * drops the text's. */
static void use_asked(struct zr_scene *scene, const struct zr_scene *asked)
{
    if (!asked) return;
    if (asked->views[0].width > 0) scene->views[0].width = asked->views[0].width;
    if (asked->views[0].height > 0) scene->views[0].height = asked->views[0].height;
    if (asked->view_set || (asked->sheet.is_on && asked->sheet.layout != ZR_SHEET_VIEWS))
        scene->view_set = asked->view_set;
    if (asked->sheet.is_on) scene->sheet = asked->sheet;
}

/* Checks the depth of the whole text. */
static bool is_shallow(struct zr_json *json)
{
    struct zr_json there = *json;
    const bool good = zr_json_skip(&there);
    json->ended = there.ended;
    return good;
}

static bool read_keys(struct zr_parsed_scene *root)
{
    struct zr_json *json = &root->json;
    if (zr_json_type(json) != ZR_JSON_OBJECT)
        return zr_json_expect(json, NULL, "a scene, which is an object such as {\"meshes\": [...]}");
    return zr_json_fields(json, NULL, &zr_json_object_scene, root, &root->keys);
}

/* Reads the text and makes the scene. */
static void read_text(struct zr_parsed_scene *root, const struct zr_request *request)
{
    struct zr_json *json = &root->json;
    zr_json_open(json, request->bytes, request->size);
    const bool is_read = read_keys(root) && zr_json_end(json);
    if (is_read) use_asked(root->scene, root->builder->asked);
    if (is_read && save(root)) build(root);
    if (!json->far || !zr_far_moves(json->far->origin)) return;
    root->scene->origin = json->far->origin;
    root->scene->adds_origin = true;
}

/* State before the first reading. */
struct start {
    struct zr_parsed_scene root;
    struct zr_scene scene;
    struct zr_scene_builder builder;
};

/* Reads a scene that is far from the origin again, from the beginning. */
static void read_far(struct zr_parsed_scene *root, const struct zr_request *request, const struct start *start)
{
    struct zr_arena *arena = root->json.arena;
    struct zr_far *far = zr_arena_alloc(arena, 1, sizeof *far);
    if (!far || !zr_arena_ok(arena) || root->json.error->count > 0 || !zr_far_find(root, far)) return;
    *root = start->root;
    *root->scene = start->scene;
    *root->builder = start->builder;
    root->picture = zr_arena_zero(arena, 1, sizeof *root->picture);
    root->json.far = far;
    if (root->picture) read_text(root, request);
}

enum zr_status zr_read_JSON(struct zr_scene_builder *builder, const struct zr_request *request,
                            const struct zr_limits *limits, struct zr_error *error)
{
    const struct zr_keeping *keeping = builder->keeping;
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
                                   .picture = zr_arena_zero(builder->arena, 1, sizeof *root.picture),
                                   .algorithm = (int)scene->algorithm,
                                   .face_style = zr_face_style_unset,
                                   .assets = zr_parsed_assets_of(builder, request),
                                   .images = zr_image_list_of(builder, request, limits)};
    struct zr_json *json = &root.json;
    json->assets = &root.assets;
    zr_json_open(json, request->bytes, request->size);
    if (!root.assets.uses || !root.picture) return zr_json_close(json);
    if (used.json_depth_max < DEPTH_OF_LISTS && !is_shallow(json)) return zr_json_close(json);
    const struct start start = {root, *scene, *builder};
    if (keeping && keeping->from && !zr_kept_load(keeping->from, &root)) return ZR_NO_MEMORY;
    read_text(&root, request);
    if (!json->far && !(keeping && keeping->from)) read_far(&root, request, &start);
    return zr_json_close(json);
}
