#include "raster/halfspace.h"

const struct zr_halfspace *zr_halfspace_of(enum zr_isa isa)
{
    static const struct zr_halfspace *const table[ZR_ISA_COUNT] = ZR_KERNELS(&zr_halfspace);
    return table[isa];
}
