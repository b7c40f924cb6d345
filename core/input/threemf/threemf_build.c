/* Places the meshes of 3MF: build items and components become nodes. */
#include <inttypes.h>

#include "input/formats/quick.h"
#include "input/model/model_scene.h"
#include "input/threemf/threemf_file.h"
#include "render_request.h"
#include "scene/parts/nodes.h"

/* Nodes: first the build items, then one range per used object: its components. */
struct build {
    struct zr_threemf *file;
    struct zr_threemf_list nodes;   /* struct zr_node */
    struct zr_threemf_list targets; /* uint32_t: per node, the resource that it names, or ZR_THREEMF_NONE */
    struct zr_threemf_list sources; /* const struct zr_threemf_link *: per node */
};

/* Finds the object of a link. ZR_THREEMF_NONE if it is left out, or after a fault. */
static uint32_t find_object(struct zr_threemf *file, const struct zr_threemf_link *link)
{
    const struct zr_threemf_resource *object = zr_threemf_find(file, link->target_part, link->id);
    file->part = link->part;
    if (!object || object->kind != ZR_THREEMF_OBJECT) {
        zr_threemf_fault(file, link->at, "objectid %u names no object", link->id);
        return ZR_THREEMF_NONE;
    }
    if (object->is_left_out || link->is_left_out) {
        zr_threemf_note(file, object->is_left_out ? ZR_THREEMF_NOTE_OTHER : ZR_THREEMF_NOTE_MODIFIER, link->at,
                        (struct zr_xml_text){"", 0});
        return ZR_THREEMF_NONE;
    }
    return (uint32_t)(object - zr_threemf_resources(file));
}

/* Scales the coordinates of an object to the unit of the part that places it. */
static void convert_unit(const struct zr_threemf *file, const struct zr_threemf_link *link, zr_mat4 *local)
{
    const double from = zr_threemf_parts(file)[link->target_part].microns,
                 to = zr_threemf_parts(file)[link->part].microns;
    if (!(from > 0.0 && to > 0.0) || from == to) return;
    for (int i = 0; i < 12; i++)
        local->m[i] = (float)((double)local->m[i] * (from / to));
}

static void add_node(struct build *build, const struct zr_threemf_link *link)
{
    struct zr_arena *arena = build->file->arena;
    const uint32_t target = find_object(build->file, link);
    struct zr_threemf_resource *object = target == ZR_THREEMF_NONE ? NULL : &zr_threemf_resources(build->file)[target];
    if (object && object->extruder == 0) object->extruder = link->extruder;
    struct zr_node *node = zr_threemf_list_add(arena, &build->nodes, sizeof *node);
    uint32_t *to = zr_threemf_list_add(arena, &build->targets, sizeof *to);
    const struct zr_threemf_link **from = zr_threemf_list_add(arena, &build->sources, sizeof *from);
    zr_mat4 local = link->transform;
    if (!node || !to || !from) return;
    convert_unit(build->file, link, &local);
    *to = target;
    *from = link;
    *node = (struct zr_node){.local = local,
                             .mesh = object && object->mesh != ZR_THREEMF_NONE ? object->mesh : ZR_NODE_NO_MESH,
                             .name = object && *object->name ? object->name : NULL};
}

/* Adds the nodes of the build, then those of each used object, once, in the order of first use. */
static void add_nodes(struct build *build)
{
    struct zr_threemf *file = build->file;
    const struct zr_threemf_link *items = file->items.items, *links = file->links.items;
    for (uint32_t i = 0; i < file->items.count && !zr_threemf_stops(file); i++)
        add_node(build, &items[i]);
    for (uint32_t next = 0; next < build->nodes.count && !zr_threemf_stops(file); next++) {
        const uint32_t target = ((const uint32_t *)build->targets.items)[next];
        if (zr_is_cancelled(file->cancel)) return;
        if (target == ZR_THREEMF_NONE) continue;
        struct zr_threemf_resource *object = &zr_threemf_resources(file)[target];
        if (object->link_count == 0 || object->first_node != ZR_THREEMF_NONE) continue;
        object->first_node = build->nodes.count;
        for (uint32_t i = 0; i < object->link_count; i++)
            add_node(build, &links[object->first_link + i]);
    }
}

