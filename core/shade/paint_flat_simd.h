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

/* So many rows wait for their colours, which were asked for when the row was added. With one row that saves 7 to 13 %
 * of a million triangles' time, with four another 3 to 5 %. */
enum { ZR_FLAT_ROWS = 4 };

struct zr_flat_row {
    uint32_t *owners;
    int32_t numbers[ZR_TILE_SIZE]; /* of their colours (zr_flat_number); 0 in lanes without an owner, beside some that
                                      have one */
};

/* Rows of one batch, in a ring. */
struct zr_flat_rows {
    const struct zr_batch *batch;
    zr_vi nothings;
    int32_t width;
    uint32_t added, painted, covered; /* rows, and pixels that are owned */
    struct zr_flat_row rows[ZR_FLAT_ROWS];
};

static inline void zr_flat_begin(struct zr_flat_rows *flat, int32_t width, zr_vi nothings)
{
    flat->batch = NULL;
    flat->nothings = nothings;
    flat->width = width;
    flat->added = flat->painted = flat->covered = 0;
}

/* Which lanes have an owner within a row of this width, from x on. */
static inline zr_vm zr_owned_of(zr_vi owners, int32_t x, int32_t width)
{
    return zr_vi_lt_where(zr_vi_lt(zr_vi_ramp(), zr_vi_set(width - x)), zr_vi_set(0), owners);
}

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

/* The numbers of a row's colours, which are asked for. Large triangles have the same owners again and again. */
static inline void zr_flat_ask(const struct zr_flat_rows *flat, const uint32_t *owners, int32_t *numbers)
{
    const struct zr_batch *batch = flat->batch;
    const zr_vi first = zr_vi_set((int32_t)batch->first + 1);
    zr_vi last_owner = zr_vi_set(0), number = zr_vi_set(0);
    for (int32_t x = 0; x < flat->width; x += ZR_LANES) {
        const zr_vi owner = zr_vi_load(owners + x);
        const zr_vm owned = zr_owned_of(owner, x, flat->width);
        if (!zr_vm_any(owned)) continue;
        const bool known = zr_vm_bits(zr_vi_eq(owner, last_owner)) == ZR_ALL_BITS;
        if (!known) number = zr_flat_number(batch, owned, owner - first);
        zr_vi_store(numbers + x, number);
        for (int i = 0; !known && !batch->packed && i < ZR_LANES; i++)
            __builtin_prefetch(zr_flat_at(batch, numbers[x + i]));
        last_owner = owner;
    }
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

/* The owners of the row that waits longest become colours. */
static inline void zr_flat_paint(struct zr_flat_rows *flat)
{
    const struct zr_flat_row *row = &flat->rows[flat->painted++ % ZR_FLAT_ROWS];
    zr_vi last_number = zr_vi_set(-1), color = zr_vi_set(0);
    for (int32_t x = 0; x < flat->width; x += ZR_LANES) {
        const zr_vm owned = zr_owned_of(zr_vi_load(row->owners + x), x, flat->width);
        zr_vi painted = flat->nothings;
        if (zr_vm_any(owned)) {
            const zr_vi number = zr_vi_load(row->numbers + x);
            if (zr_vm_bits(zr_vi_eq(number, last_number)) != ZR_ALL_BITS) {
                color = zr_flat_look_up(flat->batch, number);
                last_number = number;
            }
            painted = zr_vi_select(owned, color, painted);
            flat->covered += (uint32_t)__builtin_popcount(zr_vm_bits(owned));
        }
        zr_vi_store(row->owners + x, painted);
    }
}

/* All that wait. Returns how many pixels are owned, in all rows that were added. */
static inline uint32_t zr_flat_end(struct zr_flat_rows *flat)
{
    while (flat->painted < flat->added)
        zr_flat_paint(flat);
    return flat->covered;
}

/* A row of owners of the batch, or of nobody, whose faces have one colour each: where triangles are small that is half
 * the work of going from run to run. */
static inline void zr_flat_add(struct zr_flat_rows *flat, const struct zr_batch *batch, uint32_t *owners)
{
    if (batch != flat->batch) zr_flat_end(flat);
    if (flat->added - flat->painted == ZR_FLAT_ROWS) zr_flat_paint(flat);
    struct zr_flat_row *row = &flat->rows[flat->added++ % ZR_FLAT_ROWS];
    flat->batch = batch;
    row->owners = owners;
    zr_flat_ask(flat, owners, row->numbers);
}

#endif
