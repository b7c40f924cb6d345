/* bins.h - raster: which triangles each tile has to look at.
 *
 * Space:  window space, y up; boxes are of pixel centres.
 * How:    threads go through the draws and sort triangles into tiles, each into lists of its own, so none
 *         waits for another; the order in a list means nothing (tile.h: zr_tile_put). What shows
 *         its back and must not, has no area, or holds no pixel centre is dropped here, many at once.
 *         - Tiny ones, of 2x2 pixel centres at most, are drawn then and there (tiny_simd.h), into fragments: 8 bytes
 *           each, and 4 for a word where a draw has some (prepaint.h).
 *         - Small ones, of up to 64 pixels, are listed by their number in the tiles that they touch: 4 bytes each.
 *         - Wide ones are set up once. Those that touch few tiles are listed there; large ones are not, and every tile
 *           goes through them.
 */
#ifndef ZR_BINS_H
#define ZR_BINS_H

#include <pthread.h>

#include "base/isa.h"
#include "geometry/geometry.h"
#include "raster/prepaint.h"
#include "raster/setup.h"
#include "raster/tile.h"

enum {
    ZR_BIN_VECTOR = 16,          /* lanes at most */
    ZR_BIN_NUMBERS_A_BLOCK = 60, /* for blocks of 256 bytes */
    ZR_BIN_WIDE_A_BLOCK = 6,     /* of 64 bytes */
    ZR_BIN_FRAGMENTS_A_BLOCK = 112,
    ZR_BIN_FRAGMENTS_ROOM = ZR_BIN_FRAGMENTS_A_BLOCK + ZR_BIN_VECTOR, /* the last vector is stored whole */
    ZR_BIN_OWNER_BITS = 19,
    ZR_BIN_TILES = 16,           /* that a wide triangle is listed in at most */
    ZR_BIN_SMALL_SPAN = 64 * 256 /* on the snapped grid: edge functions then fit 32 bits, with room to spare */
};

/* A list is a chain of blocks; what follows the head of each tells the kind of list. */
struct zr_bin_head {
    struct zr_bin_head *next;
    uint32_t used;
};

struct zr_bin {
    struct zr_bin_head *first, *last;
    uint32_t block_count;
};

/* Small triangles, by their numbers. */
struct zr_bin_numbers {
    struct zr_bin_head head;
    uint32_t numbers[ZR_BIN_NUMBERS_A_BLOCK];
};

struct zr_wide {
    struct zr_setup setup;
    uint32_t owner;
};

struct zr_bin_wides {
    struct zr_bin_head head;
    const struct zr_wide *items[ZR_BIN_WIDE_A_BLOCK];
};

/* Samples of tiny triangles. Their depth is less than 1. */
struct zr_bin_fragments {
    struct zr_bin_head head;
    uint32_t first_owner;
    uint32_t places[ZR_BIN_FRAGMENTS_ROOM]; /* pixel in zr_tile.depth << ZR_BIN_OWNER_BITS | owner - first_owner */
    float depths[ZR_BIN_FRAGMENTS_ROOM];
    uint32_t words[ZR_BIN_FRAGMENTS_ROOM]; /* as zr_tile.words; only where zr_bins.has_words */
};
_Static_assert(1 << (32 - ZR_BIN_OWNER_BITS) >= ZR_TILE_SIZE * ZR_TILE_STRIDE, "a pixel and an owner fit a word");

/* What one thread has for one tile. */
struct zr_tile_bins {
    struct zr_bin small, wide, fragments;
};

/* What one thread sorts into. */
struct zr_binner {
    _Alignas(64) struct zr_bins *bins; /* no two threads' on one line of the cache */
    struct zr_tile_bins *tiles;
    struct zr_bin large;   /* wides */
    char *free, *free_end; /* room for blocks */
    bool failed;
    struct zr_counts counts;
};

