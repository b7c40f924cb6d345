/* paint_flat_simd.h - shade: records of one colour, for the paint kernel. */
#ifndef ZR_PAINT_FLAT_SIMD_H
#define ZR_PAINT_FLAT_SIMD_H

#include "shade/paint_simd.h"

/* ---- rows ---- */

/* Four words a colour: their numbers fit 32 bits. */
enum { ZR_GATHERED_MOST = 1 << 28 };

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

/* Whether colours can be gathered by the numbers of triangles. */
static inline bool zr_batch_is_gathered(const struct zr_batch *batch)
{
    return !batch->written && batch->front == batch->back && !batch->faces && batch->count <= ZR_GATHERED_MOST &&
           batch->mesh->position_count <= ZR_GATHERED_MOST;
}

/* A row of such a batch, whose faces have one colour each: where triangles are small that is half the work of
 * going from run to run. Returns how many pixels are owned. */
static inline uint32_t zr_paint_flat_row(const struct zr_batch *batch, uint32_t *owners, int32_t width, zr_vi nothings)
{
    const bool by_corner = batch->colors == ZR_BATCH_PER_FIRST_CORNER;
    const zr_vi one = zr_vi_set(1), first = zr_vi_set((int32_t)batch->first + 1);
    const zr_vi first_face = zr_vi_set((int32_t)batch->first_face);
    uint32_t covered = 0;
    for (int32_t x = 0; x < width; x += ZR_LANES) {
        const zr_vi owner = zr_vi_load(owners + x), t = owner - first;
        const zr_vm within = zr_vi_lt(zr_vi_ramp(), zr_vi_set(width - x));
        const zr_vm owned = zr_vi_lt_where(within, zr_vi_set(0), owner);
        zr_vi colors = nothings;
        if (zr_vm_any(owned)) {
            const zr_vi at = by_corner ? zr_vi_gather(owned, batch->corners, t * zr_vi_set(3)) : t + first_face;
            const zr_vi word = at * zr_vi_set(4);
            const zr_vf red = zr_vf_bits(zr_vi_gather(owned, batch->front, word));
            const zr_vf green = zr_vf_bits(zr_vi_gather(owned, batch->front, word + one));
            const zr_vf blue = zr_vf_bits(zr_vi_gather(owned, batch->front, word + one + one));
            colors = zr_vi_select(owned, zr_color_pack_v(red, green, blue), nothings);
            covered += (uint32_t)__builtin_popcount(zr_vm_bits(owned));
        }
        zr_vi_store(owners + x, colors);
    }
    return covered;
}

/* ---- runs ---- */

struct zr_flat_queue {
    struct zr_runs runs;
    const zr_vec4 *colors[ZR_PAINT_QUEUE];
};

static inline void zr_flat_add(struct zr_flat_queue *q, int32_t at, int32_t length, const zr_vec4 *color)
{
    __builtin_prefetch(color);
    q->colors[q->runs.count] = color;
    q->runs.at[q->runs.count] = at;
    q->runs.length[q->runs.count++] = length;
}

/* All runs of the queue. */
static inline void zr_flat_paint(struct zr_flat_queue *q, uint32_t *out)
{
    for (uint32_t first = 0; first < q->runs.count; first += ZR_LANES) {
        const uint32_t left = q->runs.count - first, some = left < ZR_LANES ? left : ZR_LANES;
        uint32_t packed[ZR_LANES];
        zr_vf red, green, blue, alpha;
        for (uint32_t i = some; i < ZR_LANES; i++)
            q->colors[first + i] = q->colors[first];
#define ZR_COLOR(i) (&q->colors[first + (i)]->x)
        ZR_LOAD4(red, green, blue, alpha, ZR_COLOR);
        (void)alpha;
        zr_vi_store(packed, zr_color_pack_v(red, green, blue));
        for (uint32_t i = 0; i < some; i++)
            zr_fill_run(out + q->runs.at[first + i], (uint32_t)q->runs.length[first + i],
                        zr_vi_set((int32_t)packed[i]));
    }
    q->runs.count = 0;
}

#endif
