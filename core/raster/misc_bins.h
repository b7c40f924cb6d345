/* misc_bins.h - raster: bins shapes, lines, points that were placed singly, and triangles with a depth offset into
 * tiles. bins.h handles all other triangles, and cloud_bins.h clouds.
 *
 * A primitive that touches at most ZR_MISC_BINS_TILES tiles is listed in each of them; a larger one goes into one list
 * that every tile processes. A line is listed in the tiles that it crosses, and a point in all tiles that it touches.
 * So the primitives, the lengths of lines and the pixels of points bound the memory. */
#ifndef ZR_MISC_BINS_H
#define ZR_MISC_BINS_H

#include "raster/tile.h"

#include "base/arena.h"
#include "base/run.h"
#include "geometry/geometry.h"

enum { ZR_MISC_BINS_TILES = 4 };

struct zr_misc_bins {
    uint32_t count;          /* of all primitives; if 0, nothing else is defined */
    const size_t *offsets;   /* into entries; one per tile (raster/tile.h) and one more */
    const uint32_t *entries; /* numbers of primitives (of a shape: its first triangle), ascending within a tile */
    const uint32_t *large;   /* numbers likewise, ascending */
    uint32_t large_count;
};

/* Bins the primitives whose material has the alpha mode `mode`, except those without a pixel centre. Returns ZR_OK,
 * ZR_CANCELLED, or ZR_NO_MEMORY if the arena failed. */
enum zr_status zr_misc_bins_build(const struct zr_run *run, const struct zr_geometry *geometry, enum zr_alpha_mode mode,
                                  uint32_t width, uint32_t height, struct zr_misc_bins *bins);

#endif
