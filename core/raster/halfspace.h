/* halfspace.h - raster: the kernel. One triangle into one tile.
 *
 * Half-space rasterization: a sample is inside where all three edge functions are
 * positive (Pineda, "A Parallel Algorithm for Polygon Rasterization", 1988). This file
 * alone holds the inner loops; a version for another instruction set replaces it
 * behind this function and must give the same bytes.
 */
#ifndef ZR_HALFSPACE_H
#define ZR_HALFSPACE_H

#include "raster/setup.h"
#include "raster/tile.h"

/* Where the triangle is nearer than tile->depth, writes its depth and `owner`. At
 * equal depth the earlier triangle stays. */
void zr_halfspace_draw(struct zr_tile *tile, const struct zr_setup *setup, uint32_t owner);

#endif
