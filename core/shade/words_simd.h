/* words_simd.h - shade: what is the same for all pixels of a triangle, four bytes each, ZR_LANES triangles at once, for
 * kernels: the colours of flat ones, and the ids of faces.
 */
#ifndef ZR_WORDS_SIMD_H
#define ZR_WORDS_SIMD_H

#include "base/rgba_simd.h"
#include "geometry/geometry.h"

/* ---- colours ---- */

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

/* Of triangles t: the number of the colour, backs being numbered behind all fronts. */
static inline zr_vi zr_flat_number(const struct zr_batch *batch, zr_vm owned, zr_vi t)
{
    zr_vi number = zr_flat_color(batch, owned, t);
    if (batch->sided) {
        const zr_vi backs = zr_vi_gather(owned, batch->backs, t >> 5), one = zr_vi_set(1);
        const zr_vm back = zr_vi_eq(backs >> (t & zr_vi_set(31)) & one, one);
        number = number + zr_vi_select(back, zr_vi_set((int32_t)batch->color_count), zr_vi_set(0));
    }
    return zr_vi_select(owned, number, zr_vi_set(0));
}

/* Where a colour that is not packed stands. */
static inline const float *zr_flat_at(const struct zr_batch *batch, int32_t number)
{
    const uint32_t n = (uint32_t)number, count = batch->color_count;
    return n < count ? &batch->front[n].x : &batch->back[n - count].x;
}

/* Colours of sided batches, where they are not packed, stand in two arrays. */
static inline zr_vi zr_flat_look_up_sided(const struct zr_batch *batch, zr_vi number)
{
    int32_t numbers[ZR_LANES];
    zr_vf red, green, blue, alpha;
    zr_vi_store(numbers, number);
#define ZR_FLAT_COLOR(i) zr_flat_at(batch, numbers[i])
    ZR_LOAD4(red, green, blue, alpha, ZR_FLAT_COLOR);
#undef ZR_FLAT_COLOR
    (void)alpha;
    return zr_rgba_opaque_v(red, green, blue);
}

static inline zr_vi zr_flat_look_up(const struct zr_batch *batch, zr_vi number)
{
    zr_vf red, green, blue;
    if (batch->packed) return zr_vi_gather(ZR_ALL_LANES, batch->packed, number);
    if (batch->sided) return zr_flat_look_up_sided(batch, number);
    zr_vf_gather_fours(&batch->front->x, number, &red, &green, &blue);
    return zr_rgba_opaque_v(red, green, blue);
}

/* ---- faces ---- */

/* Ids of the faces of triangles t. */
static inline zr_vi zr_flat_face(const struct zr_batch *batch, zr_vi t)
{
    const zr_vi face =
        batch->faces ? zr_vi_gather(ZR_ALL_LANES, batch->faces, t) : t + zr_vi_set((int32_t)batch->first_face);
    return face + zr_vi_set((int32_t)batch->first_id);
}

#endif
