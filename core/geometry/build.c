#include "geometry/build.h"

#include <stdatomic.h>

#include "base/fast.h"
#include "base/prefetch.h"
#include "base/run.h"
#include "geometry/face.h"
#include "geometry/place.h"
#include "geometry/shape.h"
#include "geometry/wire.h"

/* Places a triangle in the order of its corners, and a larger polygon as the fan (i-1, i, 0), as GL_POLYGON does in the
 * reference (rule 10). */
static void place_fan(struct zr_builder *builder, uint32_t face, const struct zr_common *common)
{
    const struct zr_mesh *mesh = builder->mesh;
    uint32_t begin = mesh->face_offsets[face], count = mesh->face_offsets[face + 1] - begin;
    for (uint32_t i = 2; i < count; i++) {
        const uint32_t fan[3] = {i - 1, i, 0}, whole[3] = {0, 1, 2}, *order = count == 3 ? whole : fan;
        zr_place_triangle(builder, (const uint32_t[3]){begin + order[0], begin + order[1], begin + order[2]}, common);
    }
}

static void place_face(struct zr_builder *builder, uint32_t face)
{
    const struct zr_mesh *mesh = builder->mesh;
    const struct zr_material *material = zr_material_of_face(builder->scene, mesh, face);
    struct zr_counts *counts = &builder->geometry->counts;
    counts->polygons++;
    if (zr_face_is_degenerate(mesh, face)) {
        counts->degenerate_polygons++;
        return;
    }
    const bool concave = zr_face_is_shape(mesh, face);
    counts->concave_polygons += concave;
    if (material->unfilled) return;
    const struct zr_common common = {
        .face = face, .material = material, .depth_offset = material->outline != ZR_OUTLINE_NONE};
    if (concave)
        zr_shape_place(builder, face, &common);
    else
        place_fan(builder, face, &common);
}

static void outline_face(struct zr_builder *builder, uint32_t face)
{
    if (!zr_face_is_degenerate(builder->mesh, face)) zr_wire_outline(builder, face);
}

static bool has_outlines(const struct zr_builder *builder)
{
    const struct zr_scene *scene = builder->scene;
    const struct zr_mesh *mesh = builder->mesh;
    if (!mesh->face_materials) return scene->materials[mesh->material].outline != ZR_OUTLINE_NONE;
    for (uint32_t face = 0; face < mesh->face_count; face++)
        if (scene->materials[mesh->face_materials[face]].outline != ZR_OUTLINE_NONE) return true;
    return false;
}

/* Bounds the work of triangulating the face. */
static uint64_t corners_squared(const struct zr_mesh *mesh, uint32_t face)
{
    uint64_t corners = mesh->face_offsets[face + 1] - mesh->face_offsets[face];
    return corners * corners;
}

/* ---- faces drawn without copying ---- */

/* Faces begin .. end - 1, all of one material. */
struct run {
    uint32_t begin, end;
    const struct zr_material *material;
};

/* Returns true for a convex face wholly inside the view volume. The caller has checked that its material fills it
 * without outlines, which would offset its depth. */
static bool face_is_plain(const struct zr_builder *builder, const struct zr_fans *fans, uint32_t face)
{
    const struct zr_mesh *mesh = builder->mesh;
    if (fans->is_other && fans->is_other[face]) return false;
    unsigned any = 0;
    if (builder->any_outcodes)
        for (uint32_t slot = mesh->face_offsets[face]; slot < mesh->face_offsets[face + 1]; slot++)
            any |= builder->outcodes[mesh->indices[slot]];
    return any == 0;
}

static bool add_run(struct zr_builder *builder, const struct zr_fans *fans, const struct run *run)
{
    const struct zr_mesh *mesh = builder->mesh;
    struct zr_counts *counts = &builder->geometry->counts;
    uint32_t first = zr_fans_first(mesh, run->begin), end = zr_fans_first(mesh, run->end);
    const uint32_t *corners = fans->corners ? fans->corners : mesh->indices;
    const struct zr_draw draw = {.count = end - first,
                                 .kind = ZR_DRAW_TRIANGLES,
                                 .material = run->material,
                                 .corners = corners + 3 * (size_t)first,
                                 .slots = fans->slots ? fans->slots + 3 * (size_t)first : NULL,
                                 .faces = fans->faces ? fans->faces + first : NULL,
                                 .first_face = run->begin};
    counts->polygons += run->end - run->begin;
    counts->triangles += draw.count;
    return zr_builder_add_draw(builder, draw);
}

