#include "mesh/mesh_tables.h"

#include "base/cancel.h"
#include "base/run.h"
#include "mesh/crease_normals.h"
#include "mesh/face_normals.h"
#include "mesh/vertex_normals.h"
#include "scene/output.h"
#include "scene/picture.h"

/* Most bytes of the tables per corner, while they are made. */
enum { BYTES_PER_CORNER = 96 };

static bool have_room(const struct zr_arena *arena, const struct zr_scene *scene)
{
    uint64_t corners = 0;
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        corners += scene->meshes[i].face_offsets[scene->meshes[i].face_count];
    return corners <= zr_arena_left(arena) / 2 / BYTES_PER_CORNER;
}

static void make_creases(const struct zr_run *run, const struct zr_scene *scene, struct zr_mesh_tables *out)
{
    const struct zr_crease_normals **creases = zr_arena_zero(run->arena, scene->mesh_count, sizeof *creases);
    for (uint32_t i = 0; creases && i < scene->mesh_count; i++)
        if (zr_mesh_lacks_normals(&scene->meshes[i]) && scene->meshes[i].face_count > 0)
            creases[i] = zr_crease_normals_make(run, &scene->meshes[i], scene->picture->crease_degrees);
    out->creases = creases;
}

static void make_normals(const struct zr_run *run, const struct zr_scene *scene, struct zr_mesh_tables *out)
{
    const zr_vec4 **normals = zr_arena_zero(run->arena, scene->mesh_count, sizeof *normals);
    for (uint32_t i = 0; normals && i < scene->mesh_count; i++)
        if (scene->meshes[i].face_count > 0 && zr_mesh_is_lit_by_computed_normals(scene, &scene->meshes[i]))
            normals[i] = zr_vertex_normals_make(run, &scene->meshes[i]);
    out->normals = normals;
}

static enum zr_status make_edges(const struct zr_run *run, const struct zr_scene *scene, struct zr_mesh_tables *out)
{
    struct zr_edge_mesh *edges = zr_arena_alloc(run->arena, scene->mesh_count, sizeof *edges);
    enum zr_status status = edges ? ZR_OK : ZR_NO_MEMORY;
    for (uint32_t i = 0; status == ZR_OK && i < scene->mesh_count; i++)
        status = zr_edge_mesh_make(run, &scene->meshes[i], &edges[i]);
    out->edges = edges;
    return status;
}

enum zr_status zr_mesh_tables_make(const struct zr_run *run, const struct zr_scene *scene, struct zr_mesh_tables *out)
{
    const struct zr_picture *picture = scene->picture;
    enum zr_status status = ZR_OK;
    *out = (struct zr_mesh_tables){
        .meshes = scene->meshes, .count = scene->mesh_count, .crease_degrees = picture->crease_degrees};
    if (!zr_view_wants(&scene->views[0], ZR_CHANNEL_COLOR) || !have_room(run->arena, scene)) return ZR_OK;
    if (picture->is_linear) {
        make_creases(run, scene, out);
        if (picture->edges.is_on && picture->edges.is_from_mesh) status = make_edges(run, scene, out);
    } else {
        make_normals(run, scene, out);
    }
    if (zr_is_cancelled(run->cancel)) return ZR_CANCELLED;
    return zr_arena_ok(run->arena) ? status : ZR_NO_MEMORY;
}

/* True if a mesh has the faces of that of the tables, even if a change of the scene has copied it. */
static bool has_faces_of(const struct zr_mesh_tables *tables, const struct zr_scene *scene, uint32_t mesh)
{
    if (!tables || mesh >= tables->count) return false;
    const struct zr_mesh *a = &tables->meshes[mesh], *b = &scene->meshes[mesh];
    return a->positions == b->positions && a->position_count == b->position_count && a->face_count == b->face_count &&
           a->face_offsets == b->face_offsets && a->indices == b->indices && a->faces_are_fans == b->faces_are_fans &&
           a->face_rings == b->face_rings && a->ring_offsets == b->ring_offsets && a->face_groups == b->face_groups &&
           a->normals == b->normals;
}

const struct zr_crease_normals *zr_mesh_table_creases(const struct zr_mesh_tables *tables, const struct zr_scene *scene,
                                                      uint32_t mesh)
{
    if (!has_faces_of(tables, scene, mesh) || !tables->creases) return NULL;
    return tables->crease_degrees == scene->picture->crease_degrees ? tables->creases[mesh] : NULL;
}

const zr_vec4 *zr_mesh_table_normals(const struct zr_mesh_tables *tables, const struct zr_scene *scene, uint32_t mesh)
{
    return has_faces_of(tables, scene, mesh) && tables->normals ? tables->normals[mesh] : NULL;
}

const struct zr_edge_mesh *zr_mesh_table_edges(const struct zr_mesh_tables *tables, const struct zr_scene *scene,
                                               uint32_t mesh)
{
    return has_faces_of(tables, scene, mesh) && tables->edges ? &tables->edges[mesh] : NULL;
}
