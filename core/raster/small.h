/* small.h - raster: small triangles (bins.h) into one tile. A kernel: as many are set up at once as there are lanes.
 * Those in stamps (stamp_simd.h) are then drawn sample by sample, others one after the other, row by row. Where the
 * tile keeps words, what is seen gets one if its draw has some (prepaint.h) and it is in a stamp, and loses it else. */
#ifndef ZR_SMALL_H
#define ZR_SMALL_H

#include "base/isa.h"
#include "geometry/geometry.h"
#include "raster/prepaint.h"
#include "raster/tile.h"

/* Where the triangles, given by their numbers, are seen (zr_tile_put), writes depths and owners, or puts them into the
 * tile's lists, where it has some (zr_tile.fragments). All of the tile must be written (zr_halfspace.flush). payloads:
 * one a draw, or NULL. */
typedef void zr_small_fn(struct zr_tile *tile, const struct zr_geometry *geometry, const struct zr_prepaint *payloads,
                         const uint32_t *numbers, uint32_t count);

zr_small_fn zr_small_scalar, zr_small_sse2, zr_small_avx2, zr_small_avx512, zr_small_neon;

zr_small_fn *zr_small_of(enum zr_isa isa);

#endif
