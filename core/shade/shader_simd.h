/* shader_simd.h - shade: state of the shading kernel: parts and their words or planes.
 *
 * A channel walks the runs of parts and gives each part a word or planes (channels/). Then each pixel evaluates its
 * part, patch by patch (blocks_simd.h).
 */
#ifndef ZR_SHADER_SIMD_H
#define ZR_SHADER_SIMD_H

#include "base/simd/simd.h"
#include "raster/tile_simd.h"
#include "shade/models/models_simd.h"
#include "shade/planes_simd.h"

/* Splits the owners of a tile into parts, for kernels.
 *
 * A part is the set of pixels that one owner covers in a patch. A patch has as many pixels as there are lanes: 4x4 with
 * 16. A block that one owner covers is one part, together with such blocks right behind it. Values common to an owner's
 * pixels are computed once per part, for many parts at a time.
 */
enum {
    ZR_BLOCK_PATCHES = ZR_BLOCK_WIDTH * ZR_BLOCK_HEIGHT / ZR_LANES,
    ZR_PATCHES_ACROSS = ZR_BLOCK_WIDTH / ZR_PATCH_COLUMNS, /* in a block */
    ZR_PARTS_PER_ROW = ZR_BLOCK_COLUMNS * ZR_BLOCK_WIDTH * ZR_BLOCK_HEIGHT,
    ZR_PARTS_MOST = 2 * ZR_PARTS_PER_ROW,
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

/* Up to ZR_LANES consecutive parts of one draw. */
struct zr_draw_run {
    const struct zr_draw *draw;
    const struct zr_draw_attributes *of_draw;
    uint32_t first, count;
};

/* State of the kernel. A part has a word if its pixels share one colour, else planes. Part 0 stands for uncovered
 * pixels and belongs to no run. */
struct zr_shader {
    const struct zr_geometry *geometry;
    const struct zr_scene_attributes *attributes;
    const struct zr_draw *draw; /* draw of the last run; the first one initially */
    struct zr_parts parts;
    uint32_t run_count;
    struct zr_draw_run runs[ZR_PARTS_MOST];
    bool any_planes;
    bool has_planes[ZR_PARTS_ROOM];
    bool is_constant[ZR_PARTS_ROOM]; /* with fog or textures: the colour's planes are constants, not over w */
    uint32_t words[ZR_PARTS_ROOM];
    const struct zr_material *materials[ZR_PARTS_ROOM]; /* of parts shaded per pixel, else NULL; unset if no part is */
    bool any_per_pixel;
    struct zr_model_context model;
    /* Planes of 1/w and of each value, part after part. */
    float planes[ZR_PARTS_ROOM * ZR_PLANES_MOST][4]; /* a0, dadx, dady */
};

/* Compiled in a kernel of their own (paint_textured_kernel.c), since their code would slow down untextured shading: the
 * channel color of textured scenes, and texture values of samples. Blocks begin .. end - 1. */
void ZR_KERNEL(zr_paint_textured)(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                  const struct zr_tile_targets *to);
void ZR_KERNEL(zr_sample_textures)(struct zr_shader *s, const struct zr_tile *tile, int begin, int end,
                                   const struct zr_gbuffer *to);

static inline const struct zr_draw_attributes *zr_attributes_of_draw(const struct zr_shader *s,
                                                                     const struct zr_draw *draw)
{
    return &s->attributes->of_draw[draw - s->geometry->draws];
}

/* ---- runs of parts ---- */

/* Returns the numbers of the run's triangles in its draw. Lanes beyond its end repeat the first. */
static inline zr_vi zr_draw_run_numbers(const struct zr_shader *s, const struct zr_draw_run *run)
{
    const uint32_t *owners = s->parts.owners + run->first;
    const zr_vi owner = zr_vi_select(zr_vm_first(run->count), zr_vi_load(owners), zr_vi_set((int32_t)owners[0]));
    return owner - zr_vi_set((int32_t)run->draw->first + 1);
}

static inline void zr_find_runs(struct zr_shader *s)
{
    uint32_t *owners = s->parts.owners;
    s->run_count = 0;
    for (uint32_t i = 1, count; i < s->parts.count; i += count) {
        const uint32_t left = s->parts.count - i;
        struct zr_draw_run *run = &s->runs[s->run_count++];
        const struct zr_draw *draw = s->draw = zr_draw_next(s->geometry, s->draw, owners[i] - 1);
        const zr_vi t = zr_vi_load(owners + i) - zr_vi_set((int32_t)draw->first + 1);
        const zr_vm of_draw = zr_vi_lt_where(zr_vi_lt(zr_vi_set(-1), t), t, zr_vi_set((int32_t)draw->count));
        const uint32_t others = zr_vm_bits(of_draw) ^ ZR_ALL_BITS;
        count = others ? (uint32_t)zr_lowest_bit(others) : ZR_LANES;
        count = count < left ? count : left;
        *run = (struct zr_draw_run){draw, zr_attributes_of_draw(s, draw), i, count};
    }
}

/* Finds the parts and runs of blocks from `begin` on, as many rows of blocks as fit. Returns the end. */
static inline int zr_find_parts(struct zr_shader *s, const struct zr_tile *tile, int begin, bool without_early)
{
    const int end = (tile->height + ZR_BLOCK_HEIGHT - 1) / ZR_BLOCK_HEIGHT * ZR_BLOCK_COLUMNS;
    const int across = (tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    int row = begin;
    uint32_t count = 1;
    s->parts.owners[0] = 0;
    for (; row < end && count + ZR_PARTS_PER_ROW <= ZR_PARTS_MOST; row += ZR_BLOCK_COLUMNS)
        for (int b = row; b < row + across; b++)
            count = zr_parts_find(&s->parts, count, tile, b, without_early);
    s->parts.count = count;
    for (uint32_t i = 0; i < ZR_PARTS_AT_ONCE; i++)
        s->parts.owners[count + i] = UINT32_MAX;
    zr_find_runs(s);
    return row;
}

static inline void zr_put_words(struct zr_shader *s, const struct zr_draw_run *run, zr_vi words)
{
    zr_vi_store(s->words + run->first, words);
    memset(s->has_planes + run->first, false, ZR_LANES);
}

/* ---- planes of parts ---- */

/* Stores plane k of ZR_LANES parts, which have `count` planes each. */
ZR_INLINED void zr_put_plane(struct zr_shader *s, uint32_t first, int k, int count, const struct zr_plane_v *plane)
{
    float fours[4 * ZR_LANES];
    zr_vf_store4(fours, plane->a0, plane->dadx, plane->dady, zr_vf_set(0.0f));
    for (uint32_t i = 0; i < ZR_LANES; i++)
        memcpy(s->planes[(first + i) * (uint32_t)count + (uint32_t)k], fours + 4 * i, 4 * sizeof(float));
}

/* Selects each lane's planes by its owner among `count` parts; lanes of other owners get any. */
ZR_INLINED void zr_select_planes(const struct zr_shader *s, uint32_t first, uint32_t count, zr_vi owner, int planes,
                                 zr_vf (*out)[3])
{
    const float(*from)[4] = &s->planes[first * (uint32_t)planes];
    for (int k = 0; k < planes; k++)
        for (int j = 0; j < 3; j++)
            out[k][j] = zr_vf_set(from[k][j]);
    for (uint32_t i = first + 1; i < first + count; i++) {
        const zr_vm here = zr_vi_eq(owner, zr_vi_set((int32_t)s->parts.owners[i]));
        from = &s->planes[i * (uint32_t)planes];
        for (int k = 0; k < planes; k++)
            for (int j = 0; j < 3; j++)
                out[k][j] = zr_vf_select(here, zr_vf_set(from[k][j]), out[k][j]);
    }
}

static inline zr_vf zr_shaded_value(zr_vf (*planes)[3], int k, zr_vf x, zr_vf y)
{
    const struct zr_plane_v plane = {planes[k][0], planes[k][1], planes[k][2]};
    return zr_plane_at_v(&plane, x, y);
}

#endif
