/* algorithms.c - raster: the algorithms by name. */
#include "raster/visibility.h"

zr_visibility_fn *zr_visibility_of(enum zr_algorithm algorithm)
{
    static zr_visibility_fn *const table[ZR_ALGORITHM_COUNT] = {
        [ZR_ALGORITHM_HALFSPACE] = NULL,
    };
    return table[algorithm];
}
