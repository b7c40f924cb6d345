/* Reads the view and the poses of the target of the channel flow, as those of the scene. */
#include "input/scene/json_objects.h"
#include "input/scene/json_scene.h"
#include "input/scene/kept.h"
#include "input/view/view_keys.h"
#include "scene/camera/flow.h"
#include "scene/camera/upright.h"
#include "scene/defaults.h"
#include "scene/picture.h"

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
