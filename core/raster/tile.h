/* tile.h - raster: a square of the window, processed by one thread.
 *
 * Space:  window space, y up; row 0 of a tile is its lowest.
 * Why:    depth and owner of 64x64 samples stay in the first-level cache until the tile is resolved to channels, and no
 *         other thread accesses them. */
#ifndef ZR_TILE_H
#define ZR_TILE_H

#include <stddef.h>
#include <stdint.h>

#include "raster/depth.h"
#include "raster/fragments.h"
#include "scene/scene.h"

/* The padding after a row lets vectors read beyond its end, and spreads rows over different cache sets. */
enum { ZR_TILE_SIZE = 64, ZR_TILE_STRIDE = ZR_TILE_SIZE + 16 };

/* Blocks of a tile, each with a bound of its depths, so that hidden blocks are skipped without testing samples. */
enum {
    ZR_BLOCK_WIDTH = 16,
    ZR_BLOCK_HEIGHT = 8,
    ZR_BLOCK_COLUMNS = ZR_TILE_SIZE / ZR_BLOCK_WIDTH,
    ZR_BLOCKS = ZR_BLOCK_COLUMNS * (ZR_TILE_SIZE / ZR_BLOCK_HEIGHT)
};

/* Value of block_owner above all owner ids: the block may show several large triangles, or one and uncovered
 * samples. */
enum { ZR_BLOCK_SHARED = INT32_MAX };

struct zr_tile {
    int32_t x, y;                   /* lowest pixel */
    int32_t width, height;          /* smaller at the window's upper and right border */
    bool is_empty;                  /* nothing is drawn, and nothing below is defined */
    struct zr_fragments *fragments; /* receives fragments in front of the depths; NULL: draw to depth and owner */
    float far;                      /* no sample is deeper */
    /* [row of blocks * ZR_BLOCK_COLUMNS + column]: no sample of the block is deeper. 0 for blocks outside the
     * window. */
    float block_far[ZR_BLOCKS];
    bool has_block_owners;           /* block_owner is valid and all blocks are whole */
    uint32_t block_owner[ZR_BLOCKS]; /* owner of all samples; 0: uncovered; or ZR_BLOCK_SHARED */
    /* One bit per block whose samples are not written: all of them belong to the owner, on the plane of block_depth, or
     * are uncovered at depth 1. A frame can be resolved without writing them, which saves a sixth of the time of a
     * cube, and of large triangles. */
    uint32_t unwritten;
    struct zr_depth block_depth[ZR_BLOCKS]; /* planes of unwritten blocks with an owner */
    /* [row * ZR_TILE_STRIDE + column] */
    _Alignas(64) float depth[ZR_TILE_STRIDE * ZR_TILE_SIZE]; /* window depth; initial values: zr_tile_begin */
    uint8_t apart[2048]; /* avoids 4K aliasing between loads of depths and stores of owners, 5 pages apart */
    _Alignas(64) uint32_t owner[ZR_TILE_STRIDE * ZR_TILE_SIZE];       /* 1 + number of the primitive, 0 if uncovered */
    bool has_early_color;                                             /* `early_color` is valid */
    _Alignas(64) uint32_t early_color[ZR_TILE_STRIDE * ZR_TILE_SIZE]; /* early colours (prepaint.h), RGBA; 0: none */
};

_Static_assert(ZR_BLOCKS == 32, "one bit per block");

/* Returns the blocks that lie at least partly in the window, one bit each. */
static inline uint32_t zr_tile_blocks(const struct zr_tile *tile)
{
    const int32_t columns = (tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    const int32_t rows = (tile->height + ZR_BLOCK_HEIGHT - 1) / ZR_BLOCK_HEIGHT;
    const uint32_t first_of_rows = UINT32_C(0x11111111) >> (ZR_BLOCKS - ZR_BLOCK_COLUMNS * rows);
    return first_of_rows * ((1u << columns) - 1);
}
_Static_assert(ZR_BLOCK_COLUMNS == 4, "a row of blocks is a hexadecimal digit");

/* Returns true if the window's border cuts no block. */
static inline bool zr_tile_has_whole_blocks(const struct zr_tile *tile)
{
    return tile->width % ZR_BLOCK_WIDTH == 0 && tile->height % ZR_BLOCK_HEIGHT == 0;
}

/* Returns the number of tiles for `pixels` in a row or a column. */
static inline uint32_t zr_tile_across(uint32_t pixels)
{
    return (pixels + ZR_TILE_SIZE - 1) / ZR_TILE_SIZE;
}

/* Returns the number of tiles of a window. Tile 0 is at its lower left, followed by those to its right. */
static inline size_t zr_tile_count(uint32_t width, uint32_t height)
{
    return (size_t)zr_tile_across(width) * zr_tile_across(height);
}

/* The z-buffer: stores the fragment if it is nearer than the sample, or as near and earlier in the scene. This equals
 * drawing in order and keeping the nearest (GL's LESS), for any order and any thread. A fragment as deep as the initial
 * depth is not visible. */
static inline bool zr_tile_put_at(struct zr_tile *tile, uint32_t i, float depth, uint32_t owner)
{
    const float old = tile->depth[i];
    if (!(depth < old || (depth == old && (owner < tile->owner[i]) == ZR_MUTANT(later_wins_ties, true, false))))
        return false;
    tile->depth[i] = depth;
    tile->owner[i] = owner;
    return true;
}

/* Adds the fragment to the tile's lists if it is in front of the opaque sample. */
static inline void zr_tile_list_at(struct zr_tile *tile, uint32_t i, float depth, uint32_t owner)
{
    if (depth < tile->depth[i]) zr_fragments_put(tile->fragments, i, depth, owner);
}

static inline void zr_tile_put(struct zr_tile *tile, int32_t x, int32_t y, float depth, uint32_t owner)
{
    const uint32_t place = (uint32_t)((y - tile->y) * ZR_TILE_STRIDE + x - tile->x);
    if (tile->fragments)
        zr_tile_list_at(tile, place, depth, owner);
    else
        zr_tile_put_at(tile, place, depth, owner);
}

/* Returns true if a box of pixels (min x, min y, max x, max y) overlaps the tile. */
static inline bool zr_tile_touches(const struct zr_tile *tile, const int32_t box[4])
{
    return box[0] < tile->x + tile->width && box[1] < tile->y + tile->height && box[2] >= tile->x && box[3] >= tile->y;
}

/* Sets the position and size of tile `number`. */
void zr_tile_place(struct zr_tile *tile, uint32_t number, uint32_t width, uint32_t height);

/* Clears a placed tile: no owners, and the depth that a visible fragment must be less than. This is 1, or the base's
 * depth; if the scene wins ties, the next float above the base's depth, but at most 1. `base` may be NULL. */
void zr_tile_begin(struct zr_tile *tile, const struct zr_base *base, uint32_t width, uint32_t height);

#endif
