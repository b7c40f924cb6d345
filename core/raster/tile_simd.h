/* tile_simd.h - raster: z-buffer operations on ZR_LANES samples, and on blocks, for kernels. */
#ifndef ZR_TILE_SIMD_H
#define ZR_TILE_SIMD_H

#include "base/simd/simd.h"
#include "raster/tile.h"
#include "raster/triangle_simd.h"

/* Result for ZR_LANES samples. */
struct zr_put_v {
    zr_vm seen;
    zr_vf nearest; /* the depths after the operation */
};

/* Stores the visible lanes by zr_tile_put's rule. Addresses are multiples of ZR_LANES, and all lanes of the depths are
 * stored. The next triangle loads them, and anything but the same whole vector would cause a store-forwarding stall (a
 * third of the bunny's time). Owners are loaded only at equal depths, which are rare (4 % of the bunny). */
static inline struct zr_put_v zr_tile_put_v(float *depth, uint32_t *owners, zr_vm inside, zr_vf z, zr_vi owner)
{
    const zr_vf old = zr_vf_load(depth);
    const zr_vm ties = zr_vf_eq_where(inside, z, old);
    zr_vm seen = ZR_MUTANT(farther_wins, zr_vf_lt_where(inside, z, old), zr_vf_lt_where(inside, old, z));
    if (__builtin_expect(zr_vm_any(ties), 0)) {
        const zr_vi others = zr_vi_load(owners);
        seen = zr_vm_or(
            seen, ZR_MUTANT(later_wins_ties, zr_vi_lt_where(ties, owner, others), zr_vi_lt_where(ties, others, owner)));
    }
    const zr_vf nearest = zr_vf_select(seen, z, old);
    zr_vf_store(depth, nearest);
    zr_vi_store_where(owners, seen, owner);
    return (struct zr_put_v){seen, nearest};
}

/* Same for samples not yet written: lanes that are not visible become uncovered. Returns the depths. */
static inline zr_vf zr_tile_put_first_v(float *depth, uint32_t *owners, zr_vm inside, zr_vf z, zr_vi owner)
{
    const zr_vf one = zr_vf_set(1.0f);
    const zr_vm seen = zr_vf_lt_where(inside, z, one);
    const zr_vf nearest = zr_vf_select(seen, z, one);
    zr_vf_store(depth, nearest);
    zr_vi_store(owners, zr_vi_select(seen, owner, zr_vi_set(0)));
    return nearest;
}

/* Adds lanes in front of the opaque samples to the tile's lists. `first`: index of lane 0. */
static inline void zr_tile_list_v(struct zr_tile *tile, size_t first, zr_vm inside, zr_vf z, uint32_t owner)
{
    float depths[ZR_LANES];
    uint32_t bits = zr_vm_bits(zr_vf_lt_where(inside, z, zr_vf_load(tile->depth + first)));
    if (!bits) return;
    if (tile->fragments->marks) {
        float *to = tile->fragments->marks->depths;
        zr_fragment_marks_put(tile->fragments->marks, (uint32_t)first, bits, owner);
        if (to) zr_vf_store(to + first, zr_vf_select(zr_vm_of(bits), z, zr_vf_load(to + first)));
        return;
    }
    zr_vf_store(depths, z);
    for (; bits; bits &= bits - 1) {
        const uint32_t lane = (uint32_t)zr_lowest_bit(bits);
        zr_fragments_put(tile->fragments, (uint32_t)first + lane, depths[lane], owner);
    }
}

/* ---- blocks ---- */

/* Vectors across a block. Non-temporal stores must be made row by row: they combine to whole cache lines only then. */
enum { ZR_BLOCK_PARTS = ZR_BLOCK_WIDTH / ZR_LANES };

static inline size_t zr_block_first(int block)
{
    return (size_t)(block / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT) * ZR_TILE_STRIDE +
           (size_t)(block % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH);
}

/* Depths of ZR_LANES columns of a plane, evaluated row by row. */
struct zr_depth_columns {
    zr_vf across, dady, offset;
};

static inline struct zr_depth_columns zr_depth_columns_of(const struct zr_depth *depth, int32_t x)
{
    const zr_vf columns = zr_vf_of(zr_vi_set(x) + zr_vi_ramp());
    return (struct zr_depth_columns){zr_vf_set(depth->plane.a0) + zr_vf_set(depth->plane.dadx) * columns,
                                     zr_vf_set(depth->plane.dady), zr_vf_set(depth->offset)};
}

static inline zr_vf zr_depth_columns_at(const struct zr_depth_columns *c, zr_vf y)
{
    return zr_depth_clamp_v((c->across + c->dady * y) + c->offset);
}

/* Writes the depths of an unwritten block to rows of `out`, `stride` apart. An uncovered block needs no plane (1 % of
 * the bunny at 512x512). */
static inline void zr_block_write_depths(const struct zr_tile *tile, int block, float *out, ptrdiff_t stride,
                                         bool streamed)
{
    if (tile->block_owner[block] == 0) {
        for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, out += stride)
            for (int v = 0; v < ZR_BLOCK_PARTS; v++)
                zr_vi_put(out + v * ZR_LANES, zr_vi_bits_of(zr_vf_set(1.0f)), streamed);
        return;
    }
    const int32_t x = tile->x + block % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH;
    const int32_t y = tile->y + block / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT;
    struct zr_depth_columns columns[ZR_BLOCK_PARTS];
    zr_vf fy = zr_vf_set((float)y);
    for (int v = 0; v < ZR_BLOCK_PARTS; v++)
        columns[v] = zr_depth_columns_of(&tile->block_depth[block], x + v * ZR_LANES);
    for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, out += stride, fy = fy + zr_vf_set(1.0f))
        for (int v = 0; v < ZR_BLOCK_PARTS; v++)
            zr_vi_put(out + v * ZR_LANES, zr_vi_bits_of(zr_depth_columns_at(&columns[v], fy)), streamed);
}

/* Writes an unwritten block's depths and owners to the tile. */
static inline void zr_block_write(struct zr_tile *tile, int block)
{
    const size_t first = zr_block_first(block);
    const zr_vi owner = zr_vi_set((int32_t)tile->block_owner[block]);
    zr_block_write_depths(tile, block, tile->depth + first, ZR_TILE_STRIDE, false);
    for (size_t row = 0; row < ZR_BLOCK_HEIGHT; row++)
        for (size_t v = 0; v < ZR_BLOCK_WIDTH; v += ZR_LANES)
            zr_vi_store(&tile->owner[first + row * ZR_TILE_STRIDE + v], owner);
}

#endif
