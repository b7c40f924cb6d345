/* The camera of a scene that has the geometry of all frames, each instance as often as it moves. */
#include "views/still_camera.h"

#include <string.h>

#include "base/cancel.h"
#include "base/run.h"
#include "scene/scene.h"
#include "views/view_scene.h"

/* A scene that grows by the frames; only its points count. */
struct gathering {
    struct zr_arena *arena;
    struct zr_scene *scene; /* the first frame, with room for the others */
    struct zr_mesh *meshes;
    struct zr_instance *instances;
    uint32_t *owners;
    size_t mesh_room, instance_room;
    uint32_t first_instances; /* of the first frame */
    const struct zr_mesh *first_meshes;
    uint32_t first_mesh_count;
};

static bool fits_pose(const struct zr_view *view)
{
    if (view->pose == ZR_POSE_ORBIT) return !view->has_target || !(view->distance > 0.0f);
    return view->pose == ZR_POSE_PRESET || view->pose == ZR_POSE_DIRECTION;
}

static bool fits_size(const struct zr_view *view)
{
    return view->projection == ZR_PROJECTION_ORTHOGRAPHIC && !(view->xmag > 0.0f);
}

static const zr_vec4 *points_of(const struct zr_mesh *mesh, uint32_t *count)
{
    *count = mesh->shown ? mesh->shown_count : mesh->position_count;
    return mesh->shown ? mesh->shown : mesh->positions;
}

/* True if two meshes have the same points. */
static bool is_same(const struct zr_mesh *a, const struct zr_mesh *b)
{
    uint32_t of_a, of_b;
    const zr_vec4 *p = points_of(a, &of_a), *q = points_of(b, &of_b);
    return of_a == of_b && (p == q || memcmp(p, q, of_a * sizeof *p) == 0);
}

static uint32_t owner_of(const struct zr_scene *scene, uint32_t mesh)
{
    return scene->mesh_owners ? scene->mesh_owners[mesh] : mesh;
}

/* Makes room for one more item of an array. NULL without memory. */
static void *room_for(struct zr_arena *arena, void *items, size_t count, size_t *room, size_t size)
{
    if (count < *room) return items;
    const size_t more = *room < 8 ? 16 : 2 * *room;
    void *grown = zr_arena_grow(arena, items, count, more, size);
    if (grown) *room = more;
    return grown;
}

/* Adds a mesh of the points of one of a frame; returns its number. UINT32_MAX without memory. */
static uint32_t add_mesh(struct gathering *g, const struct zr_scene *frame, uint32_t number)
{
    const struct zr_mesh *mesh = &frame->meshes[number];
    size_t owners_room = g->mesh_room;
    uint32_t count;
    const zr_vec4 *points = points_of(mesh, &count);
    g->meshes = room_for(g->arena, g->meshes, g->scene->mesh_count, &g->mesh_room, sizeof *g->meshes);
    g->owners = room_for(g->arena, g->owners, g->scene->mesh_count, &owners_room, sizeof *g->owners);
    const zr_vec4 *copy = zr_arena_copy(g->arena, points, count * sizeof *points);
    if (!g->meshes || !g->owners || !copy) return UINT32_MAX;
    const uint32_t at = g->scene->mesh_count++;
    g->owners[at] = owner_of(frame, number);
    g->meshes[at] = (struct zr_mesh){.positions = copy, .position_count = count};
    return at;
}

/* Adds the instances of a frame that differ from those of the first. */
static bool add_frame(struct gathering *g, const struct zr_scene *frame)
{
    uint32_t from = UINT32_MAX, to = 0; /* the mesh that was added last: instances of one mesh often follow another */
    for (uint32_t i = 0; i < frame->instance_count; i++) {
        struct zr_instance instance = frame->instances[i];
        const struct zr_instance *first = i < g->first_instances ? &g->instances[i] : NULL;
        const bool is_there = instance.mesh < g->first_mesh_count &&
                              is_same(&frame->meshes[instance.mesh], &g->first_meshes[instance.mesh]);
        if (is_there && first && first->mesh == instance.mesh &&
            memcmp(&first->object_to_world, &instance.object_to_world, sizeof instance.object_to_world) == 0)
            continue;
        if (!is_there) {
            if (from != instance.mesh) to = add_mesh(g, frame, instance.mesh);
            from = instance.mesh;
            if (to == UINT32_MAX) return false;
            instance.mesh = to;
        }
        instance.node = NULL;
        g->instances =
            room_for(g->arena, g->instances, g->scene->instance_count, &g->instance_room, sizeof *g->instances);
        if (!g->instances) return false;
        g->instances[g->scene->instance_count++] = instance;
    }
    return true;
}