struct zr_bins {
    struct zr_arena *arena;
    const struct zr_geometry *geometry;
    enum zr_alpha_mode mode;            /* of what is sorted */
    const struct zr_prepaint *payloads; /* one a draw, or NULL */
    struct zr_counts counts;            /* of draws that are not `counted` */
    pthread_mutex_t arena_lock;
    uint32_t width, height, columns;
    bool has_words;        /* some draw has words: fragments have them, and tiles may keep some */
    size_t fragments_size; /* of a block */
    int worker_count;
    struct zr_binner *workers;
    uint32_t large_count;
    const struct zr_wide **large;
};

/* Of draws of such materials. ZR_OK, ZR_CANCELLED or ZR_NO_MEMORY. */
enum zr_status zr_bins_build(struct zr_arena *arena, struct zr_team *team, const struct zr_geometry *geometry,
                             enum zr_alpha_mode mode, const struct zr_prepaint *payloads, uint32_t width,
                             uint32_t height, const struct zr_cancel *cancel, struct zr_bins *bins);

/* ---- for the kernel ---- */

/* Sorts the triangles begin .. end - 1 of a plain draw, counted from its first: begin is a multiple of 32, end - begin
 * less than 1 << ZR_BIN_OWNER_BITS. Notes which show their backs, where somebody asks (zr_prepaint.backs). */
typedef void zr_binning_fn(struct zr_binner *binner, const struct zr_draw *draw, uint32_t begin, uint32_t end);

zr_binning_fn zr_binning_scalar, zr_binning_sse2, zr_binning_avx2, zr_binning_avx512, zr_binning_neon;

/* One that is not small, in 64 bits. */
void zr_binner_add_spanning(struct zr_binner *binner, const struct zr_draw *draw, uint32_t number);

/* One without area, which may be no triangle at all. */
void zr_binner_add_flat(struct zr_binner *binner, const struct zr_draw *draw, uint32_t number);

/* Of a draw; NULL: none. */
static inline const struct zr_prepaint *zr_binner_payload(const struct zr_binner *binner, const struct zr_draw *draw)
{
    const struct zr_bins *bins = binner->bins;
    return bins->payloads ? &bins->payloads[draw - bins->geometry->draws] : NULL;
}

/* A new last block of so many bytes; NULL, and the binner has failed, where there is no memory. */
struct zr_bin_head *zr_binner_block(struct zr_binner *binner, struct zr_bin *bin, size_t size);

/* The last block where no more than `most` of it is used, else a new one. */
static inline struct zr_bin_head *zr_binner_room(struct zr_binner *binner, struct zr_bin *bin, uint32_t most,
                                                 size_t size)
{
    struct zr_bin_head *last = bin->last;
    return __builtin_expect(last && last->used <= most, 1) ? last : zr_binner_block(binner, bin, size);
}

/* Room for one number, or NULL. */
static inline struct zr_bin_numbers *zr_binner_numbers(struct zr_binner *binner, struct zr_bin *bin)
{
    return (struct zr_bin_numbers *)zr_binner_room(binner, bin, ZR_BIN_NUMBERS_A_BLOCK - 1,
                                                   sizeof(struct zr_bin_numbers));
}

/* Room for ZR_BIN_VECTOR of owners first .. last, or NULL; last - first is less than 1 << ZR_BIN_OWNER_BITS. */
static inline struct zr_bin_fragments *zr_binner_fragments(struct zr_binner *binner, struct zr_bin *bin, uint32_t first,
                                                           uint32_t last)
{
    struct zr_bin_fragments *block = (struct zr_bin_fragments *)bin->last;
    if (__builtin_expect(block && block->head.used <= ZR_BIN_FRAGMENTS_A_BLOCK && first >= block->first_owner &&
                             last - block->first_owner < 1u << ZR_BIN_OWNER_BITS,
                         1))
        return block;
    block = (struct zr_bin_fragments *)zr_binner_block(binner, bin, binner->bins->fragments_size);
    if (block) block->first_owner = first;
    return block;
}

#endif
