/* Makes a scene of a bare mesh: {"meshes": [the body]}, with the keys of the query and the look studio by default. */
#include "input/formats/formats.h"
#include "input/formats/input.h"
#include "input/query/axis_colors.h"
#include "input/query/cloud.h"
#include "input/query/parameters.h"
#include "input/scene/json_model_scene.h"
#include "input/scene/kept.h"
#include "render_request.h"
#include "scene/camera/view_set.h"
#include "scene/defaults.h"
#include "scene/parsed_picture.h"
#include "scene/picture.h"

/* Places the meshes in the axes of the file, by its nodes if it has any. zr_query_orient turns them. */
static void place(struct zr_query *query)
{
    struct zr_scene_builder *builder = query->given.builder;
    const struct zr_model_scene *file = builder->file;
    const uint32_t count = file ? file->instance_count : builder->scene->mesh_count;
    query->instances = zr_arena_alloc(builder->arena, count, sizeof *query->instances);
    for (uint32_t i = 0; query->instances && i < count; i++)
        query->instances[i] =
            file ? file->instances[i] : (struct zr_instance){.mesh = i, .object_to_world = zr_mat4_identity()};
    if (query->instances) zr_scene_builder_place(builder, query->instances, count);
}

/* True for files with materials, which read the assets of the request, too. */
static bool has_materials(const struct zr_parsed_scene *root)
{
    return root->builder->file && root->builder->file->mesh_materials;
}

/* Blends colours with an alpha below 1. */
static void make_materials(struct zr_parsed_scene *root)
{
    for (uint32_t i = 0; i < root->scene->mesh_count; i++) {
        struct zr_mesh *mesh = &root->builder->meshes[i];
        const struct zr_style style = {.face_style = zr_face_style_unset, .is_open = true, .number = i};
        zr_model_scene_fit_colors(root, mesh);
        mesh->material = zr_parsed_make_mesh_material(root, &style, mesh, mesh->normal_count > 0 || mesh->colors, true);
    }
}

/* Sets the projection of the query or the look. Perspective uses the look's angle; an orthographic look has none, and
 * then the angle is ZR_YFOV. */
static void use_projection(const struct zr_query *query)
{
    const struct zr_look_view *look = &query->given.scene->look->view;
    struct zr_view *view = &query->given.scene->views[0];
    view->projection = look->projection;
    if (query->projection != ZR_UNSET)
        view->projection = query->projection ? ZR_PROJECTION_PERSPECTIVE : ZR_PROJECTION_ORTHOGRAPHIC;
    view->xfov_radians = view->yfov_radians = 0.0f;
    if (view->projection != ZR_PROJECTION_PERSPECTIVE) return;
    if (look->fov_radians > 0.0f)
        zr_look_set_fov(look, view);
    else
        view->yfov_radians = ZR_YFOV;
}

static bool gives_pose(const struct zr_request *request)
{
    return request->preset || request->azimuth || request->elevation || request->eye || request->target;
}

/* Uses a camera of the file, if the query names one. */
static void use_camera(struct zr_query *query)
{
    const struct zr_model_scene *file = query->given.builder->file;
    const zr_mat4 up = file ? zr_mesh_up_turn(zr_query_up(query)) : zr_mat4_identity();
    const struct zr_request *request = query->request;
    const struct zr_json_path *path = ZR_JSON_KEY(ZR_JSON_KEY(NULL, "query"), "camera");
    if (!query->camera) return;
    if (gives_pose(request) || request->projection || request->padding)
        zr_json_fault(&query->given.json, path,
                      "cannot be combined with preset, azimuth, elevation, eye, target, projection or padding");
    else
        zr_model_scene_use_camera(&query->given, path, file, query->camera, &up);
}

