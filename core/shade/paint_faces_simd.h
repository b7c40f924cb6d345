/* paint_faces_simd.h - shade: rows of ids of faces, for the paint kernel. */
#ifndef ZR_PAINT_FACES_SIMD_H
#define ZR_PAINT_FACES_SIMD_H

#include "shade/paint_flat_simd.h"

/* A row of a batch that is not written, or of nobody. `add`: to the ids. */
static inline void zr_paint_faces_alone(const struct zr_batch *batch, uint32_t add, const uint32_t *owners,
                                        int32_t width, uint32_t *out)
{
    const zr_vi first = zr_vi_set((int32_t)batch->first + 1), first_face = zr_vi_set((int32_t)batch->first_face);
    const zr_vi first_id = zr_vi_set((int32_t)(batch->first_id + add));
    for (int32_t x = 0; x < width; x += ZR_LANES) {
        const zr_vi owner = zr_vi_load(owners + x), t = owner - first;
        const zr_vm within = zr_vi_lt(zr_vi_ramp(), zr_vi_set(width - x));
        const zr_vm owned = zr_vi_lt_where(within, zr_vi_set(0), owner);
        const zr_vi face = batch->faces ? zr_vi_gather(owned, batch->faces, t) : t + first_face;
        zr_vi_store(out + x, zr_vi_select(owned, face + first_id, zr_vi_set(0)));
    }
}

/* A row of any owners, whose runs end where `ends` says. Returns the batch of the last one. */
static inline const struct zr_batch *zr_paint_faces_mixed(const struct zr_geometry *geometry,
                                                          const struct zr_batch *batch, uint32_t add,
                                                          const uint32_t *owners, uint64_t ends, uint32_t *out)
{
    int32_t begin = 0, end;
    for (; ends; ends &= ends - 1, begin = end) {
        const uint32_t owner = owners[begin];
        uint32_t id = 0;
        end = __builtin_ctzll(ends) + 1;
        if (owner > 0) {
            batch = zr_batch_next(geometry, batch, owner - 1);
            id = zr_face_id(geometry, batch, owner - 1) + add;
        }
        zr_fill_run(out + begin, (uint32_t)(end - begin), zr_vi_set((int32_t)id));
    }
    return batch;
}

#endif
