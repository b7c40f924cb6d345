#include "geometry/build.h"

#include <stdatomic.h>
#include <string.h>

#include "base/expect.h"
#include "geometry/assemble.h"
#include "geometry/face.h"

/* So many vertices are more than what the caches of a core have to spare. Written past these, a million triangles take
 * 7 to 11 % less time after other work; where the same mesh is drawn again and again, up to a tenth more. */
enum { VERTICES_A_RANGE = 4096, STREAMED_VERTICES = 1 << 17 };

/* Whether any polygon can show a lit back: only then do its colours differ. */
static bool shows_backs(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++)
        if (scene->materials[i].double_sided && zr_material_is_lit_before(&scene->materials[i])) return true;
    return false;
}

static bool shades_late(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++)
        if (zr_material_is_shaded_late(&scene->materials[i])) return true;
    return false;
}

struct placing {
    struct zr_builder *builder;
    struct zr_window_vertex *out;
    zr_transform_fn *transform;
    bool streamed;
    atomic_uint any_outcodes;
};

static void place_vertices(void *argument, size_t begin, size_t end)
{
    struct placing *placing = argument;
    struct zr_builder *builder = placing->builder;
    unsigned any = placing->transform(&builder->object_to_clip, &builder->viewport, builder->mesh->positions + begin,
                                      end - begin, placing->out + begin, builder->outcodes + begin, placing->streamed);
    for (size_t i = begin; builder->points && i < end; i++)
        builder->geometry->points[builder->geometry->vertex_count + i] = zr_builder_point(builder, (uint32_t)i);
    if (any) atomic_fetch_or_explicit(&placing->any_outcodes, any, memory_order_relaxed);
}

/* Records that are written out want floats. */
static bool packs_colors(const struct zr_builder *builder, const struct zr_mesh *mesh)
{
    return !builder->written && zr_colors_can_be_packed(builder->scene, mesh);
}

/* What any instance takes, in corners. */
enum { INSTANCE_WORK = 64 };

/* Of triangles, only those are written out that the window cuts. */
enum { CUT_AT_FIRST = 4096 };

struct room {
    uint64_t vertices, colors, packed;
    uint32_t most; /* positions of a mesh */
};

static void add_instance(const struct zr_builder *builder, const struct zr_mesh *mesh, struct room *room)
{
    struct zr_colors given;
    room->vertices += mesh->position_count;
    if (mesh->position_count > room->most) room->most = mesh->position_count;
    if (builder->uncolored || zr_colors_are_given(builder->scene, mesh, &given)) return;
    uint32_t written = zr_colors_count(builder->scene, mesh);
    if (packs_colors(builder, mesh)) {
        room->packed += (uint64_t)mesh->face_count << builder->separate_backs;
        if (zr_mesh_is_of_triangles(mesh) && written > CUT_AT_FIRST) written = CUT_AT_FIRST;
    }
    room->colors += written;
}

/* Room for what all instances are sure to fill, and mostly for what they may, so that arrays need not move as they
 * grow, and for the outcodes of one at a time. False where the arena has failed. */
static bool make_room(struct zr_builder *builder, const struct zr_scene *scene)
{
    struct room room = {0};
    for (uint32_t i = 0; i < scene->instance_count; i++)
        add_instance(builder, &scene->meshes[scene->instances[i].mesh], &room);
    if (!zr_builder_reserve(builder, room.vertices, room.colors, 0)) return false;
    if (builder->some_normals && !zr_builder_reserve_normals(builder, 0)) return false;
    struct zr_sources *sources = &builder->geometry->sources;
    sources->instances = zr_arena_alloc(builder->arena, scene->instance_count, sizeof *sources->instances);
    builder->packed = zr_arena_alloc(builder->arena, room.packed, sizeof *builder->packed);
    builder->outcodes = zr_arena_alloc(builder->arena, room.most, sizeof *builder->outcodes);
    builder->geometry->batches = zr_arena_zero(builder->arena, 1, sizeof *builder->geometry->batches);
    builder->batch_room = 1;
    builder->fans = zr_arena_zero(builder->arena, scene->mesh_count, sizeof *builder->fans);
    builder->vertex_normals = zr_arena_zero(builder->arena, scene->mesh_count, sizeof *builder->vertex_normals);
    return zr_arena_ok(builder->arena);
}

