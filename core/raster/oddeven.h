/* oddeven.h - raster: polygons of any shape into one tile, by the odd-even rule.
 *
 * Each edge flips the samples on its right in the rows that it passes; what is left flipped
 * when all edges are through is inside (Ackland & Weste, "The Edge Flag Algorithm", 1981). A tile is
 * 64 samples wide, so a row of flags is one word. No geometry can go wrong: holes,
 * crossings, repeated corners and rings that go round twice are all the same to it.
 */
#ifndef ZR_ODDEVEN_H
#define ZR_ODDEVEN_H

#include "raster/primitive.h"
#include "raster/tile.h"

/* Where the primitive covers a sample and is seen (zr_tile_put), writes its depth and owner. */
void zr_oddeven_draw(const struct zr_geometry *geometry, const struct zr_primitive *primitive, struct zr_tile *tile);

#endif
