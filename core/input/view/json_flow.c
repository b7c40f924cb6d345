/* The target of the channel flow. Its view and poses are read after the root, as those of the scene. */
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "input/scene/kept.h"
#include "input/view/view_keys.h"
#include "scene/camera/flow.h"
#include "scene/camera/upright.h"
#include "scene/defaults.h"
#include "scene/picture.h"

enum { VIEW, POSES };
#define AT(member) offsetof(struct zr_parsed_flow, member)
static const struct zr_json_field fields[] = {
    [VIEW] = {"view", zr_json_value_start, AT(view), .object = &zr_json_object_view, .otherwise = "that of the picture",
              .text = "pose and projection of the camera: the name of a preset, or an object",
              .schema = ZR_SCHEMA_OF("scene/properties/view")},
    [POSES] = {"poses", zr_json_value_start, AT(poses), .otherwise = "those of the picture",
               .text = "matrices of nodes, by their names",
               .schema = ZR_SCHEMA({"type" : "object", "additionalProperties" : {"$ref" : "#/$defs/affine"}})}};
#undef AT
static const struct zr_json_rule rules[] = {
    {ZR_RULE_SOME, .text = "neither view nor poses: nothing moves", .sets = {ZR_KEY(VIEW) | ZR_KEY(POSES)}}};
const struct zr_json_object zr_json_object_flow = {
    ZR_JSON_FIELDS("flow", fields), ZR_JSON_RULES(rules),
    .schema =
        ZR_SCHEMA({"dependentSchemas" : {"view" : {"properties" : {"view" : {"properties" : {"camera" : false}}}}}})};

bool zr_read_flow(struct zr_json *json, const struct zr_json_path *path, void *out)
{
    uint64_t keys;
    return zr_json_fields(json, path, &zr_json_object_flow, out, &keys);
}

/* ---- view and poses ---- */

static void find_view(struct zr_parsed_scene *root, const struct zr_json_path *path, struct zr_flow *flow)
{
    const struct zr_scene *scene = root->scene;
    struct zr_scene defaults;
    struct zr_parsed_view given;
    struct zr_json there = zr_json_at(&root->json, root->flow.view);
    zr_scene_defaults(&defaults);
    if (!zr_view_read(&there, path, &defaults.views[0], &given)) return;
    if (zr_view_gives(&given, ZR_VIEW_CAMERA)) {
        zr_json_fault(&there, ZR_VIEW_PATH(&given, ZR_VIEW_CAMERA), "belongs to the scene's view only");
        return;
    }
    flow->has_view = true;
    flow->view = given.view;
    if (scene->picture->z_is_up) zr_view_put_z_up(&flow->view, zr_view_gives(&given, ZR_VIEW_UP));
    if (given.fit_mesh)
        flow->view.fit_to_mesh = zr_parsed_find_mesh(root, ZR_JSON_KEY(ZR_VIEW_PATH(&given, ZR_VIEW_FIT), "mesh"),
                                                     given.fit_mesh, &flow->view.fit_mesh);
}

static void find_matrices(struct zr_parsed_scene *root, const struct zr_json_path *path, struct zr_flow *flow)
{
    uint32_t count = 0;
    const struct zr_parsed_poses poses = {root->flow.poses, path};
    const struct zr_instance *instances = zr_parsed_make_instances(root, &poses, &count);
    zr_mat4 *matrices = instances ? zr_arena_alloc(root->json.arena, count, sizeof *matrices) : NULL;
    for (uint32_t i = 0; matrices && i < count; i++)
        matrices[i] = instances[i].object_to_world;
    flow->matrices = matrices;
}

void zr_parsed_find_flow(struct zr_parsed_scene *root)
{
    const struct zr_json_path *outputs = ZR_SCENE_PATH(ZR_SCENE_OUTPUTS),
                              *output = ZR_JSON_ITEM(outputs, root->flow.output), *path = ZR_JSON_KEY(output, "to");
    struct zr_flow *flow = zr_arena_zero(root->json.arena, 1, sizeof *flow);
    if (!flow) return;
    flow->output = root->flow.output;
    if (root->flow.view) find_view(root, ZR_JSON_KEY(path, "view"), flow);
    if (root->flow.poses) find_matrices(root, ZR_JSON_KEY(path, "poses"), flow);
    root->scene->flow = flow;
}