/* The one colour of all records that are written out where colours are not made. */
static bool put_no_color(struct zr_builder *builder)
{
    struct zr_geometry *g = builder->geometry;
    if (!zr_builder_reserve(builder, 0, 1, 0)) return false;
    g->front_colors[0] = g->back_colors[0] = (zr_vec4){0, 0, 0, 0};
    g->color_count = 1;
    return true;
}

/* The mesh's own colours where they will do, else made for this instance. */
static bool make_colors(struct zr_builder *builder)
{
    const struct zr_mesh *mesh = builder->mesh;
    if (builder->uncolored) {
        builder->colors = (struct zr_colors){.layout = ZR_COLOR_NONE};
        return true;
    }
    if (zr_colors_are_given(builder->scene, mesh, &builder->colors)) return true;
    if (packs_colors(builder, mesh)) {
        builder->colors = zr_colors_make_packed(builder->team, builder->cancel, builder->scene, mesh, builder->lighting,
                                                &builder->object_to_eye, builder->separate_backs, builder->packed);
        builder->packed += (size_t)mesh->face_count << builder->separate_backs;
        return true;
    }
    return zr_builder_make_colors(builder);
}

static enum zr_status build_instance(struct zr_builder *builder, const struct zr_camera *camera,
                                     const struct zr_instance *instance)
{
    struct zr_geometry *geometry = builder->geometry;
    const struct zr_mesh *mesh = &builder->scene->meshes[instance->mesh];
    builder->mesh = mesh;
    memset(builder->normals, 0, sizeof builder->normals);
    builder->flat_face = 0;
    builder->instance = (uint32_t)(instance - builder->scene->instances);
    if (!zr_builder_go_on(builder, INSTANCE_WORK + mesh->position_count)) return ZR_CANCELLED;
    if (!zr_builder_reserve(builder, mesh->position_count, 0, 0)) return ZR_NO_MEMORY;

    builder->object_to_eye = zr_mat4_mul(&camera->world_to_eye, &instance->object_to_world);
    builder->object_to_clip = zr_mat4_mul(&camera->projection, &builder->object_to_eye);
    struct placing placing = {.builder = builder,
                              .out = geometry->vertices + geometry->vertex_count,
                              .transform = zr_transform_of(zr_team_isa(builder->team))};
    placing.streamed = mesh->position_count >= STREAMED_VERTICES && (uintptr_t)placing.out % ZR_CACHE_LINE == 0;
    zr_team_ranges(builder->team, mesh->position_count, VERTICES_A_RANGE, place_vertices, &placing);
    builder->any_outcodes = placing.any_outcodes;
    builder->mirrored = zr_mat4_is_mirror(&instance->object_to_world);
    builder->first_vertex = geometry->vertex_count;
    geometry->sources.instances[geometry->sources.instance_count++] =
        zr_source_instance_make(camera, &instance->object_to_world, mesh, builder->first_vertex);
    geometry->vertex_count += mesh->position_count;
    return make_colors(builder) ? zr_assemble_mesh(builder) : ZR_NO_MEMORY;
}

enum zr_status zr_geometry_build(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                 const struct zr_camera *camera, const struct zr_cancel *cancel, bool written,
                                 struct zr_geometry *geometry)
{
    *geometry = (struct zr_geometry){.vertex_count = 0};
    struct zr_builder builder = {.arena = arena,
                                 .team = team,
                                 .cancel = cancel,
                                 .scene = scene,
                                 .geometry = geometry,
                                 .written = written,
                                 .lighting = &geometry->lighting,
                                 .cutting.triangulator.loops.cancel = cancel};
    builder.uncolored = !zr_scene_wants(scene, ZR_CHANNEL_COLOR);
    builder.separate_backs = !builder.uncolored && shows_backs(scene);
    builder.all_normals = zr_scene_wants(scene, ZR_CHANNEL_NORMALS);
    builder.points = !builder.uncolored && shades_late(scene);
    builder.eye = zr_camera_eye(camera);
    builder.some_normals = builder.all_normals || builder.points;
    builder.viewport = zr_viewport_make(scene->width, scene->height);
    zr_lighting_make(arena, scene, &camera->world_to_eye, &geometry->lighting);

    if (!make_room(&builder, scene) || (builder.uncolored && !put_no_color(&builder))) return ZR_NO_MEMORY;
    builder.first_face_id = 1;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_instance *instance = &scene->instances[i];
        enum zr_status status = build_instance(&builder, camera, instance);
        if (status != ZR_OK) return status;
        builder.first_face_id += (uint32_t)zr_mesh_ids(&scene->meshes[instance->mesh]);
    }
    return zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}
