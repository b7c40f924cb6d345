/* visibility.h - raster, the whole floor: triangles -> who is seen, sample by sample. */
#ifndef ZR_VISIBILITY_H
#define ZR_VISIBILITY_H

#include "raster/bins.h"

/* Places tile `number` of the bins in the window, begins it (`base` may be NULL) and draws into
 * it every triangle that touches it. Reentrant: one tile, one thread. False where it was
 * cancelled: the tile is then incomplete. */
bool zr_visibility_tile(const struct zr_geometry *geometry, const struct zr_bins *bins, uint32_t number, uint32_t width,
                        uint32_t height, const struct zr_base *base, const struct zr_cancel *cancel,
                        struct zr_tile *tile);

#endif