/* Sets each node's children: the range of its object's components. Entry i of all children is node items + i. */
static struct zr_nodes join(struct build *build)
{
    struct zr_threemf *file = build->file;
    const uint32_t items = file->items.count, count = build->nodes.count;
    struct zr_node *nodes = build->nodes.items;
    uint32_t *children = zr_arena_alloc(file->arena, count - items, sizeof *children);
    struct zr_nodes all = {count, count - items, nodes, children, NULL};
    for (uint32_t i = 0; children && i < count; i++) {
        const uint32_t target = ((const uint32_t *)build->targets.items)[i];
        if (i >= items) children[i - items] = i;
        if (target == ZR_THREEMF_NONE || zr_threemf_resources(file)[target].link_count == 0) continue;
        nodes[i].first_child = zr_threemf_resources(file)[target].first_node - items;
        nodes[i].child_count = zr_threemf_resources(file)[target].link_count;
    }
    return all;
}

static void report(struct build *build, const struct zr_placement *placement, uint64_t visits_max)
{
    struct zr_threemf *file = build->file;
    const struct zr_threemf_link *link = ((const struct zr_threemf_link *const *)build->sources.items)[placement->node];
    file->part = link->part;
    switch (placement->fault) {
    case ZR_NODES_GOOD:
        break;
    case ZR_NODES_CYCLE:
        zr_threemf_fault(file, link->at, "a cycle: object %u has itself among its components", link->id);
        break;
    case ZR_NODES_TOO_DEEP:
        zr_threemf_fault(file, link->at, "components nested more than %d deep", ZR_NODES_DEPTH_MAX - 1);
        break;
    case ZR_NODES_TOO_MANY:
        zr_error_add(file->error, ZR_BAD_SCENE, NULL, "the build places more than the limit of %u meshes",
                     file->limits->instances_max);
        break;
    case ZR_NODES_TOO_MANY_VISITS:
        zr_error_add(file->error, ZR_BAD_SCENE, NULL,
                     "components are visited %" PRIu64 " times; %" PRIu64 " visits are allowed", placement->visits,
                     visits_max);
        break;
    case ZR_NODES_OUT_OF_RANGE:
        zr_threemf_fault(file, link->at, "the transform to the build's space has an entry beyond %g",
                         (double)ZR_MATRIX_MAX);
        break;
    }
}

/* Moves the placed meshes to the builder, in the order of the file. */
static bool keep_placed(struct zr_threemf *file, struct zr_scene_builder *builder, const struct zr_request *request,
                        struct zr_model_scene *scene)
{
    const struct zr_mesh *all = file->meshes.items;
    uint32_t *numbers = zr_arena_zero(file->arena, file->meshes.count, sizeof *numbers), kept = 0;
    for (uint32_t i = 0; numbers && i < scene->instance_count; i++)
        numbers[scene->instances[i].mesh] = 1;
    for (uint32_t i = 0; numbers && i < file->meshes.count; i++)
        numbers[i] = numbers[i] ? kept++ : ZR_THREEMF_NONE;
    struct zr_mesh *meshes = numbers ? zr_scene_builder_meshes(builder, kept) : NULL;
    uint32_t **textures = zr_arena_alloc(file->arena, kept, sizeof *textures);
    if (!meshes || !textures) return false;
    for (uint32_t i = 0; i < file->resources.count; i++) {
        const struct zr_threemf_resource *object = &zr_threemf_resources(file)[i];
        if (object->mesh == ZR_THREEMF_NONE || numbers[object->mesh] == ZR_THREEMF_NONE) continue;
        meshes[numbers[object->mesh]] = all[object->mesh];
        meshes[numbers[object->mesh]].name = object->name;
        zr_threemf_color_by_extruders(file, &meshes[numbers[object->mesh]],
                                      ((uint8_t **)file->extruders.items)[object->mesh], object);
        textures[numbers[object->mesh]] = ((uint32_t **)file->textures.items)[object->mesh];
    }
    for (uint32_t i = 0; i < scene->instance_count; i++)
        scene->instances[i].mesh = numbers[scene->instances[i].mesh];
    builder->file = scene;
    return zr_threemf_make_materials(file, builder, request, scene, kept, textures);
}

static enum zr_status refuse_empty(struct zr_threemf *file)
{
    const struct zr_xml_text word = file->notes[ZR_THREEMF_NOTE_REQUIRED].word;
    const bool is_required = file->notes[ZR_THREEMF_NOTE_REQUIRED].count > 0;
    return zr_error_add(file->error, ZR_BAD_SCENE, NULL, "no geometry: the build places no triangle%s%.*s%s",
                        is_required ? "; the required extension of " : "", is_required ? (int)word.length : 0,
                        is_required ? word.at : "", is_required ? " is not read" : "");
}

