/* paint_flat_simd.h - shade: rows of triangles of one colour each, for the paint kernel. */
#ifndef ZR_PAINT_FLAT_SIMD_H
#define ZR_PAINT_FLAT_SIMD_H

#include "shade/paint_simd.h"

/* Whether the owners of a row are the batch's, or nobody. */
static inline bool zr_row_is_of(const struct zr_batch *batch, const uint32_t *owners, int32_t width)
{
    const zr_vi first = zr_vi_set((int32_t)batch->first + 1), count = zr_vi_set((int32_t)batch->count);
    for (int32_t x = 0; x < width; x += ZR_LANES) {
        const zr_vi owner = zr_vi_load(owners + x), t = owner - first;
        const zr_vm inside = zr_vi_lt_where(zr_vi_lt(zr_vi_set(-1), t), t, count);
        const zr_vm within = zr_vi_lt(zr_vi_ramp(), zr_vi_set(width - x));
        if (zr_vm_any(zr_vm_andnot(within, zr_vm_or(inside, zr_vi_eq(owner, zr_vi_set(0)))))) return false;
    }
    return true;
}

/* The owners that colours were gathered for last: in the rows of large triangles they are the same again. */
struct zr_flat_memory {
    zr_vi owner, color;
};

/* As zr_batch_color, of triangles t. */
static inline zr_vi zr_flat_color(const struct zr_batch *batch, zr_vm owned, zr_vi t)
{
    if (batch->colors == ZR_BATCH_PER_FIRST_CORNER && !batch->faces)
        return zr_vi_gather(owned, batch->corners, t * zr_vi_set(3));
    const zr_vi face = batch->faces ? zr_vi_gather(owned, batch->faces, t) : t + zr_vi_set((int32_t)batch->first_face);
    if (batch->colors == ZR_BATCH_PER_FACE) return face;
    const zr_vi slot = zr_vi_gather(owned, batch->mesh->face_offsets, face);
    return batch->colors == ZR_BATCH_PER_FIRST_SLOT ? slot : zr_vi_gather(owned, batch->mesh->indices, slot);
}

/* Colours of the lanes that are owned. */
static inline zr_vi zr_gather_flat(const struct zr_batch *batch, zr_vm owned, zr_vi owner)
{
    const zr_vi t = owner - zr_vi_set((int32_t)batch->first + 1), color = zr_flat_color(batch, owned, t);
    zr_vf red, green, blue;
    if (batch->packed) return zr_vi_gather(owned, batch->packed, color);
    zr_vf_gather_fours(owned, &batch->front->x, color, &red, &green, &blue);
    return zr_color_pack_v(red, green, blue);
}

/* A row of such a batch, whose faces have one colour each: where triangles are small that is half the work of
 * going from run to run. Returns how many pixels are owned. */
static inline uint32_t zr_paint_flat_row(const struct zr_batch *batch, struct zr_flat_memory *memory, uint32_t *owners,
                                         int32_t width, zr_vi nothings)
{
    uint32_t covered = 0;
    for (int32_t x = 0; x < width; x += ZR_LANES) {
        const zr_vi owner = zr_vi_load(owners + x);
        const zr_vm within = zr_vi_lt(zr_vi_ramp(), zr_vi_set(width - x));
        const zr_vm owned = zr_vi_lt_where(within, zr_vi_set(0), owner);
        zr_vi colors = nothings;
        if (zr_vm_any(owned)) {
            if (zr_vm_bits(zr_vi_eq(owner, memory->owner)) != ZR_ALL_BITS) {
                memory->color = zr_gather_flat(batch, owned, owner);
                memory->owner = owner;
            }
            colors = zr_vi_select(owned, memory->color, nothings);
            covered += (uint32_t)__builtin_popcount(zr_vm_bits(owned));
        }
        zr_vi_store(owners + x, colors);
    }
    return covered;
}

#endif
