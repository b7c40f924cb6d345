/* parts_simd.h - shade: splits the owners of a tile into parts, for kernels.
 *
 * A part is the set of pixels that one owner covers in a patch. A patch has as many pixels as there are lanes: 4x4 with
 * 16. A block that one owner covers is one part, together with such blocks right behind it. Values common to an owner's
 * pixels are computed once per part, for many parts at a time.
 */
#ifndef ZR_PARTS_SIMD_H
#define ZR_PARTS_SIMD_H

#include "base/simd.h"
#include "raster/tile_simd.h"

enum {
    ZR_BLOCK_PATCHES = ZR_BLOCK_WIDTH * ZR_BLOCK_HEIGHT / ZR_LANES,
    ZR_PATCHES_ACROSS = ZR_BLOCK_WIDTH / ZR_PATCH_COLUMNS, /* in a block */
    ZR_PARTS_A_ROW = ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH * ZR_BLOCK_HEIGHT,
    ZR_PARTS_MOST = 2 * ZR_PARTS_A_ROW,
    ZR_PARTS_AT_ONCE = ZR_LANES < 8 ? 1 : 4,                    /* read together, even if a patch has fewer */
    ZR_PARTS_ROOM = ZR_PARTS_MOST + ZR_LANES + ZR_PARTS_AT_ONCE /* entries behind the last may be written and read */
};

/* Parts of a block. */
struct zr_block_parts {
    bool is_whole;
    uint32_t first;                    /* part of the whole block, or first part of its patches */
    uint8_t patches[ZR_BLOCK_PATCHES]; /* parts per patch, numbered in sequence; unless whole */
};

struct zr_parts {
    uint32_t count;
    uint32_t owners[ZR_PARTS_ROOM]; /* the first is 0: uncovered whole blocks */
    struct zr_block_parts blocks[ZR_BLOCKS];
};

/* ---- blocks and patches ---- */

/* Return a block's first column and row in the tile. */
static inline int32_t zr_block_left(int block)
{
    return block % ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH;
}

static inline int32_t zr_block_low(int block)
{
    return block / ZR_BLOCK_COLUMNS * ZR_BLOCK_HEIGHT;
}

/* Coordinates of a block's patches. */
struct zr_patch_place {
    zr_vi column, row; /* of each lane in its patch */
    int32_t left, low; /* of the block, in the window */
};

static inline struct zr_patch_place zr_patch_place_of(const struct zr_tile *tile, int number)
{
    const zr_vi lane = zr_vi_ramp(), column = lane & zr_vi_set(ZR_PATCH_COLUMNS - 1);
    return (struct zr_patch_place){column, (lane - column) >> (ZR_PATCH_COLUMNS == 4 ? 2 : 0),
                                   tile->x + zr_block_left(number), tile->y + zr_block_low(number)};
}
_Static_assert(ZR_PATCH_COLUMNS == 4 || ZR_LANES == 1, "rows are a shift");

/* Returns the index of the first pixel of patch `p` of a block in the tile's arrays. */
static inline int32_t zr_patch_first(int block, int p)
{
    return (int32_t)zr_block_first(block) + p / ZR_PATCHES_ACROSS * ZR_PATCH_ROWS * ZR_TILE_STRIDE +
           p % ZR_PATCHES_ACROSS * ZR_PATCH_COLUMNS;
}

/* Returns the owners of a patch; without_early: 0 for pixels with an early colour. */
static inline zr_vi zr_patch_owners(const struct zr_tile *tile, int32_t at, bool without_early)
{
    const zr_vi owner = zr_vi_load_patch(tile->owner + at, ZR_TILE_STRIDE), none = zr_vi_set(0);
    if (!without_early) return owner;
    const zr_vi color = zr_vi_load_patch(tile->early_color + at, ZR_TILE_STRIDE);
    return zr_vi_select(zr_vi_eq(color, none), owner, none);
}

/* Returns the lanes whose owner is that of the lane n before; `later`: owners shifted by n lanes. */
static inline uint32_t zr_patch_again(zr_vi owner, zr_vi later, int n)
{
    return zr_vm_bits(zr_vi_eq(owner, later)) & ~0u << n;
}

/* Returns the lanes whose owner differs from those 1, 3 and 4 lanes before, mostly neighbours in the patch. A triangle
 * has one such lane in the patch, seldom more; its first lane is always one. Lanes without an owner must be 0. */
static inline uint32_t zr_patch_firsts(zr_vi owner)
{
    uint32_t again = zr_patch_again(owner, zr_vi_later(owner, 1), 1);
    if (ZR_PATCH_ROWS > 1)
        again |= zr_patch_again(owner, zr_vi_later(owner, 3), 3) | zr_patch_again(owner, zr_vi_later(owner, 4), 4);
    return ~again;
}

/* ---- parts of blocks ---- */

/* Returns true if the block has one owner, or none. */
static inline bool zr_block_is_whole(const struct zr_tile *tile, int block)
{
    const uint32_t *owners = &tile->owner[zr_block_first(block)];
    const zr_vi first = zr_vi_set((int32_t)owners[0]);
    for (int row = 0; row < ZR_BLOCK_HEIGHT; row++, owners += ZR_TILE_STRIDE)
        for (int v = 0; v < ZR_BLOCK_PARTS; v++)
            if (zr_vm_bits(zr_vi_eq(zr_vi_load(owners + v * ZR_LANES), first)) != ZR_ALL_BITS) return false;
    return true;
}

/* Adds the part of a whole block. Returns the new number of parts, as do the functions below. */
static inline uint32_t zr_parts_add_whole(struct zr_parts *parts, uint32_t count, int block, uint32_t owner)
{
    parts->owners[count] = owner;
    count += owner != 0 && owner != parts->owners[count - 1];
    parts->blocks[block].is_whole = true;
    parts->blocks[block].first = owner == 0 ? 0 : count - 1;
    return count;
}

static inline uint32_t zr_parts_add_patches(struct zr_parts *parts, uint32_t count, const struct zr_tile *tile,
                                            int block, bool without_early)
{
    struct zr_block_parts *out = &parts->blocks[block];
    out->is_whole = false;
    out->first = count;
    for (int p = 0; p < ZR_BLOCK_PATCHES; p++) {
        const zr_vi owner = zr_patch_owners(tile, zr_patch_first(block, p), without_early);
        const uint32_t owned = zr_vm_bits(zr_vi_lt(zr_vi_set(0), owner));
        const uint32_t firsts = owned ? owned & zr_patch_firsts(owner) : 0;
        const uint32_t of_patch = zr_vi_compress(parts->owners + count, zr_vm_of(firsts), owner);
        out->patches[p] = (uint8_t)of_patch;
        count += of_patch;
    }
    return count;
}

/* Adds the parts of a block. without_early: pixels with an early colour count as uncovered. */
static inline uint32_t zr_parts_find(struct zr_parts *parts, uint32_t count, const struct zr_tile *tile, int block,
                                     bool without_early)
{
    if (tile->has_block_owners && tile->block_owner[block] != ZR_BLOCK_SHARED)
        return zr_parts_add_whole(parts, count, block, tile->block_owner[block]);
    if (!without_early && zr_block_is_whole(tile, block))
        return zr_parts_add_whole(parts, count, block, tile->owner[zr_block_first(block)]);
    return zr_parts_add_patches(parts, count, tile, block, without_early);
}

#endif
