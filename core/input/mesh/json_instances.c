/* Makes the instances of a scene, from its nodes or its meshes. */
#include "input/scene/json_scene.h"

/* Nodes place the meshes of the list; without nodes each has the identity. The polygons always have the identity. */
struct zr_instance *zr_parsed_make_instances(struct zr_parsed_scene *root, const struct zr_parsed_poses *poses,
                                             uint32_t *count)
{
    struct zr_scene *scene = root->scene;
    const uint32_t listed = (uint32_t)root->meshes.count, end = listed + zr_parsed_has_polygons(root);
    uint32_t next = root->nodes ? listed : 0;
    *count = 0;
    if (!root->nodes && poses) zr_json_fault(&root->json, poses->path, "the scene has no nodes");
    struct zr_instance *instances =
        root->nodes ? zr_parsed_read_nodes(root, ZR_SCENE_PATH(ZR_SCENE_NODES), poses, scene->meshes, listed, count)
                    : zr_arena_alloc(root->json.arena, end, sizeof *instances);
    if (!instances) return NULL;
    for (; next < end; next++)
        instances[(*count)++] = (struct zr_instance){.mesh = next, .object_to_world = zr_mat4_identity()};
    if (root->camera && !poses)
        zr_parsed_use_model_camera(root, ZR_JSON_KEY(ZR_SCENE_PATH(ZR_SCENE_VIEW), "camera"), instances, *count);
    return zr_parsed_place_models(root, ZR_SCENE_PATH(root->nodes ? ZR_SCENE_NODES : ZR_SCENE_MESHES), instances,
                                  count);
}
