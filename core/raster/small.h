/* small.h - raster: small triangles (bins.h) into one tile. A kernel: as many are set up at once as there are lanes,
 * and then drawn one after the other, row by row. What those cover that lie in a stamp (stamp_simd.h) is found at
 * once, too; where the tile has colours and they are to be painted early (shade/paint.h), they get theirs: what else is
 * drawn loses them. */
#ifndef ZR_SMALL_H
#define ZR_SMALL_H

#include "base/isa.h"
#include "geometry/geometry.h"
#include "raster/tile.h"

/* Where the triangles, given by their numbers, are seen (zr_tile_put), writes depths and owners. All of the tile
 * must be written (zr_halfspace.settle). */
typedef void zr_small_fn(struct zr_tile *tile, const struct zr_geometry *geometry, const uint32_t *numbers,
                         uint32_t count);

zr_small_fn zr_small_scalar, zr_small_sse2, zr_small_avx2, zr_small_avx512, zr_small_neon;

zr_small_fn *zr_small_of(enum zr_isa isa);

#endif
