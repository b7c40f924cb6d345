/* small.h - raster: draws small triangles (bins.h) into one tile. A kernel: sets up one triangle per lane.
 *
 * Triangles within stamps (small_kernel.c) are drawn sample by sample, others one after the other, row by row. If the
 * tile keeps words, a visible sample gets one if its draw has some (prepaint.h) and the triangle is in a stamp;
 * otherwise its word becomes 0. */
#ifndef ZR_SMALL_H
#define ZR_SMALL_H

#include "base/isa.h"
#include "geometry/geometry.h"
#include "raster/prepaint.h"
#include "raster/tile.h"

/* Writes depths and owners to the samples where the triangles, given by number, are visible (zr_tile_put). If the tile
 * has lists (zr_tile.fragments), adds fragments to them instead. All of the tile must be written (zr_halfspace.flush).
 * prepaints: one per draw, or NULL. */
typedef void zr_small_fn(struct zr_tile *tile, const struct zr_geometry *geometry, const struct zr_prepaint *prepaints,
                         const uint32_t *numbers, uint32_t count);

ZR_KERNEL_TABLE(zr_small_fn, zr_small)

#endif
