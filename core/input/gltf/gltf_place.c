/* Makes instances of the meshes that the nodes of glTF place. */
#include "input/gltf/gltf_extensions.h"

#include "base/cancel.h"
#include "input/formats/quick.h"
#include "input/json/json_placement.h"

/* ---- instances ---- */

/* Makes one instance per primitive of the mesh and per pose of its instancing. */
static void put_instances(const struct zr_gltf_use *use, const struct zr_instance *placed,
                          const struct zr_matrix *exact, struct zr_instance **next, struct zr_matrix **next_exact)
{
    const zr_mat4 identity = zr_mat4_identity();
    for (uint32_t pose = 0; pose < (use->poses ? use->pose_count : 1); pose++)
        for (uint32_t k = 0; k < use->count; k++, ++*next) {
            **next = *placed;
            (*next)->mesh = use->first + k;
            if (use->skin != ZR_GLTF_NONE)
                (*next)->object_to_world = zr_mat4_identity(); /* its vertices are in world space */
            else if (use->poses)
                (*next)->object_to_world = zr_mat4_mul(&placed->object_to_world, &use->poses[pose]);
            if (!exact) continue;
            const zr_mat4 *local = use->skin == ZR_GLTF_NONE && use->poses ? &use->poses[pose] : &identity;
            const struct zr_matrix of_pose = zr_matrix_of(local);
            *(*next_exact)++ = use->skin != ZR_GLTF_NONE ? of_pose : zr_matrix_mul(exact, &of_pose);
        }
}

static bool expand(struct zr_gltf *file, const struct zr_placement *placement, struct zr_matrix **exact)
{
    struct zr_model_scene *made = file->made;
    struct zr_json *json = &file->json;
    uint64_t count = 0;
    for (uint32_t i = 0; i < placement->count; i++) {
        struct zr_gltf_use *use = &file->uses[placement->instances[i].mesh];
        if (use->instancing && !zr_gltf_read_poses(file, use)) return false;
        count += use->count * (uint64_t)(use->poses ? use->pose_count : 1);
    }
    if (count > json->limits->instances_max)
        return zr_json_fault(json, ZR_JSON_KEY(NULL, zr_gltf_word(ZR_GLTF_NODES)),
                             "the nodes place %llu primitives of meshes; %u are allowed", (unsigned long long)count,
                             json->limits->instances_max);
    struct zr_instance *next = made->instances = zr_arena_alloc(json->arena, (size_t)count, sizeof *next);
    struct zr_matrix *next_exact = *exact =
        placement->exact ? zr_arena_alloc(json->arena, (size_t)count, sizeof *next_exact) : NULL;
    if (!next || (placement->exact && !next_exact)) return false;
    for (uint32_t i = 0; i < placement->count; i++)
        put_instances(&file->uses[placement->instances[i].mesh], &placement->instances[i],
                      placement->exact ? &placement->exact[i] : NULL, &next, &next_exact);
    made->instance_count = (uint32_t)count;
    return true;
}

/* ---- far from the origin ---- */

/* Makes the local matrices of all nodes in double.
 * Uses the exact translation of the file unless an animation moves the node. */
static struct zr_matrix *find_exact(struct zr_gltf *file)
{
    const struct zr_gltf_nodes *all = file->nodes;
    struct zr_matrix *exact = zr_arena_alloc(file->json.arena, all->count, sizeof *exact);
    for (uint32_t i = 0; exact && i < all->count; i++) {
        exact[i] = zr_matrix_of(&all->nodes[i].local);
        for (int axis = 0; axis < 3; axis++)
            if ((float)all->exact[i][axis] == all->nodes[i].local.m[12 + axis])
                exact[i].m[12 + axis] = all->exact[i][axis];
    }
    return exact;
}

/* Subtracts the origin from the positions of the cameras. */
static void move_cameras(struct zr_gltf *file, const struct zr_matrix *locals, const double *origin)
{
    const struct zr_gltf_nodes *all = file->nodes;
    for (uint32_t k = 0; k < file->made->camera_count; k++) {
        struct zr_model_camera *camera = &file->made->cameras[k];
        uint32_t node = 0;
        while (node < all->count && !(all->is_drawn[node] && all->cameras[node] == camera->number))
            node++;
        if (node == all->count) continue;
        struct zr_matrix world = locals[node];
        for (uint32_t up = all->parents[node]; up != ZR_GLTF_NONE; up = all->parents[up])
            world = zr_matrix_mul(&locals[up], &world);
        for (int axis = 0; axis < 3; axis++)
            camera->camera_to_world.m[12 + axis] = (float)(world.m[12 + axis] - origin[axis]);
    }
}

/* Subtracts the origin from the positions of the lights, which were rounded to float before. */
static void move_lights(struct zr_model_scene *made, const double *origin)
{
    for (uint32_t i = 0; i < made->light_count; i++) {
        zr_vec3 *at = &made->lights[i].position;
        *at = (zr_vec3){(float)((double)at->x - origin[0]), (float)((double)at->y - origin[1]),
                        (float)((double)at->z - origin[2])};
    }
}

/* Places the meshes again with matrices in double if they are far from the origin, and subtracts their middle. */
static void place_far(struct zr_gltf *file, struct zr_nodes *hierarchy)
{
    struct zr_json *json = &file->json;
    struct zr_model_scene *made = file->made;
    struct zr_scene *scene = file->builder->scene;
    struct zr_matrix *exact;
    struct zr_recenter_scene far = {
        .count = made->instance_count, .instances = made->instances, .meshes = scene->meshes, .moves = file->moves};
    if (!zr_recenter_instances_needed(&far, json->limits)) return;
    hierarchy->exact = find_exact(file);
    if (!hierarchy->exact) return;
    const struct zr_placement placement =
        zr_nodes_place(json->arena, hierarchy, json->limits->instances_max, UINT64_MAX);
    if (!zr_arena_ok(json->arena) || zr_is_cancelled(json->cancel) || !expand(file, &placement, &exact)) return;
    far.instances = made->instances;
    far.exact = exact;
    const struct zr_run run = zr_json_run(json);
    if (zr_recenter_instances(&run, json->limits, &far, &scene->origin) == ZR_OK && scene->origin) {
        move_cameras(file, hierarchy->exact, scene->origin);
        move_lights(made, scene->origin);
    }
}

void zr_gltf_place(struct zr_gltf *file)
{
    struct zr_arena *arena = file->json.arena;
    const struct zr_gltf_nodes *all = file->nodes;
    struct zr_nodes hierarchy = {
        .count = all->count, .child_count = all->child_count, .nodes = all->nodes, .children = all->children};
    struct zr_quick *quick = file->assets.quick;
    if (quick && all->count > quick->node_visits_max) {
        zr_quick_exceed(quick, file->json.error);
        return;
    }
    const struct zr_placement placement =
        zr_nodes_place(arena, &hierarchy, file->json.limits->instances_max, UINT64_MAX);
    if (!zr_arena_ok(arena) || zr_is_cancelled(arena->cancel) ||
        !zr_json_check_placement(&file->json, ZR_JSON_KEY(NULL, zr_gltf_word(ZR_GLTF_NODES)), all->count, "children",
                                 &placement))
        return;
    struct zr_matrix *exact;
    if (expand(file, &placement, &exact)) place_far(file, &hierarchy);
}
