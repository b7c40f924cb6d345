/* bins.h - raster: bins the plain triangles of the draws into tiles.
 *
 * Space:  window space, y up; boxes are of pixel centres.
 * How:    threads take ranges of the draws and bin triangles into lists of their own, so none waits for another; the
 *         order within a list has no effect (tile.h: zr_tile_put). Triangles that are culled, have no area, or contain
 *         no pixel centre are dropped here, many at once.
 *   - Tiny triangles, of at most 2x2 pixel centres, are rasterized at once (tiny_simd.h), into fragments:
 *     8 bytes each, and 4 for a word if a draw has some (prepaint.h).
 *   - Small triangles, of up to 64 pixels, are listed by number in each tile that they touch: 4 bytes each.
 *   - Wide triangles are set up once. Those that touch few tiles are listed there; large ones are listed once,
 *     and every tile processes them. */
#ifndef ZR_BINS_H
#define ZR_BINS_H

#include <pthread.h>

#include "base/isa.h"
#include "base/run.h"
#include "geometry/geometry.h"
#include "raster/prepaint.h"
#include "raster/setup.h"
#include "raster/tile.h"

enum {
    ZR_BIN_VECTOR = 16,            /* maximum number of lanes */
    ZR_BIN_NUMBERS_PER_BLOCK = 60, /* fills a block of 256 bytes */
    ZR_BIN_WIDE_PER_BLOCK = 6,     /* fills a block of 64 bytes */
    ZR_BIN_FRAGMENTS_PER_BLOCK = 112,
    ZR_BIN_FRAGMENTS_ROOM = ZR_BIN_FRAGMENTS_PER_BLOCK + ZR_BIN_VECTOR, /* the last vector is stored whole */
    ZR_BIN_OWNER_BITS = 19,
    ZR_BIN_TILES = 16,           /* maximum number of tiles in which a wide triangle is listed */
    ZR_BIN_SMALL_SPAN = 64 * 256 /* on the snapped grid: edge functions then fit 32 bits, with room to spare */
};

/* A list is a chain of blocks; the data after a block's head depend on the kind of list. */
struct zr_bin_head {
    struct zr_bin_head *next;
    uint32_t used;
};

struct zr_bin {
    struct zr_bin_head *first, *last;
    uint32_t block_count;
};

/* Small triangles, by number. */
struct zr_bin_numbers {
    struct zr_bin_head head;
    uint32_t numbers[ZR_BIN_NUMBERS_PER_BLOCK];
};

struct zr_wide {
    struct zr_setup setup;
    uint32_t owner;
};

struct zr_bin_wides {
    struct zr_bin_head head;
    const struct zr_wide *items[ZR_BIN_WIDE_PER_BLOCK];
};

/* Fragments of tiny triangles, with depths below 1. */
struct zr_bin_fragments {
    struct zr_bin_head head;
    uint32_t first_owner;
    uint32_t places[ZR_BIN_FRAGMENTS_ROOM]; /* index in zr_tile.depth << ZR_BIN_OWNER_BITS | owner - first_owner */
    float depths[ZR_BIN_FRAGMENTS_ROOM];
    uint32_t words[ZR_BIN_FRAGMENTS_ROOM]; /* as zr_tile.early_color; allocated only if zr_bins.has_words */
};
_Static_assert(1 << (32 - ZR_BIN_OWNER_BITS) >= ZR_TILE_SIZE * ZR_TILE_STRIDE, "a pixel and an owner fit a word");

/* Lists of one thread for one tile. */
struct zr_tile_bins {
    struct zr_bin small, wide, fragments;
};

/* Output of one thread. */
struct zr_binner {
    _Alignas(64) struct zr_bins *bins; /* aligned, so that threads share no cache line */
    struct zr_tile_bins *tiles;
    struct zr_bin large;   /* zr_wide */
    char *free, *free_end; /* memory for blocks */
    bool failed;
    struct zr_counts counts;
};

