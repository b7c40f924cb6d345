#include "mesh/blended_normals.h"

enum { NORMALS_PER_CANCEL_CHECK = 1 << 15 };

static zr_vec4 between(const zr_vec4 *a, const zr_vec4 *b, double t)
{
    const double s = 1.0 - t;
    const zr_vec3 sum = {(float)(s * (double)a->x + t * (double)b->x), (float)(s * (double)a->y + t * (double)b->y),
                         (float)(s * (double)a->z + t * (double)b->z)};
    const zr_vec3 unit = zr_vec3_normalize(sum);
    return (zr_vec4){unit.x, unit.y, unit.z, 0.0f};
}

/* Returns the position of a corner in the sectioned mesh. */
static uint32_t position_of(const struct zr_mesh_source *source, uint32_t corner)
{
    const struct zr_mesh *whole = source->mesh;
    const uint32_t slots = whole->face_offsets[whole->face_count];
    return corner < slots ? whole->indices[corner] : source->first_position + (corner - slots);
}

zr_vec4 *zr_blended_position_normals(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_mesh *mesh,
                                     const zr_vec4 *whole)
{
    const struct zr_mesh_source *source = mesh->source;
    zr_vec4 *out = zr_arena_zero(arena, mesh->position_count, sizeof *out);
    if (!out || !whole) return NULL;
    memcpy(out, whole, source->first_position * sizeof *out);
    for (uint32_t i = 0; i < source->blend_count; i++) {
        const struct zr_mesh_blend *blend = &source->blends[i];
        if (i % NORMALS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return out;
        if (blend->a == ZR_NO_CORNER) continue;
        out[source->first_position + i] =
            between(&out[position_of(source, blend->a)], &out[position_of(source, blend->b)], blend->t);
    }
    return out;
}

zr_vec4 *zr_blended_corner_normals(struct zr_arena *arena, const struct zr_cancel *cancel, const struct zr_mesh *mesh,
                                   const zr_vec4 *whole)
{
    const struct zr_mesh_source *source = mesh->source;
    const uint32_t slots = source->mesh->face_offsets[source->mesh->face_count],
                   corners = mesh->face_offsets[mesh->face_count];
    zr_vec4 *out = zr_arena_alloc(arena, corners, sizeof *out);
    zr_vec4 *made = zr_arena_zero(arena, source->blend_count, sizeof *made);
    if (!out || !made || !whole) return NULL;
#define NORMAL(corner) ((corner) < slots ? &whole[corner] : &made[(corner)-slots])
    for (uint32_t i = 0; i < source->blend_count; i++) {
        const struct zr_mesh_blend *blend = &source->blends[i];
        if (i % NORMALS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return out;
        if (blend->a != ZR_NO_CORNER) made[i] = between(NORMAL(blend->a), NORMAL(blend->b), blend->t);
    }
    for (uint32_t i = 0; i < corners; i++) {
        if (i % NORMALS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return out;
        out[i] = *NORMAL(source->corners[i]);
    }
#undef NORMAL
    return out;
}