/* Uses the lights of the file, if the query asks for it. */
static void use_lights(struct zr_query *query)
{
    struct zr_parsed_scene *root = &query->given;
    const struct zr_model_scene *file = root->builder->file;
    const zr_mat4 up = file ? zr_mesh_up_turn(zr_query_up(query)) : zr_mat4_identity();
    if (!query->has_file_lights) {
        if (file && file->light_count > 0)
            zr_warning_list_add(root->json.arena, &root->builder->color_warnings,
                                "left out: %u lights of the file; the parameter fileLights uses them",
                                file->light_count);
    } else if (zr_scene_gives(root, ZR_SCENE_LIGHTS)) {
        zr_json_fault(&root->json, ZR_JSON_KEY(ZR_JSON_KEY(NULL, "query"), "fileLights"),
                      "cannot be combined with lights of the query");
    } else {
        zr_model_scene_use_lights(root, file, &up);
    }
}

/* Checks that the reader of the file has found the animation. */
static void check_animation(struct zr_query *query)
{
    struct zr_parsed_scene *root = &query->given;
    const struct zr_model_scene *file = root->builder->file;
    uint32_t number;
    if (query->animation && !(file && zr_model_scene_find_animation(file, query->animation, &number)))
        zr_model_scene_refuse_animation(root, ZR_JSON_KEY(ZR_JSON_KEY(NULL, "query"), "animation"), file,
                                        query->animation);
    if (query->request->time && !query->animation && !(file && file->animation_count > 0))
        zr_warning_list_add(root->json.arena, &root->builder->warnings,
                            "the parameter time has no effect: the file has no animations");
}

/* Adds the frames of an animation of the file, if the query asks for them. */
static void add_frames(struct zr_query *query)
{
    struct zr_parsed_scene *root = &query->given;
    struct zr_json *json = &root->json;
    const struct zr_request *request = query->request;
    const struct zr_model_scene *file = root->builder->file;
    const struct zr_json_path *of_query = ZR_JSON_KEY(NULL, "query"), *path = ZR_JSON_KEY(of_query, "frames"),
                              *end = ZR_JSON_KEY(of_query, "timeEnd");
    struct zr_view_set *set;
    uint32_t number;
    if (!request->frames) {
        if (request->timeEnd) zr_json_fault(json, end, "needs the parameter frames");
        return;
    }
    if (!file || file->animation_count == 0) {
        zr_json_fault(json, path, "the file has no animations");
        return;
    }
    if (!zr_model_scene_find_animation(file, query->animation, &number)) return; /* reported by check_animation */
    const double until = request->timeEnd ? query->time_end : file->animation_end, length = until - query->time;
    if (!(length > 0.0)) {
        zr_json_fault(json, request->timeEnd ? end : path, "an animation without duration: from %.9g to %.9g seconds",
                      query->time, until);
        return;
    }
    if (!zr_view_count_check(json, path, query->frames) || !(set = zr_view_set_add(json, path, root->scene))) return;
    *set =
        (struct zr_view_set){.kind = ZR_VIEW_SET_FILE, .count = query->frames, .seconds = length, .start = query->time};
}

/* Each of the views is a preset, which gives the angles. */
static void check_views(struct zr_query *query)
{
    const struct zr_request *request = query->request;
    if (request->views && (gives_pose(request) || request->camera))
        zr_json_fault(&query->given.json, ZR_JSON_KEY(NULL, "views"),
                      "cannot be combined with preset, azimuth, elevation, eye, target or camera");
}

static void warn(struct zr_parsed_scene *root, const struct zr_request *request)
{
    const struct zr_format_row *format = &zr_format_rows[request->format];
    const int shading = root->face_style.shading;
    for (size_t i = 0; !has_materials(root) && i < request->asset_count; i++)
        zr_warn_of_unused_asset(root->builder, &request->assets[i]);
    if (format->is_soup && !root->scene->picture->is_linear && shading != ZR_UNSET &&
        zr_shading_varies((enum zr_shading)shading))
        zr_warning_list_add(root->json.arena, &root->builder->color_warnings,
                            "shading=%s looks flat here: the triangles of %s share no corners; OBJ can be smooth",
                            zr_shading_names.words[shading], format->name);
    if (root->scene->mesh_count > 0 && root->builder->meshes[0].face_groups && !root->scene->picture->is_linear &&
        shading != ZR_UNSET && zr_shading_varies((enum zr_shading)shading))
        zr_warning_list_add(root->json.arena, &root->builder->color_warnings,
                            "shading=%s ignores the smoothing groups (s) here; looks of linear light use them",
                            zr_shading_names.words[shading]);
    zr_parsed_warn_of_oddities(root);
    zr_parsed_warn_of_materials(root);
}

