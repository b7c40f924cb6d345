#include "shade/eye_normals.h"

#include "base/run.h"
#include "geometry/face.h"
#include "geometry/geometry.h"
#include "mesh/face_normals.h"
#include "mesh/vertex_normals.h"

/* Normals per range: less than a millisecond. */
enum { NORMALS_PER_RANGE = 1 << 13 };

struct making {
    const struct zr_eye_normals *of;
    const struct zr_cancel *cancel;
    zr_to_eye_fn *to_eye;
    zr_vec4 *out;
};

enum zr_rate zr_eye_normals_rate(const struct zr_mesh *mesh, const struct zr_material *material, bool has_creases)
{
    if (zr_shading_is_at(material->shading, ZR_SHADED_PER_FACE)) return ZR_RATE_FACE;
    if (has_creases) return ZR_RATE_CORNER;
    if (!zr_shading_needs_smooth_normals(material->shading) && mesh->normal_count == 0) return ZR_RATE_FACE;
    return mesh->normal_indices ? ZR_RATE_CORNER : ZR_RATE_VERTEX;
}

/* Returns the normal of face, vertex or corner i, in object space. */
static zr_vec3 normal_of(const struct zr_eye_normals *n, uint32_t i)
{
    if (n->rate == ZR_RATE_FACE) return zr_normal_of_face(n->mesh, i);
    if (n->rate == ZR_RATE_VERTEX) return zr_corner_normal(n->mesh, n->computed, i, 0);
    const zr_vec3 own = zr_corner_normal(n->mesh, n->computed, n->mesh->indices[i], i);
    const bool has_own = own.x != 0.0f || own.y != 0.0f || own.z != 0.0f;
    return has_own || !n->creases ? own : zr_crease_normal_of(n->creases, i);
}

static zr_vec4 widened(zr_vec3 normal)
{
    return (zr_vec4){normal.x, normal.y, normal.z, 0.0f};
}

static void make_range(void *context, size_t begin, size_t end)
{
    const struct making *m = context;
    if (zr_is_cancelled(m->cancel)) return;
    for (uint32_t i = (uint32_t)begin; i < end; i++)
        m->out[i] = widened(normal_of(m->of, i));
    m->to_eye(&m->of->to_eye, m->out + begin, end - begin);
}

static uint32_t count_of(const struct zr_mesh *mesh, enum zr_rate rate)
{
    if (rate == ZR_RATE_FACE) return mesh->face_count;
    return rate == ZR_RATE_VERTEX ? mesh->position_count : mesh->face_offsets[mesh->face_count];
}

bool zr_eye_normals_find(const struct zr_run *run, const struct zr_mesh *mesh, const zr_mat4 *object_to_eye,
                         enum zr_rate rate, const struct zr_crease_normals *crease_normals,
                         const zr_vec4 **vertex_normals, struct zr_eye_normals *out)
{
    *out = (struct zr_eye_normals){.mesh = mesh,
                                   .rate = rate,
                                   .creases = rate == ZR_RATE_CORNER ? crease_normals : NULL,
                                   .count = count_of(mesh, rate),
                                   .to_eye = zr_normal_matrix_make(object_to_eye)};
    if (rate != ZR_RATE_FACE && !out->creases && zr_mesh_lacks_normals(mesh)) {
        if (!*vertex_normals) *vertex_normals = zr_vertex_normals_make(run, mesh);
        out->computed = *vertex_normals;
    }
    return zr_arena_ok(run->arena);
}

bool zr_eye_normals_are_single(const struct zr_eye_normals *normals)
{
    if (normals->rate == ZR_RATE_FACE) return zr_mesh_is_of_triangles(normals->mesh);
    return normals->mesh->normal_count <= ZR_GEOMETRY_MAX;
}

void zr_eye_normals_make(const struct zr_run *run, const struct zr_eye_normals *normals, zr_vec4 *out)
{
    struct making making = {normals, run->cancel, zr_to_eye_of(zr_team_isa(run->team)), out};
    zr_team_ranges(run->team, normals->count, NORMALS_PER_RANGE, make_range, &making);
}

void zr_eye_normals_of(const struct zr_run *run, const struct zr_eye_normals *normals, const uint32_t *numbers,
                       uint32_t count, zr_vec4 *out)
{
    for (uint32_t k = 0; k < count; k++)
        out[k] = widened(normal_of(normals, numbers[k]));
    zr_to_eye_of(zr_team_isa(run->team))(&normals->to_eye, out, count);
}
