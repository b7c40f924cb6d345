/* sample_pairs.h - effects: pairs of neighbouring samples of a tile, a bit each: sample x of a row and the one to its
 * right, or above. */
#ifndef ZR_SAMPLE_PAIRS_H
#define ZR_SAMPLE_PAIRS_H

#include <stdint.h>

#include "raster/tile.h"

struct zr_sample_pairs {
    uint64_t along[ZR_TILE_SIZE], upwards[ZR_TILE_SIZE]; /* bit x of row y */
};

#endif
