/* bins.h - raster: which primitives each tile has to look at, in order.
 *
 * A primitive that touches up to ZR_BIN_TILES tiles is listed in each of them; a
 * larger one goes into one list that every tile goes through. So memory is bounded
 * by the primitives, whatever their size.
 */
#ifndef ZR_BINS_H
#define ZR_BINS_H

#include "raster/tile.h"

#include "base/arena.h"
#include "geometry/geometry.h"

enum { ZR_BIN_TILES = 4 };
_Static_assert(ZR_GEOMETRY_MAX <= UINT32_MAX / ZR_BIN_TILES, "offsets fit 32 bits");

struct zr_bins {
    uint32_t columns, rows;  /* tiles; tile 0 is at the lower left, then along the row */
    const uint32_t *offsets; /* columns * rows + 1, into entries */
    const uint32_t *entries; /* first records of primitives, ascending within a tile */
    const uint32_t *large;   /* ascending */
    uint32_t large_count;
};

/* Primitives that hold no pixel centre are in none. ZR_NO_MEMORY where the arena failed. */
enum zr_status zr_bins_build(struct zr_arena *arena, const struct zr_geometry *geometry, uint32_t width,
                             uint32_t height, struct zr_bins *bins);

#endif