/* Begins with the first frame, which stays in the arena. */
static bool begin(struct gathering *g, const struct zr_scene *first)
{
    g->scene = zr_arena_copy(g->arena, first, sizeof *first);
    g->meshes = zr_arena_copy(g->arena, first->meshes, first->mesh_count * sizeof *first->meshes);
    g->owners = zr_arena_alloc(g->arena, first->mesh_count, sizeof *g->owners);
    g->instances = zr_arena_copy(g->arena, first->instances, first->instance_count * sizeof *first->instances);
    if (!zr_arena_ok(g->arena)) return false;
    for (uint32_t i = 0; i < first->mesh_count; i++)
        g->owners[i] = owner_of(first, i);
    g->mesh_room = g->first_mesh_count = first->mesh_count;
    g->instance_room = g->first_instances = first->instance_count;
    g->first_meshes = first->meshes;
    return true;
}

static enum zr_status gather(const struct zr_run *run, struct gathering *g, const struct zr_views *views)
{
    const struct zr_run keeping = zr_run_in(run, g->arena), inner = zr_run_in(run, run->scratch);
    const struct zr_scene *frame;
    enum zr_status status = zr_view_scene(&keeping, views, 0, &frame);
    if (status == ZR_OK && !begin(g, frame)) status = ZR_NO_MEMORY;
    for (uint32_t i = 1; status == ZR_OK && i < views->set->count; i++) {
        zr_arena_reset(run->scratch, SIZE_MAX);
        run->scratch->ceiling = zr_arena_left(g->arena);
        status = zr_view_scene(&inner, views, i, &frame);
        if (status == ZR_OK && !add_frame(g, frame)) status = ZR_NO_MEMORY;
        if (status == ZR_OK && zr_is_cancelled(run->cancel)) status = ZR_CANCELLED;
    }
    if (status != ZR_OK) return status;
    g->scene->meshes = g->meshes;
    g->scene->instances = g->instances;
    g->scene->mesh_owners = g->owners;
    g->scene->has_box = false;
    return ZR_OK;
}

enum zr_status zr_still_camera_find(const struct zr_run *run, struct zr_views *views)
{
    const struct zr_view *given = &views->scene->views[0];
    struct gathering g = {.arena = run->arena};
    struct zr_camera camera;
    struct zr_error faults = {0};
    const struct zr_run finding = zr_run_reporting(run, &faults);
    struct zr_run gathering = *run;
    struct zr_arena scratch;
    if (!fits_pose(given) && !fits_size(given)) return ZR_OK;
    zr_arena_init(&scratch, zr_arena_left(run->arena));
    gathering.scratch = &scratch;
    enum zr_status status = gather(&gathering, &g, views);
    zr_arena_free(&scratch);
    if (status != ZR_OK) return status;
    const struct zr_bounds bounds = zr_bounds_of(g.scene, run->team, run->cancel);
    status = zr_camera_resolve(&finding, g.scene, &g.scene->views[0], &bounds, &camera);
    if (status != ZR_OK) return zr_view_report(views, 0, status, &faults, run->error);
    views->camera = (struct zr_shared_camera){.is_still = true, .world_to_eye = camera.world_to_eye};
    if (!fits_size(given)) return ZR_OK;
    views->camera.xmag = 1.0f / camera.projection.m[0];
    views->camera.ymag = 1.0f / camera.projection.m[5];
    return ZR_OK;
}
