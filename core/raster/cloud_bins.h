/* cloud_bins.h - raster: bins clouds of points (geometry/draw.h) into cells of the window, in one step from their
 * positions.
 *
 * Space:  window space, y up.
 * How:    threads take ranges of points, transform them block by block, and append a record of 12 bytes to each cell
 *         that a point touches, in lists of their own. A cell has at least the width of the points in it, so that a
 *         point touches four at most: tiles for points up to ZR_TILE_SIZE pixels, and squares of tiles for larger ones.
 *         The order within a list has no effect (tile.h: zr_tile_put). */
#ifndef ZR_CLOUD_BINS_H
#define ZR_CLOUD_BINS_H

#include <pthread.h>

#include "base/isa.h"
#include "base/run.h"
#include "geometry/geometry.h"
#include "raster/tile.h"

struct zr_cloud_record {
    uint32_t owner;
    float depth;
    int16_t x, y; /* lowest pixel of the point, from that of the cell */
};

/* Records of points of one size and shape. */
struct zr_cloud_block {
    struct zr_cloud_block *next;
    uint32_t used, room;
    int32_t width, cut; /* zr_point_width and zr_point_cut */
    struct zr_cloud_record records[];
};

/* Draws the points of a block to the samples of a tile: x, y is the lowest pixel of their cell. Returns the number of
 * their pixels in the tile. A kernel. */
typedef uint32_t zr_cloud_draw_fn(const struct zr_cloud_block *block, int32_t x, int32_t y, struct zr_tile *tile);

ZR_KERNEL_TABLE(zr_cloud_draw_fn, zr_cloud_draw)

/* Chain of blocks of one thread for one cell. */
struct zr_cloud_chain {
    struct zr_cloud_block *first, *last;
};

/* Output of one thread. */
struct zr_cloud_binner {
    _Alignas(64) struct zr_cloud_bins *bins; /* aligned, so that threads share no cache line */
    struct zr_cloud_chain *cells;
    char *free, *free_end; /* memory for blocks */
    bool failed;
    struct zr_counts counts;
};

/* Cells of one size. */
struct zr_cloud_grid {
    int shift;        /* they have 1 << shift pixels at each side; 0: no cloud needs them */
    uint32_t columns; /* cells in a row */
    size_t first;     /* number of the first cell */
};

enum { ZR_CLOUD_GRIDS = 4 };

struct zr_cloud_bins {
    struct zr_arena *arena;
    const struct zr_geometry *geometry;
    enum zr_alpha_mode mode; /* alpha mode of the binned clouds */
    struct zr_counts counts; /* of all their points */
    pthread_mutex_t arena_lock;
    uint32_t width, height;
    struct zr_cloud_grid grids[ZR_CLOUD_GRIDS];
    zr_cloud_draw_fn *draw;
    int worker_count; /* 0: there are no clouds */
    struct zr_cloud_binner *workers;
};

/* Bins the clouds whose material has the alpha mode `mode`. Returns ZR_OK, ZR_CANCELLED, or ZR_NO_MEMORY if the arena
 * failed. */
enum zr_status zr_cloud_bins_build(const struct zr_run *run, const struct zr_geometry *geometry,
                                   enum zr_alpha_mode mode, uint32_t width, uint32_t height,
                                   struct zr_cloud_bins *bins);

/* Returns true if points may touch tile `number`. */
bool zr_cloud_bins_any(const struct zr_cloud_bins *bins, uint32_t number);

/* Draws the points to the tile or to its lists. Returns false if cancelled. */
bool zr_cloud_bins_draw(const struct zr_cloud_bins *bins, uint32_t number, const struct zr_cancel *cancel,
                        struct zr_tile *tile);

#endif
