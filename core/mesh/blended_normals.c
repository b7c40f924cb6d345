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

/* Normals of the whole mesh, followed by those of the blends. */
struct blending {
    const struct zr_mesh_source *source;
    uint32_t slots; /* of the whole mesh */
    const struct zr_crease_normals *whole;
    zr_vec4 *normals;
};

/* Returns the number of a corner's normal. */
static uint32_t number_of(const struct blending *b, uint32_t corner)
{
    if (corner >= b->slots) return b->whole->count + (corner - b->slots);
    return zr_crease_number_of(b->whole, corner);
}

static void blend_normals(const struct blending *b, const struct zr_cancel *cancel)
{
    zr_vec4 *const made = b->normals + b->whole->count;
    for (uint32_t i = 0; i < b->whole->count; i++) {
        if (i % NORMALS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return;
        b->normals[i] = b->whole->normals[i];
    }
    for (uint32_t i = 0; i < b->source->blend_count; i++) {
        const struct zr_mesh_blend *blend = &b->source->blends[i];
        if (i % NORMALS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return;
        made[i] = blend->a == ZR_NO_CORNER
                      ? (zr_vec4){0, 0, 0, 0}
                      : between(&b->normals[number_of(b, blend->a)], &b->normals[number_of(b, blend->b)], blend->t);
    }
}

const struct zr_crease_normals *zr_blended_corner_normals(struct zr_arena *arena, const struct zr_cancel *cancel,
                                                          const struct zr_mesh *mesh,
                                                          const struct zr_crease_normals *whole)
{
    const struct zr_mesh_source *source = mesh->source;
    const uint32_t slots = source->mesh->face_offsets[source->mesh->face_count],
                   corners = mesh->face_offsets[mesh->face_count];
    struct zr_crease_normals *out = zr_arena_alloc(arena, 1, sizeof *out);
    uint32_t *numbers = zr_arena_zero(arena, corners, sizeof *numbers);
    if (!out || !numbers || !whole) return NULL;
    const size_t count = (size_t)whole->count + source->blend_count;
    const struct blending b = {source, slots, whole, zr_arena_alloc(arena, count, sizeof *b.normals)};
    if (!b.normals) return NULL;
    *out = (struct zr_crease_normals){b.normals, numbers, (uint32_t)count};
    blend_normals(&b, cancel);
    for (uint32_t i = 0; i < corners; i++) {
        if (i % NORMALS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) break;
        numbers[i] = number_of(&b, source->corners[i]);
    }
    return out;
}
