/* tile.h - raster: what one thread works on: a square of the window.
 *
 * Space:  window space, y up; row 0 of a tile is its lowest.
 * Why:    depth and owner of 64x64 samples stay in the first-level cache until the
 *         tile is resolved to channels, and no other thread ever sees them.
 */
#ifndef ZR_TILE_H
#define ZR_TILE_H

#include <stddef.h>
#include <stdint.h>

#include "raster/depth.h"
#include "raster/fragments.h"
#include "scene/scene.h"

/* A row has room behind it, so that vectors may look beyond its end, and so that rows do not fall on
 * each other's cache lines. */
enum { ZR_TILE_SIZE = 64, ZR_TILE_STRIDE = ZR_TILE_SIZE + 16 };

/* Blocks of a tile, each with a bound of its depths, so that what is hidden need not be tried sample by sample. */
enum {
    ZR_BLOCK_WIDTH = 16,
    ZR_BLOCK_HEIGHT = 8,
    ZR_BLOCK_COLUMNS = ZR_TILE_SIZE / ZR_BLOCK_WIDTH,
    ZR_BLOCKS = ZR_BLOCK_COLUMNS * (ZR_TILE_SIZE / ZR_BLOCK_HEIGHT)
};

/* In block_owner, above all owners: several large triangles may be seen in the block, or one and nothing. */
enum { ZR_BLOCK_SHARED = INT32_MAX };

struct zr_tile {
    int32_t x, y;                   /* lowest pixel */
    int32_t width, height;          /* smaller at the window's upper and right border */
    bool is_empty;                  /* nothing is drawn, and nothing below is defined */
    struct zr_fragments *fragments; /* what is put goes into these lists instead, where it is in front; else NULL */
    float far;                      /* no sample is deeper */
    /* [row of blocks * ZR_BLOCK_COLUMNS + column]: no sample of the block is deeper. 0 where the window ends before it.
     */
    float block_far[ZR_BLOCKS];
    bool knows_owners;               /* of all blocks, which are whole; else block_owner means nothing */
    uint32_t block_owner[ZR_BLOCKS]; /* of all its samples; 0: nobody; or ZR_BLOCK_SHARED */
    /* A bit each: blocks whose samples are not written, since all of them are the owner's, on the plane of block_depth,
     * or nobody's at depth 1. They may never need to be: a frame can be written without (a sixth of the time of a cube,
     * and of large triangles). */
    uint32_t unwritten;
    struct zr_depth block_depth[ZR_BLOCKS]; /* where an owner's samples are not written */
    /* [row * ZR_TILE_STRIDE + column] */
    _Alignas(
        64) float depth[ZR_TILE_STRIDE * ZR_TILE_SIZE]; /* window depth; where nothing was drawn, see zr_tile_begin */
    uint8_t apart[2048]; /* else a load of a depth would seem to want the owner that was stored 5 pages behind it */
    _Alignas(64) uint32_t owner[ZR_TILE_STRIDE * ZR_TILE_SIZE]; /* 1 + number of the primitive, 0 where nothing is */
    bool has_words;                                             /* else they mean nothing */
    _Alignas(64) uint32_t words[ZR_TILE_STRIDE * ZR_TILE_SIZE]; /* of payloads (prepaint.h); 0: to be found */
};

_Static_assert(ZR_BLOCKS == 32, "a bit each");

/* Blocks of which any part lies in the window, a bit each. */
static inline uint32_t zr_tile_blocks(const struct zr_tile *tile)
{
    const int32_t columns = (tile->width + ZR_BLOCK_WIDTH - 1) / ZR_BLOCK_WIDTH;
    const int32_t rows = (tile->height + ZR_BLOCK_HEIGHT - 1) / ZR_BLOCK_HEIGHT;
    const uint32_t first_of_rows = UINT32_C(0x11111111) >> (ZR_BLOCKS - ZR_BLOCK_COLUMNS * rows);
    return first_of_rows * ((1u << columns) - 1);
}
_Static_assert(ZR_BLOCK_COLUMNS == 4, "a row of blocks is a hexadecimal digit");

/* Whether none is cut by the window's end. */
static inline bool zr_tile_has_whole_blocks(const struct zr_tile *tile)
{
    return tile->width % ZR_BLOCK_WIDTH == 0 && tile->height % ZR_BLOCK_HEIGHT == 0;
}

/* Tiles that it takes for so many pixels in a row or a column. */
static inline uint32_t zr_tile_across(uint32_t pixels)
{
    return (pixels + ZR_TILE_SIZE - 1) / ZR_TILE_SIZE;
}

/* Tile 0 is at the window's lower left, then along the row. */
static inline size_t zr_tile_count(uint32_t width, uint32_t height)
{
    return (size_t)zr_tile_across(width) * zr_tile_across(height);
}

/* The z-buffer: what is drawn at pixel x, y of the tile is seen where it is nearer than what is there, or as near and
 * earlier in the scene. That is what drawing in order and keeping the nearest gives (GL's LESS), so primitives may
 * come in any order, from any thread, and the same one is seen. What was there before any of them stays at equal depth.
 */
static inline bool zr_tile_put_at(struct zr_tile *tile, uint32_t i, float depth, uint32_t owner)
{
    const float old = tile->depth[i];
    if (!(depth < old || (depth == old && (owner < tile->owner[i]) == ZR_MUTANT(later_wins_ties, true, false))))
        return false;
    tile->depth[i] = depth;
    tile->owner[i] = owner;
    return true;
}

/* Puts into the tile's lists what is in front of all that is seen there. */
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

/* Whether a box of pixels (min x, min y, max x, max y) has one of the tile's. */
static inline bool zr_tile_touches(const struct zr_tile *tile, const int32_t box[4])
{
    return box[0] < tile->x + tile->width && box[1] < tile->y + tile->height && box[2] >= tile->x && box[3] >= tile->y;
}

/* Puts tile `number` where it belongs in the window. */
void zr_tile_place(struct zr_tile *tile, uint32_t number, uint32_t width, uint32_t height);

/* What a placed tile holds before anything is drawn: no owner, and the depth that a
 * fragment must be less than to be seen. That is 1, or the base's depth there; the next
 * float above it, but no more than 1, where the scene wins ties. `base` may be NULL. */
void zr_tile_begin(struct zr_tile *tile, const struct zr_base *base, uint32_t width, uint32_t height);

#endif
