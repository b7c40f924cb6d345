#include "raster/small.h"

zr_small_fn *zr_small_of(enum zr_isa isa)
{
    static zr_small_fn *const kernels[ZR_ISA_COUNT] = ZR_KERNELS(zr_small);
    return kernels[isa];
}