struct zr_bins {
    struct zr_arena *arena;
    const struct zr_geometry *geometry;
    enum zr_alpha_mode mode;             /* alpha mode of the binned draws */
    const struct zr_prepaint *prepaints; /* one per draw, or NULL */
    struct zr_counts counts;             /* of draws that are not `counted` */
    pthread_mutex_t arena_lock;
    uint32_t width, height, columns;
    bool has_words;        /* some draw has early colours: fragments have them, and tiles may keep some */
    size_t fragments_size; /* bytes of a block of fragments */
    int worker_count;
    struct zr_binner *workers;
    uint32_t large_count;
    const struct zr_wide **large;
};

/* Bins the plain draws whose material has the alpha mode `mode`. Returns ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_bins_build(const struct zr_run *run, const struct zr_geometry *geometry, enum zr_alpha_mode mode,
                             const struct zr_prepaint *prepaints, uint32_t width, uint32_t height,
                             struct zr_bins *bins);

/* ---- for the kernel ---- */

/* Bins triangles begin .. end - 1 of a plain draw, relative to its first. `begin` must be a multiple of 32, and end -
 * begin less than 1 << ZR_BIN_OWNER_BITS. Records which triangles show their backs, if zr_prepaint.backs is set. */
typedef void zr_binning_fn(struct zr_binner *binner, const struct zr_draw *draw, uint32_t begin, uint32_t end);

ZR_KERNEL_TABLE(zr_binning_fn, zr_binning)

/* Bins a triangle that is not small, with 64-bit edge functions. */
void zr_binner_add_spanning(struct zr_binner *binner, const struct zr_draw *draw, uint32_t number);

/* Counts a triangle without area, or a degenerate polygon. */
void zr_binner_add_flat(struct zr_binner *binner, const struct zr_draw *draw, uint32_t number);

/* Returns the draw's prepaint, or NULL. */
static inline const struct zr_prepaint *zr_binner_prepaint(const struct zr_binner *binner, const struct zr_draw *draw)
{
    const struct zr_bins *bins = binner->bins;
    return bins->prepaints ? &bins->prepaints[draw - bins->geometry->draws] : NULL;
}

/* Appends a block of `size` bytes to the list. If memory runs out, returns NULL and marks the binner as failed. */
struct zr_bin_head *zr_binner_block(struct zr_binner *binner, struct zr_bin *bin, size_t size);

/* Returns the last block if at most `most` of it is used, else a new one. */
static inline struct zr_bin_head *zr_binner_room(struct zr_binner *binner, struct zr_bin *bin, uint32_t most,
                                                 size_t size)
{
    struct zr_bin_head *last = bin->last;
    return __builtin_expect(last && last->used <= most, 1) ? last : zr_binner_block(binner, bin, size);
}

/* Returns a block with room for one number, or NULL. */
static inline struct zr_bin_numbers *zr_binner_numbers(struct zr_binner *binner, struct zr_bin *bin)
{
    return (struct zr_bin_numbers *)zr_binner_room(binner, bin, ZR_BIN_NUMBERS_PER_BLOCK - 1,
                                                   sizeof(struct zr_bin_numbers));
}

/* Returns a block with room for ZR_BIN_VECTOR fragments of owners first .. last, or NULL; last - first must be less
 * than 1 << ZR_BIN_OWNER_BITS. */
static inline struct zr_bin_fragments *zr_binner_fragments(struct zr_binner *binner, struct zr_bin *bin, uint32_t first,
                                                           uint32_t last)
{
    struct zr_bin_fragments *block = (struct zr_bin_fragments *)bin->last;
    if (__builtin_expect(block && block->head.used <= ZR_BIN_FRAGMENTS_PER_BLOCK && first >= block->first_owner &&
                             last - block->first_owner < 1u << ZR_BIN_OWNER_BITS,
                         1))
        return block;
    block = (struct zr_bin_fragments *)zr_binner_block(binner, bin, binner->bins->fragments_size);
    if (block) block->first_owner = first;
    return block;
}

#endif
