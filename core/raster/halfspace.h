/* halfspace.h - raster: draws triangles into one tile. A kernel.
 *
 * Half-space rasterization: a sample is covered if all three edge functions are positive (Pineda, "A Parallel Algorithm
 * for Polygon Rasterization", 1988). Small and tiny triangles have kernels of their own: small_kernel.c,
 * bins_kernel.c. */
#ifndef ZR_HALFSPACE_H
#define ZR_HALFSPACE_H

#include "base/isa.h"
#include "raster/setup.h"
#include "raster/tile.h"

struct zr_halfspace {
    /* Clears a placed tile: no owners, depth 1. Nothing is written yet (zr_tile.unwritten). */
    void (*begin)(struct zr_tile *tile);

    /* Draws a triangle of any size: writes its depth and `owner` to the samples where it is visible (zr_tile_put). A
     * block that it covers entirely, before anything else is drawn there, is recorded in block_owner and not
     * written. */
    void (*draw)(struct zr_tile *tile, const struct zr_setup *setup, uint32_t owner);

    /* Adds the triangle's fragments in front of the opaque samples to the tile's lists (zr_tile.fragments). All of the
     * tile must be written. */
    void (*list)(struct zr_tile *tile, const struct zr_setup *setup, uint32_t owner);

    /* Writes all unwritten blocks of a tile. */
    void (*flush)(struct zr_tile *tile);
};

ZR_KERNEL_TABLE(const struct zr_halfspace, zr_halfspace)

/* Least and greatest depth of a plane at samples x0..x1, y0..y1. Both are values at corners, since rounding is
 * monotone. NaN if some corner is. */
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