static enum zr_status build(struct zr_query *query, struct zr_error *error)
{
    struct zr_parsed_scene *root = &query->given;
    const struct zr_keeping *keeping = root->builder->keeping;
    struct zr_error faults = {0};
    root->json.error = &faults;
    root->assets = zr_parsed_assets_of(root->builder, query->request);
    root->images = zr_image_list_of(root->builder, query->request, root->json.limits);
    root->json.assets = &root->assets;
    if (!zr_parsed_read_environment(root) && faults.status == ZR_CANCELLED) return ZR_CANCELLED;
    use_lights(query);
    zr_parsed_use_look(root);
    if (!keeping || !keeping->has_view) {
        use_projection(query);
        use_camera(query);
    }
    check_animation(query);
    add_frames(query);
    check_views(query);
    const bool has_ink = zr_cloud_take_edges(root);
    if (has_materials(root)) {
        zr_model_scene_make_materials(root, root->builder->file);
    } else {
        make_materials(root);
        if (has_ink) zr_cloud_draw_in_ink(query);
        zr_wire_color(query);
    }
    zr_parsed_check_light(root);
    if (has_materials(root)) zr_parsed_drop_maps(root);
    place(query);
    warn(root, query->request);
    zr_query_report(query->request, ZR_BAD_SCENE, &faults, error);
    if (faults.count > 0) return error->status;
    return zr_arena_ok(root->json.arena) ? ZR_OK : ZR_NO_MEMORY;
}

/* From this crease angle on, a warning of doubled faces depends on the number of positions. */
#define ALL_AROUND_DEGREES 179.0f

bool zr_query_shares_places(const struct zr_query *query)
{
    const struct zr_parsed_scene *root = &query->given;
    const struct zr_scene *scene = root->scene;
    if (!root->is_bare || !root->look || !root->look->picture->is_linear) return false;
    const bool is_all_around =
        zr_scene_gives(root, ZR_SCENE_CREASE_DEGREES) && root->picture->given.crease_degrees >= ALL_AROUND_DEGREES;
    return zr_outputs_are_pictures(scene) && !is_all_around && scene->sections.count == 0 &&
           !zr_part_keys_are_given(&scene->parts) && !zr_axis_colors_are_given(scene);
}

enum zr_status zr_query_apply(struct zr_query *query, struct zr_error *error)
{
    struct zr_scene *scene = query->given.builder->scene;
    const struct zr_scene *others = &query->others;
    const bool has_view = zr_format_rows[query->request->format].has_view;
    if (query->compress != ZR_UNSET) scene->compress = (enum zr_compress)query->compress;
    scene->is_strict = query->is_strict;
    if (!has_view) return build(query, error);
    if (zr_scene_gives(&query->given, ZR_SCENE_COLOR_BAR)) scene->color_bar.is_on = others->color_bar.is_on;
    if (zr_scene_gives(&query->given, ZR_SCENE_RENDER)) scene->is_undrawn = others->is_undrawn;
    if (zr_scene_gives(&query->given, ZR_SCENE_FEATURES)) scene->has_features = others->has_features;
    if (zr_scene_gives(&query->given, ZR_SCENE_VISIBILITY))
        scene->views[0].has_visibility = others->views[0].has_visibility;
    if (zr_scene_gives(&query->given, ZR_SCENE_PICKS)) scene->views[0].picks = others->views[0].picks;
    if (zr_scene_gives(&query->given, ZR_SCENE_ANNOTATE))
        scene->views[0].annotate.words = others->views[0].annotate.words;
    if (zr_scene_gives(&query->given, ZR_SCENE_TITLE))
        scene->views[0].annotate.title = others->views[0].annotate.title;
    if (!zr_scene_gives(&query->given, ZR_SCENE_OUTPUTS)) return ZR_OK;
    scene->views[0].outputs = others->views[0].outputs;
    scene->views[0].output_count = others->views[0].output_count;
    return ZR_OK;
}
