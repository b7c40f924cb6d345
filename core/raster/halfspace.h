/* halfspace.h - raster: the kernel. Triangles into one tile.
 *
 * Half-space rasterization: a sample is inside where all three edge functions are
 * positive (Pineda, "A Parallel Algorithm for Polygon Rasterization", 1988). Small and
 * tiny triangles have kernels of their own: small_kernel.c, bins_kernel.c.
 */
#ifndef ZR_HALFSPACE_H
#define ZR_HALFSPACE_H

#include "base/isa.h"
#include "raster/setup.h"
#include "raster/tile.h"

struct zr_halfspace {
    /* A placed tile without owners, depth 1: nothing is written yet (zr_tile.unwritten). */
    void (*begin)(struct zr_tile *tile);

    /* Where the triangle, of any size, is seen (zr_tile_put), makes the depth its own, and the owner `owner`. A block
     * that it covers whole, before anything else is drawn there, is not written, but told of in block_owner. */
    void (*draw)(struct zr_tile *tile, const struct zr_setup *setup, uint32_t owner);

    /* Puts it into the tile's lists (zr_tile.fragments) wherever it is in front of what is seen; all of the tile is
     * written. */
    void (*list)(struct zr_tile *tile, const struct zr_setup *setup, uint32_t owner);

    /* Writes what is not written yet, of any tile. */
    void (*flush)(struct zr_tile *tile);
};

const struct zr_halfspace *zr_halfspace_of(enum zr_isa isa);

extern const struct zr_halfspace zr_halfspace_scalar, zr_halfspace_sse2, zr_halfspace_avx2, zr_halfspace_avx512,
    zr_halfspace_neon;

/* The least and the greatest that a plane's depth has at samples x0..x1, y0..y1: no bounds, but values that it has
 * at corners, since rounding is monotone. NaN where some are. */
struct zr_depth_range {
    float near, far;
};

static inline struct zr_depth_range zr_depth_range_of(const struct zr_depth *depth, int32_t x0, int32_t y0, int32_t x1,
                                                      int32_t y1)
{
    bool right = depth->plane.dadx > 0.0f, up = depth->plane.dady > 0.0f;
    return (struct zr_depth_range){zr_depth_at(depth, right ? x0 : x1, up ? y0 : y1),
                                   zr_depth_at(depth, right ? x1 : x0, up ? y1 : y0)};
}

#endif
