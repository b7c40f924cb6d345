#include "base/srgb.h"

zr_srgb_ramp_fn *zr_srgb_ramp_of(enum zr_isa isa)
{
    static zr_srgb_ramp_fn *const table[ZR_ISA_COUNT] = ZR_KERNELS(zr_srgb_ramp);
    return table[isa];
}
