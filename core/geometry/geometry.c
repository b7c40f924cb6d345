#include "geometry/geometry.h"

#include "geometry/assemble.h"
#include "geometry/clip.h"
#include "geometry/colors.h"

enum { VERTICES_A_RANGE = 4096 };

/* Whether any polygon can show a lit back: only then do its colours differ. */
static bool shows_backs(const struct zr_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++)
        if (scene->materials[i].double_sided && scene->materials[i].shading != ZR_SHADING_UNLIT) return true;
    return false;
}

struct placing {
    const struct zr_mesh *mesh;
    zr_mat4 object_to_eye, object_to_clip;
    struct zr_builder *builder;
    struct zr_window_vertex *out;
};

/* Object space to clip space, and to the window for what is inside the volume. */
static void place_vertices(void *argument, size_t begin, size_t end)
{
    const struct placing *placing = argument;
    struct zr_builder *builder = placing->builder;
    for (size_t i = begin; i < end; i++) {
        zr_vec4 position = placing->mesh->positions[i];
        zr_vec4 clip = zr_mat4_apply(&placing->object_to_clip, position);
        unsigned outcode = zr_clip_outcode(clip);
        struct zr_window_vertex *out = &placing->out[i];
        out->eye_z = zr_mat4_row(&placing->object_to_eye, 2, position);
        out->eye_w = zr_mat4_row(&placing->object_to_eye, 3, position);
        if (outcode == 0 && !zr_viewport_apply(&builder->viewport, clip, out)) outcode = ZR_OUTCODE_UNPLACED;
        builder->clip_positions[i] = clip;
        builder->outcodes[i] = (uint8_t)outcode;
    }
}

/* Room for what all instances are sure to fill, so that arrays need not move as they grow, and
 * for the positions of one at a time. False where the arena has failed. */
static bool make_room(struct zr_builder *builder, const struct zr_scene *scene)
{
    uint64_t vertices = 0, colors = 0;
    uint32_t most = 0;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        vertices += mesh->position_count;
        colors += zr_colors_count(scene, mesh);
        if (mesh->position_count > most) most = mesh->position_count;
    }
    if (!zr_builder_reserve(builder, vertices, colors, 0)) return false;
    struct zr_sources *sources = &builder->geometry->sources;
    sources->instances = zr_arena_alloc(builder->arena, scene->instance_count, sizeof *sources->instances);
    builder->clip_positions = zr_arena_alloc(builder->arena, most, sizeof *builder->clip_positions);
    builder->outcodes = zr_arena_alloc(builder->arena, most, sizeof *builder->outcodes);
    return zr_arena_ok(builder->arena);
}

static enum zr_status build_instance(struct zr_builder *builder, struct zr_team *team, const struct zr_scene *scene,
                                     const struct zr_camera *camera, const struct zr_lighting *lighting,
                                     const struct zr_instance *instance)
{
    struct zr_geometry *geometry = builder->geometry;
    const struct zr_mesh *mesh = &scene->meshes[instance->mesh];
    uint64_t corners = mesh->face_offsets[mesh->face_count];
    builder->mesh = mesh;
    if (!zr_builder_reserve(builder, mesh->position_count, zr_colors_count(scene, mesh),
                            corners - 2 * (uint64_t)mesh->face_count))
        return ZR_NO_MEMORY;

    struct placing placing = {.mesh = mesh, .builder = builder, .out = geometry->vertices + geometry->vertex_count};
    placing.object_to_eye = zr_mat4_mul(&camera->world_to_eye, &instance->object_to_world);
    placing.object_to_clip = zr_mat4_mul(&camera->projection, &placing.object_to_eye);
    zr_team_ranges(team, mesh->position_count, VERTICES_A_RANGE, place_vertices, &placing);
    builder->mirrored = zr_mat4_is_mirror(&instance->object_to_world);
    builder->first_vertex = geometry->vertex_count;
    geometry->sources.instances[geometry->sources.instance_count++] =
        zr_source_instance_make(camera, &instance->object_to_world, mesh, builder->first_vertex);
    geometry->vertex_count += mesh->position_count;

    struct zr_colors colors =
        zr_colors_make(builder->arena, builder->cancel, scene, mesh, lighting, &placing.object_to_eye,
                       geometry->front_colors + geometry->color_count, geometry->back_colors + geometry->color_count);
    builder->first_color = geometry->color_count;
    geometry->color_count += colors.count;
    if (!zr_arena_ok(builder->arena)) return ZR_NO_MEMORY;
    builder->layout = colors.layout;
    return zr_assemble_mesh(builder);
}

enum zr_status zr_geometry_build(struct zr_arena *arena, struct zr_team *team, const struct zr_scene *scene,
                                 const struct zr_camera *camera, const struct zr_cancel *cancel,
                                 struct zr_geometry *geometry)
{
    *geometry = (struct zr_geometry){.vertex_count = 0};
    struct zr_builder builder = {.arena = arena, .cancel = cancel, .scene = scene, .geometry = geometry};
    builder.separate_backs = shows_backs(scene);
    builder.viewport = zr_viewport_make(scene->width, scene->height);
    struct zr_lighting lighting;
    zr_lighting_make(arena, scene, &camera->world_to_eye, &lighting);

    if (!make_room(&builder, scene)) return ZR_NO_MEMORY;
    builder.first_face_id = 1;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_instance *instance = &scene->instances[i];
        enum zr_status status = build_instance(&builder, team, scene, camera, &lighting, instance);
        if (status != ZR_OK) return status;
        builder.first_face_id += (uint32_t)zr_mesh_ids(&scene->meshes[instance->mesh]);
    }
    return zr_arena_ok(arena) ? ZR_OK : ZR_NO_MEMORY;
}