/* Shorter runs of plain faces between others are placed one by one: a draw of their own takes longer (a third of the
 * time of a cube, half of whose triangles are clipped). */
enum { SHORT_RUN = 16 };

static bool is_a_draw(const struct zr_mesh *mesh, const struct run *run)
{
    const uint32_t count = run->end - run->begin;
    return count == mesh->face_count || count >= SHORT_RUN;
}

/* Processes the faces in order: long runs of plain ones become draws, all others are placed one by one. */
static enum zr_status assemble_faces(struct zr_builder *builder, const struct zr_fans *fans)
{
    const struct zr_mesh *mesh = builder->mesh;
    for (struct run run = {.begin = 0}; run.begin < mesh->face_count; run.begin = run.end) {
        run.end = run.begin;
        run.material = zr_material_of_face(builder->scene, mesh, run.begin);
        bool filled = !run.material->unfilled && run.material->outline == ZR_OUTLINE_NONE;
        const bool all_plain = filled && !mesh->face_materials && !fans->is_other && !builder->any_outcodes;
        if (ZR_FAST(whole_meshes, all_plain)) run.end = mesh->face_count;
        while (run.end < mesh->face_count && filled && face_is_plain(builder, fans, run.end) &&
               zr_material_of_face(builder->scene, mesh, run.end) == run.material)
            run.end++;
        uint64_t work = 0;
        if (is_a_draw(mesh, &run)) {
            work = run.end - run.begin;
            if (!add_run(builder, fans, &run)) return ZR_NO_MEMORY;
        } else {
            if (run.end == run.begin) run.end++; /* a face that is not plain */
            for (uint32_t face = run.begin; face < run.end; face++) {
                work += corners_squared(mesh, face);
                place_face(builder, face);
            }
        }
        if (!zr_arena_ok(builder->run->arena)) return ZR_NO_MEMORY;
        if (!zr_builder_go_on(builder, work)) return ZR_CANCELLED;
    }
    return ZR_OK;
}

/* ---- all faces, one by one ---- */

static enum zr_status for_each_face(struct zr_builder *builder, void (*work)(struct zr_builder *builder, uint32_t face))
{
    for (uint32_t face = 0; face < builder->mesh->face_count; face++) {
        if (!zr_builder_go_on(builder, corners_squared(builder->mesh, face))) return ZR_CANCELLED;
        work(builder, face);
        if (!zr_arena_ok(builder->run->arena)) return ZR_NO_MEMORY;
    }
    return ZR_OK;
}

static enum zr_status fill_faces(struct zr_builder *builder)
{
    static const struct zr_fans none = {NULL, NULL, NULL, NULL};
    if (builder->singly) return for_each_face(builder, place_face);
    const struct zr_mesh *mesh = builder->mesh;
    if (zr_mesh_is_of_triangles(mesh)) return assemble_faces(builder, &none);
    struct zr_fans *fans = &builder->fans[mesh - builder->scene->meshes];
    if (!fans->corners && !zr_fans_make(builder->run, mesh, fans)) return ZR_NO_MEMORY;
    if (zr_is_cancelled(builder->run->cancel)) return ZR_CANCELLED;
    return assemble_faces(builder, fans);
}

static enum zr_status assemble_mesh(struct zr_builder *builder)
{
    enum zr_status status = fill_faces(builder);
    if (status == ZR_OK && has_outlines(builder)) status = for_each_face(builder, outline_face);
    if (status == ZR_OK) status = zr_wire_lines(builder);
    return status == ZR_OK ? zr_wire_points(builder) : status;
}

/* From this number on, vertices exceed the share of a core's caches. Non-temporal stores then take 7 to 11 % off the
 * time of a million triangles after other work; a mesh drawn repeatedly takes up to a tenth longer. */
enum { VERTICES_PER_RANGE = 4096, STREAMED_VERTICES = 1 << 17 };

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
    if (zr_is_cancelled(builder->run->cancel)) return;
    unsigned any = placing->transform(&builder->object_to_clip, &builder->viewport, builder->mesh->positions + begin,
                                      end - begin, placing->out + begin, builder->outcodes + begin, placing->streamed);
    if (any) atomic_fetch_or_explicit(&placing->any_outcodes, any, memory_order_relaxed);
}

