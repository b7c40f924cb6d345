/* oddeven.h - raster: draws polygons of any shape into one tile, by the odd-even rule.
 *
 * Each edge flips the samples to its right in the rows that it crosses; samples flipped an odd number of times are
 * inside (Ackland & Weste, "The Edge Flag Algorithm", 1981). A tile is 64 samples wide, so a row of flags is one word.
 * Holes, crossings, repeated corners and rings that go round twice need no special treatment. */
#ifndef ZR_ODDEVEN_H
#define ZR_ODDEVEN_H

#include "raster/primitive.h"
#include "raster/tile.h"

/* Writes depth and owner to the samples where the primitive is visible (zr_tile_put). */
void zr_oddeven_draw(const struct zr_geometry *geometry, const struct zr_primitive *primitive, struct zr_tile *tile);

#endif
