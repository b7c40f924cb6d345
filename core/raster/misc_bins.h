/* misc_bins.h - raster: which shapes, lines, points and triangles with a depth offset each tile has to look at. All
 * other triangles are in bins (bins.h).
 *
 * A primitive that touches up to ZR_MISC_BINS_TILES tiles is listed in each of them; a
 * larger one goes into one list that every tile goes through. A line is listed in the
 * tiles that it passes through, and a point in all that it touches. So memory is bounded by the primitives, by the
 * length of lines, and by the pixels of points.
 */
#ifndef ZR_MISC_BINS_H
#define ZR_MISC_BINS_H

#include "raster/tile.h"

#include "base/arena.h"
#include "geometry/geometry.h"

enum { ZR_MISC_BINS_TILES = 4 };

struct zr_misc_bins {
    uint32_t count;          /* of all; where 0, nothing else is defined */
    const size_t *offsets;   /* one a tile (raster/tile.h) and one more, into entries */
    const uint32_t *entries; /* primitives, by their first numbers: ascending within a tile */
    const uint32_t *large;   /* ascending */
    uint32_t large_count;
};

/* Of primitives of such materials. Such that hold no pixel centre are in none. ZR_OK,
 * ZR_CANCELLED, or ZR_NO_MEMORY where the arena failed. */
enum zr_status zr_misc_bins_build(struct zr_arena *arena, const struct zr_geometry *geometry, enum zr_alpha_mode mode,
                                  uint32_t width, uint32_t height, const struct zr_cancel *cancel,
                                  struct zr_misc_bins *others);

#endif