/* Returns the number of window vertices for the positions of a mesh: none if it is a cloud alone. */
static uint32_t vertices_of(const struct zr_builder *builder, const struct zr_mesh *mesh)
{
    return !builder->singly && mesh->face_count == 0 && mesh->line_count == 0 ? 0 : mesh->position_count;
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
        const uint32_t count = vertices_of(builder, &scene->meshes[scene->instances[i].mesh]);
        vertices += count;
        if (count > most) most = count;
    }
    if (!zr_builder_reserve_vertices(builder, vertices)) return false;
    geometry->instances = zr_arena_alloc(builder->run->arena, scene->instance_count, sizeof *geometry->instances);
    geometry->draws = zr_arena_zero(builder->run->arena, 1, sizeof *geometry->draws);
    builder->draw_room = 1;
    builder->outcodes = zr_arena_alloc(builder->run->arena, most, sizeof *builder->outcodes);
    builder->fans = zr_arena_zero(builder->run->arena, scene->mesh_count, sizeof *builder->fans);
    return zr_arena_ok(builder->run->arena);
}

static enum zr_status build_instance(struct zr_builder *builder, const struct zr_camera *camera,
                                     const struct zr_instance *instance)
{
    struct zr_geometry *geometry = builder->geometry;
    const struct zr_mesh *mesh = &builder->scene->meshes[instance->mesh];
    const uint32_t count = vertices_of(builder, mesh);
    struct zr_source_instance *source = &geometry->instances[instance - builder->scene->instances];
    builder->mesh = mesh;
    builder->instance = (uint32_t)(instance - builder->scene->instances);
    if (!zr_builder_go_on(builder, INSTANCE_WORK + count)) return ZR_CANCELLED;
    if (mesh->face_offsets[mesh->face_count] > ZR_GEOMETRY_MAX || !zr_builder_reserve_vertices(builder, count))
        return ZR_NO_MEMORY;

    builder->first_vertex = geometry->vertex_count;
    builder->mirrored = zr_camera_reverses_windings(camera, &instance->object_to_world);
    builder->object_to_eye = zr_mat4_mul(&camera->world_to_eye, &instance->object_to_world);
    builder->object_to_clip = zr_mat4_mul(&camera->projection, &builder->object_to_eye);
    struct placing placing = {.builder = builder,
                              .out = count > 0 ? geometry->vertices + geometry->vertex_count : NULL,
                              .transform = zr_transform_of(zr_team_isa(builder->run->team))};
    placing.streamed = count >= STREAMED_VERTICES && (uintptr_t)placing.out % ZR_CACHE_LINE == 0;
    if (count > 0) /* a cloud has none, nor a mesh that a section cuts away */
        zr_team_ranges(builder->run->team, count, VERTICES_PER_RANGE, place_vertices, &placing);
    if (zr_is_cancelled(builder->run->cancel)) return ZR_CANCELLED;
    builder->any_outcodes = placing.any_outcodes;
    geometry->vertex_count += count;
    *source = zr_source_instance_make(camera, &instance->object_to_world, mesh, builder->first_vertex);
    source->vertex_count = count;
    return assemble_mesh(builder);
}

enum zr_status zr_geometry_build(const struct zr_run *run, const struct zr_scene *scene, const struct zr_camera *camera,
                                 const struct zr_window *window, bool singly, struct zr_geometry *geometry)
{
    *geometry = (struct zr_geometry){.window = *window};
    struct zr_builder builder = {.run = run,
                                 .scene = scene,
                                 .geometry = geometry,
                                 .singly = singly,
                                 .viewport = zr_viewport_make(window->width, window->height),
                                 .cutting.triangulator.loops.cancel = run->cancel,
                                 .first_face_id = 1};
    if (!make_room(&builder)) return ZR_NO_MEMORY;
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const struct zr_instance *instance = &scene->instances[i];
        enum zr_status status = build_instance(&builder, camera, instance);
        if (status != ZR_OK) return status;
        builder.first_face_id += (uint32_t)zr_mesh_ids(&scene->meshes[instance->mesh]);
    }
    return zr_arena_ok(run->arena) ? ZR_OK : ZR_NO_MEMORY;
}
