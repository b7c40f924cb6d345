/* Makes the instances of a scene, from its nodes or its meshes. */
#include "base/matrix.h"
#include "input/mesh/parsed_mesh.h"
#include "input/scene/json_scene.h"
#include "input/text/recenter.h"

/* Returns the numbers that were subtracted from the positions of a mesh; NULL: none. */
static const double *moved_by(const struct zr_parsed_scene *root, uint32_t mesh)
{
    const struct zr_parsed_mesh *given = root->meshes.items;
    if (mesh < root->meshes.count && given[mesh].model) return zr_model_origin(given[mesh].model);
    return zr_far_move(root->json.far, mesh);
}

/* Makes matrices of a far scene again, in doubles: they add what was subtracted from the positions, and subtract the
 * origin of the scene. */
static void place_far(const struct zr_parsed_scene *root, const struct zr_matrix *exact, struct zr_instance *instances,
                      uint32_t count)
{
    const double zero[3] = {0, 0, 0}, *origin = root->json.far->origin;
    for (uint32_t i = 0; i < count; i++) {
        const double *by = moved_by(root, instances[i].mesh), *from = by ? by : zero;
        const double v[4] = {from[0], from[1], from[2], 1.0};
        float *m = instances[i].object_to_world.m;
        double at[4];
        zr_matrix_apply(&exact[i], v, at);
        for (int k = 0; k < 16; k++)
            m[k] = (float)exact[i].m[k];
        for (int axis = 0; axis < 3; axis++)
            m[12 + axis] = (float)(at[axis] - origin[axis]);
    }
}

/* Nodes place the meshes of the list; without nodes each has the identity. The polygons always have the identity. */
struct zr_instance *zr_parsed_make_instances(struct zr_parsed_scene *root, const struct zr_parsed_poses *poses,
                                             uint32_t *count)
{
    struct zr_scene *scene = root->scene;
    const uint32_t listed = (uint32_t)root->meshes.count, end = listed + zr_parsed_has_polygons(root);
    const zr_mat4 identity = zr_mat4_identity();
    uint32_t next = root->nodes ? listed : 0;
    *count = 0;
    if (!root->nodes && poses) zr_json_fault(&root->json, poses->path, "the scene has no nodes");
    struct zr_instance *instances =
        root->nodes ? zr_parsed_read_nodes(root, ZR_SCENE_PATH(ZR_SCENE_NODES), poses, scene->meshes, listed, count)
                    : zr_arena_alloc(root->json.arena, end, sizeof *instances);
    if (root->json.far && !root->nodes) root->exact = zr_arena_alloc(root->json.arena, end, sizeof *root->exact);
    if (!instances || (root->json.far && !root->exact)) return NULL;
    for (; next < end; next++) {
        if (root->json.far) root->exact[*count] = zr_matrix_of(&identity);
        instances[(*count)++] = (struct zr_instance){.mesh = next, .object_to_world = identity};
    }
    if (root->json.far) place_far(root, root->exact, instances, *count);
    if (root->camera && !poses)
        zr_parsed_use_model_camera(root, ZR_JSON_KEY(ZR_SCENE_PATH(ZR_SCENE_VIEW), "camera"), instances, *count);
    return zr_parsed_place_models(root, ZR_SCENE_PATH(root->nodes ? ZR_SCENE_NODES : ZR_SCENE_MESHES), instances,
                                  count);
}
