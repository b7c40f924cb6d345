#include "geometry/transform.h"

zr_transform_fn *zr_transform_of(enum zr_isa isa)
{
    static zr_transform_fn *const table[ZR_ISA_COUNT] = ZR_KERNELS(zr_transform);
    return table[isa];
}
