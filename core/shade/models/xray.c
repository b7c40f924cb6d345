#include "shade/models/xray.h"

zr_xray_fn *zr_xray_of(enum zr_isa isa)
{
    static zr_xray_fn *const table[ZR_ISA_COUNT] = ZR_KERNELS(zr_xray);
    return table[isa];
}
