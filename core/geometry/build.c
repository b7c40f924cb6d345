#include "geometry/build.h"

#include <stdatomic.h>

#include "base/prefetch.h"
#include "geometry/assemble.h"

/* From this number on, vertices exceed the share of a core's caches. Non-temporal stores then take 7 to 11 % off the
 * time of a million triangles after other work; a mesh drawn repeatedly takes up to a tenth longer. */
enum { VERTICES_A_RANGE = 4096, STREAMED_VERTICES = 1 << 17 };

struct placing {
    const struct zr_builder *builder;
    struct zr_window_vertex *out;
    zr_transform_fn *transform;
    bool streamed;
    atomic_uint any_outcodes;
};

static void place_vertices(void *argument, size_t begin, size_t end)
{
    struct placing *placing = argument;
    const struct zr_builder *builder = placing->builder;
    unsigned any = placing->transform(&builder->object_to_clip, &builder->viewport, builder->mesh->positions + begin,
                                      end - begin, placing->out + begin, builder->outcodes + begin, placing->streamed);
    if (any) atomic_fetch_or_explicit(&placing->any_outcodes, any, memory_order_relaxed);
}

/* Fixed work per instance, in corners. */
enum { INSTANCE_WORK = 64 };

/* Allocates room for the vertices of all instances, and for the outcodes of the largest. Returns false if the arena
 * failed. */
static bool make_room(struct zr_builder *builder)
{
    const struct zr_scene *scene = builder->scene;
    struct zr_geometry *geometry = builder->geometry;
    uint64_t vertices = 0;
    uint32_t most = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const uint32_t count = scene->meshes[scene->instances[i].mesh].position_count;
        vertices += count;
        if (count > most) most = count;
    }
    if (!zr_builder_reserve_vertices(builder, vertices)) return false;
    geometry->instances = zr_arena_alloc(builder->arena, scene->instance_count, sizeof *geometry->instances);
    geometry->draws = zr_arena_zero(builder->arena, 1, sizeof *geometry->draws);
    builder->draw_room = 1;
    builder->outcodes = zr_arena_alloc(builder->arena, most, sizeof *builder->outcodes);
    builder->fans = zr_arena_zero(builder->arena, scene->mesh_count, sizeof *builder->fans);
    return zr_arena_ok(builder->arena);
}

static enum zr_status build_instance(struct zr_builder *builder, const struct zr_camera *camera,
                                     const struct zr_instance *instance)
{
    struct zr_geometry *geometry = builder->geometry;
    const struct zr_mesh *mesh = &builder->scene->meshes[instance->mesh];
    builder->mesh = mesh;
    builder->instance = (uint32_t)(instance - builder->scene->instances);
    if (!zr_builder_go_on(builder, INSTANCE_WORK + mesh->position_count)) return ZR_CANCELLED;
    if (mesh->face_offsets[mesh->face_count] > ZR_GEOMETRY_MAX ||
        !zr_builder_reserve_vertices(builder, mesh->position_count))
        return ZR_NO_MEMORY;

    builder->first_vertex = geometry->vertex_count;
    builder->mirrored = zr_mat4_is_mirror(&camera->world_to_eye) != zr_mat4_is_mirror(&instance->object_to_world);
    builder->object_to_eye = zr_mat4_mul(&camera->world_to_eye, &instance->object_to_world);
    builder->object_to_clip = zr_mat4_mul(&camera->projection, &builder->object_to_eye);
    struct placing placing = {.builder = builder,
                              .out = geometry->vertices + geometry->vertex_count,
                              .transform = zr_transform_of(zr_team_isa(builder->team))};
    placing.streamed = mesh->position_count >= STREAMED_VERTICES && (uintptr_t)placing.out % ZR_CACHE_LINE == 0;
    zr_team_ranges(builder->team, mesh->position_count, VERTICES_A_RANGE, place_vertices, &placing);
    builder->any_outcodes = placing.any_outcodes;
    geometry->vertex_count += mesh->position_count;
    geometry->instances[builder->instance] =
        zr_source_instance_make(camera, &instance->object_to_world, mesh, builder->first_vertex);
    return zr_assemble_mesh(builder);
}

enum zr_status zr_geometry_build(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                 const struct zr_camera *camera, const struct zr_window *window,
                                 const struct zr_cancel *cancel, bool singly, struct zr_geometry *geometry)
{
    *geometry = (struct zr_geometry){.window = *window};
    struct zr_builder builder = {.arena = arena,
                                 .team = team,
                                 .cancel = cancel,
                                 .scene = scene,
                                 .geometry = geometry,
                                 .singly = singly,
                                 .viewport = zr_viewport_make(window->width, window->height),
                                 .cutting.triangulator.loops.cancel = cancel,
                                 .first_face_id = 1};
    if (!make_room(&builder)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_instance *instance = &scene->instances[i];
        enum zr_status status = build_instance(&builder, camera, instance);
        if (status != ZR_OK) return status;
        builder.first_face_id += (uint32_t)zr_mesh_ids(&scene->meshes[instance->mesh]);
    }
    return zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}
