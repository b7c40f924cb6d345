#include "shade/eye_normals.h"

#include "base/run.h"
#include "mesh/face_normals.h"
#include "mesh/vertex_normals.h"
#include "shade/lights/light.h"

/* Normals per range: less than a millisecond. */
enum { NORMALS_PER_RANGE = 1 << 13 };

struct making {
    const struct zr_mesh *mesh;
    const zr_vec4 *computed;                 /* vertex normals; NULL: not needed */
    const struct zr_crease_normals *creases; /* of corners, instead; or NULL */
    const struct zr_cancel *cancel;
    struct zr_normal_matrix to_eye;
    enum zr_rate rate;
    enum zr_isa isa;
    zr_vec4 *out;
};

enum zr_rate zr_eye_normals_rate(const struct zr_mesh *mesh, const struct zr_material *material, bool has_creases)
{
    if (zr_shading_is_at(material->shading, ZR_SHADED_PER_FACE)) return ZR_RATE_FACE;
    if (has_creases) return ZR_RATE_CORNER;
    if (!zr_shading_needs_smooth_normals(material->shading) && mesh->normal_count == 0) return ZR_RATE_FACE;
    return mesh->normal_indices ? ZR_RATE_CORNER : ZR_RATE_VERTEX;
}

/* Returns the normal of face, vertex or corner i. */
static zr_vec3 normal_of(const struct making *m, uint32_t i)
{
    if (m->rate == ZR_RATE_FACE) return zr_normal_of_face(m->mesh, i);
    if (m->rate == ZR_RATE_VERTEX) return zr_corner_normal(m->mesh, m->computed, i, 0);
    const zr_vec3 own = zr_corner_normal(m->mesh, m->computed, m->mesh->indices[i], i);
    const bool has_own = own.x != 0.0f || own.y != 0.0f || own.z != 0.0f;
    return has_own || !m->creases ? own : zr_crease_normal_of(m->creases, i);
}

static void make_range(void *context, size_t begin, size_t end)
{
    const struct making *m = context;
    if (zr_is_cancelled(m->cancel)) return;
    for (uint32_t i = (uint32_t)begin; i < end; i++) {
        const zr_vec3 normal = normal_of(m, i);
        m->out[i] = (zr_vec4){normal.x, normal.y, normal.z, 0.0f};
    }
    zr_to_eye_of(m->isa)(&m->to_eye, m->out + begin, end - begin);
}

uint32_t zr_eye_normals_count(const struct zr_mesh *mesh, enum zr_rate rate)
{
    if (rate == ZR_RATE_FACE) return mesh->face_count;
    return rate == ZR_RATE_VERTEX ? mesh->position_count : mesh->face_offsets[mesh->face_count];
}

bool zr_eye_normals_make(const struct zr_run *run, const struct zr_mesh *mesh, const zr_mat4 *object_to_eye,
                         enum zr_rate rate, const struct zr_crease_normals *crease_normals,
                         const zr_vec4 **vertex_normals, zr_vec4 *out)
{
    struct making making = {.mesh = mesh,
                            .cancel = run->cancel,
                            .to_eye = zr_normal_matrix_make(object_to_eye),
                            .rate = rate,
                            .creases = rate == ZR_RATE_CORNER ? crease_normals : NULL,
                            .isa = zr_team_isa(run->team),
                            .out = out};
    if (rate != ZR_RATE_FACE && !making.creases && zr_mesh_lacks_normals(mesh)) {
        if (!*vertex_normals) *vertex_normals = zr_vertex_normals_make(run, mesh);
        making.computed = *vertex_normals;
    }
    if (!zr_arena_ok(run->arena)) return false;
    zr_team_ranges(run->team, zr_eye_normals_count(mesh, rate), NORMALS_PER_RANGE, make_range, &making);
    return true;
}
