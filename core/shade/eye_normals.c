#include "shade/eye_normals.h"

#include "shade/light.h"
#include "shade/normals.h"
#include "shade/vertex_normals.h"

/* Less than a millisecond's worth. */
enum { NORMALS_A_RANGE = 1 << 13 };

struct making {
    const struct zr_mesh *mesh;
    const zr_vec4 *computed; /* of vertices; NULL where none is needed */
    const struct zr_cancel *cancel;
    struct zr_normal_matrix to_eye;
    enum zr_rate rate;
    enum zr_isa isa;
    zr_vec4 *out;
};

enum zr_rate zr_eye_normals_rate(const struct zr_mesh *mesh, const struct zr_material *material)
{
    const bool is_flat =
        material->shading == ZR_SHADING_FLAT || (material->shading == ZR_SHADING_UNLIT && mesh->normal_count == 0);
    if (is_flat) return ZR_RATE_FACE;
    return mesh->normal_indices ? ZR_RATE_CORNER : ZR_RATE_VERTEX;
}

static void make_range(void *context, size_t begin, size_t end)
{
    const struct making *m = context;
    const struct zr_mesh *mesh = m->mesh;
    if (zr_is_cancelled(m->cancel)) return;
    for (uint32_t i = (uint32_t)begin; i < end; i++) {
        const zr_vec3 normal = m->rate == ZR_RATE_FACE     ? zr_normal_of_face(mesh, i)
                               : m->rate == ZR_RATE_CORNER ? zr_corner_normal(mesh, m->computed, mesh->indices[i], i)
                                                           : zr_corner_normal(mesh, m->computed, i, 0);
        m->out[i] = (zr_vec4){normal.x, normal.y, normal.z, 0.0f};
    }
    zr_to_eye_of(m->isa)(&m->to_eye, m->out + begin, end - begin);
}

uint32_t zr_eye_normals_count(const struct zr_mesh *mesh, enum zr_rate rate)
{
    if (rate == ZR_RATE_FACE) return mesh->face_count;
    return rate == ZR_RATE_VERTEX ? mesh->position_count : mesh->face_offsets[mesh->face_count];
}

bool zr_eye_normals_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                         const struct zr_mesh *mesh, const zr_mat4 *object_to_eye, enum zr_rate rate,
                         const zr_vec4 **vertex_normals, zr_vec4 *out)
{
    struct making making = {.mesh = mesh,
                            .cancel = cancel,
                            .to_eye = zr_normal_matrix_make(object_to_eye),
                            .rate = rate,
                            .isa = zr_team_isa(team),
                            .out = out};
    if (rate != ZR_RATE_FACE && zr_mesh_lacks_normals(mesh)) {
        if (!*vertex_normals) *vertex_normals = zr_vertex_normals_make(arena, team, cancel, mesh);
        making.computed = *vertex_normals;
    }
    if (!zr_arena_ok(arena)) return false;
    zr_team_ranges(team, zr_eye_normals_count(mesh, rate), NORMALS_A_RANGE, make_range, &making);
    return true;
}