/* Moves the instances of meshes with triangles to the front; returns their number. */
static uint32_t drop_empty(const struct zr_threemf *file, struct zr_instance *instances, uint32_t count)
{
    const struct zr_mesh *meshes = file->meshes.items;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++)
        if (meshes[instances[i].mesh].face_count > 0) instances[kept++] = instances[i];
    return kept;
}

/* Returns the local matrices of all nodes in double. NULL without memory. */
static struct zr_matrix *find_exact(const struct build *build)
{
    const struct zr_node *nodes = build->nodes.items;
    const struct zr_threemf_link *const *links = build->sources.items;
    struct zr_matrix *exact = zr_arena_alloc(build->file->arena, build->nodes.count, sizeof *exact);
    for (uint32_t i = 0; exact && i < build->nodes.count; i++) {
        exact[i] = zr_matrix_of(&nodes[i].local);
        for (int axis = 0; axis < 3; axis++)
            exact[i].m[12 + axis] = links[i]->offset[axis];
    }
    return exact;
}

/* Places the meshes again with matrices in double if they are far from the origin, and subtracts their middle. */
static enum zr_status place_far(const struct build *build, struct zr_scene_builder *builder, struct zr_nodes *nodes,
                                uint64_t allowed, struct zr_placement *placement)
{
    const struct zr_threemf *file = build->file;
    struct zr_recenter_scene scene = {.count = placement->count,
                                      .instances = placement->instances,
                                      .meshes = file->meshes.items,
                                      .moves = file->moves.items};
    if (!zr_recenter_instances_needed(&scene, file->limits)) return ZR_OK;
    nodes->exact = find_exact(build);
    if (!nodes->exact) return ZR_NO_MEMORY;
    *placement = zr_nodes_place(file->arena, nodes, file->limits->instances_max, allowed);
    if (zr_is_cancelled(file->cancel)) return ZR_CANCELLED;
    if (!zr_arena_ok(file->arena)) return ZR_NO_MEMORY;
    scene.instances = placement->instances;
    scene.exact = placement->exact;
    const struct zr_run run = {.arena = file->arena, .cancel = file->cancel, .error = file->error};
    return zr_recenter_instances(&run, file->limits, &scene, &builder->scene->origin);
}

enum zr_status zr_threemf_place(struct zr_threemf *file, struct zr_scene_builder *builder,
                                const struct zr_request *request)
{
    struct build build = {.file = file};
    struct zr_quick *quick = request->quick;
    add_nodes(&build);
    if (zr_is_cancelled(file->cancel)) return ZR_CANCELLED;
    if (!zr_arena_ok(file->arena)) return ZR_NO_MEMORY;
    if (file->error->count > 0) return file->error->status;
    struct zr_nodes nodes = join(&build);
    struct zr_model_scene *scene = zr_arena_zero(file->arena, 1, sizeof *scene);
    if (!scene || !nodes.children) return ZR_NO_MEMORY;
    const uint64_t most = (uint64_t)ZR_NODE_VISITS_PER_INSTANCE * file->limits->instances_max + nodes.count;
    const uint64_t allowed = quick && quick->node_visits_max < most ? quick->node_visits_max : most;
    struct zr_placement placement = zr_nodes_place(file->arena, &nodes, file->limits->instances_max, allowed);
    if (placement.fault == ZR_NODES_TOO_MANY_VISITS && placement.visits <= most)
        return zr_quick_exceed(quick, file->error);
    if (zr_is_cancelled(file->cancel)) return ZR_CANCELLED;
    if (!zr_arena_ok(file->arena)) return ZR_NO_MEMORY;
    if (placement.fault != ZR_NODES_GOOD) {
        report(&build, &placement, most);
        return file->error->status;
    }
    const enum zr_status status = place_far(&build, builder, &nodes, allowed, &placement);
    if (status != ZR_OK) return status;
    scene->instances = placement.instances;
    scene->instance_count = drop_empty(file, placement.instances, placement.count);
    if (scene->instance_count == 0) return refuse_empty(file);
    if (keep_placed(file, builder, request, scene)) return ZR_OK;
    return zr_is_cancelled(file->cancel) ? ZR_CANCELLED : file->error->count > 0 ? file->error->status : ZR_NO_MEMORY;
}
