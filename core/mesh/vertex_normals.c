#include "mesh/vertex_normals.h"

#include "base/run.h"
#include "geometry/face.h"
#include "mesh/blended_normals.h"
#include "mesh/face_normals.h"

/* Faces whose normals are held at once, so that they stay in the caches: those of a million faces take 16 MB. */
enum { FACES_AT_ONCE = 1 << 14 };

/* Up to this number, one thread adds all faces: each thread has to read every face. */
enum { FACES_ALONE = 1 << 12 };

enum { FACES_PER_RANGE = 1 << 11, VERTICES_PER_RANGE = 1 << 13 };

struct summing {
    const struct zr_mesh *mesh;
    enum zr_isa isa;
    bool only_triangles;
    uint32_t first, count; /* current block of faces */
    zr_vec4 *normals;      /* normals of the block */
    uint32_t part_count;
    zr_vec4 *sums; /* one per vertex */
};

static void make_faces(void *context, size_t begin, size_t end)
{
    const struct summing *s = context;
    const uint32_t first = s->first + (uint32_t)begin;
    if (s->only_triangles) {
        zr_triangle_normals_of(s->isa)(s->mesh, first, end - begin, s->normals + begin);
        return;
    }
    for (size_t i = begin; i < end; i++) {
        const zr_vec3 normal = zr_normal_of_face(s->mesh, s->first + (uint32_t)i);
        s->normals[i] = (zr_vec4){normal.x, normal.y, normal.z, 0.0f};
    }
}

static void add_polygons(const struct summing *s, struct zr_vertex_part part)
{
    const struct zr_mesh *mesh = s->mesh;
    for (uint32_t face = s->first; face < s->first + s->count; face++) {
        const zr_vec4 *normal = &s->normals[face - s->first];
        for (uint32_t slot = mesh->face_offsets[face]; slot < mesh->face_offsets[face + 1]; slot++) {
            const uint32_t vertex = mesh->indices[slot];
            if (zr_vertex_is_of_part(vertex, part))
                zr_four_store(&s->sums[vertex], zr_four_load(&s->sums[vertex]) + zr_four_load(normal));
        }
    }
}

static void add_parts(void *context, size_t begin, size_t end)
{
    const struct summing *s = context;
    for (uint32_t number = (uint32_t)begin; number < end; number++) {
        const struct zr_vertex_part part = {number, s->part_count};
        if (s->only_triangles)
            zr_add_normals_of(s->isa)(s->mesh->indices + 3 * (size_t)s->first, s->count, s->normals, part, s->sums);
        else
            add_polygons(s, part);
    }
}

static void normalize(void *context, size_t begin, size_t end)
{
    const struct summing *s = context;
    zr_normalize_of(s->isa)(s->sums + begin, end - begin);
}

/* Returns the least power of two that gives each thread at least one part. */
static uint32_t count_parts(struct zr_team *team, const struct zr_mesh *mesh)
{
    uint32_t parts = 1;
    while (mesh->face_count > FACES_ALONE && parts < (uint32_t)zr_team_size(team))
        parts *= 2;
    return parts;
}

/* Makes those of a mesh that is not sectioned. */
static zr_vec4 *make(const struct zr_run *run, const struct zr_mesh *mesh)
{
    const uint32_t at_once = mesh->face_count < FACES_AT_ONCE ? mesh->face_count : FACES_AT_ONCE;
    struct summing s = {.mesh = mesh,
                        .isa = zr_team_isa(run->team),
                        .only_triangles = zr_mesh_is_of_triangles(mesh),
                        .normals = zr_arena_alloc(run->arena, at_once, sizeof *s.normals),
                        .part_count = count_parts(run->team, mesh),
                        .sums = zr_arena_zero(run->arena, mesh->position_count, sizeof *s.sums)};
    if (!zr_arena_ok(run->arena)) return NULL;
    for (; s.first < mesh->face_count && !zr_is_cancelled(run->cancel); s.first += s.count) {
        const uint32_t left = mesh->face_count - s.first;
        s.count = left < at_once ? left : at_once;
        zr_team_ranges(run->team, s.count, FACES_PER_RANGE, make_faces, &s);
        zr_team_ranges(run->team, s.part_count, 1, add_parts, &s);
    }
    zr_team_ranges(run->team, mesh->position_count, VERTICES_PER_RANGE, normalize, &s);
    return s.sums;
}

zr_vec4 *zr_vertex_normals_make(const struct zr_run *run, const struct zr_mesh *mesh)
{
    if (!mesh->source) return make(run, mesh);
    return zr_blended_position_normals(run->arena, run->cancel, mesh, make(run, mesh->source->mesh));
}
