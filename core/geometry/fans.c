#include "geometry/fans.h"

#include "base/mutant.h"
#include "base/run.h"
#include "geometry/face.h"

enum { FACES_PER_RANGE = 1024 };

struct fanning {
    const struct zr_mesh *mesh;
    const struct zr_cancel *cancel;
    uint32_t *corners, *slots, *faces;
    bool *is_other;
};

static void make_fan(const struct fanning *f, uint32_t face)
{
    const struct zr_mesh *mesh = f->mesh;
    uint32_t begin = mesh->face_offsets[face], count = mesh->face_offsets[face + 1] - begin;
    size_t t = zr_fans_first(mesh, face);
    for (uint32_t i = 2; i < count; i++, t++) {
        const uint32_t fan[3] = {i - 1, i, 0}, whole[3] = {0, 1, 2}, from_first[3] = {0, i - 1, i};
        const uint32_t *order = count == 3 ? whole : ZR_MUTANT(fans_from_the_first, fan, from_first);
        f->faces[t] = face;
        for (int k = 0; k < 3; k++) {
            f->slots[3 * t + (size_t)k] = begin + order[k];
            f->corners[3 * t + (size_t)k] = mesh->indices[begin + order[k]];
        }
    }
}

static void make_fans(void *context, size_t begin, size_t end)
{
    const struct fanning *f = context;
    for (uint32_t face = (uint32_t)begin; face < end && !zr_is_cancelled(f->cancel); face++) {
        f->is_other[face] = zr_face_is_degenerate(f->mesh, face) || zr_face_is_shape(f->mesh, face);
        if (!f->is_other[face]) make_fan(f, face);
    }
}

bool zr_fans_make(const struct zr_run *run, const struct zr_mesh *mesh, struct zr_fans *fans)
{
    size_t triangles = zr_fans_first(mesh, mesh->face_count);
    struct fanning f = {.mesh = mesh,
                        .cancel = run->cancel,
                        .corners = zr_arena_alloc(run->arena, triangles, 3 * sizeof *f.corners),
                        .slots = zr_arena_alloc(run->arena, triangles, 3 * sizeof *f.slots),
                        .faces = zr_arena_alloc(run->arena, triangles, sizeof *f.faces),
                        .is_other = zr_arena_alloc(run->arena, mesh->face_count, sizeof *f.is_other)};
    if (!zr_arena_ok(run->arena)) return false;
    zr_team_ranges(run->team, mesh->face_count, FACES_PER_RANGE, make_fans, &f);
    *fans = (struct zr_fans){f.corners, f.slots, f.faces, f.is_other};
    return true;
}
