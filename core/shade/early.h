/* early.h - shade: colours of smooth triangles for those who draw them (zr_prepaint_fn), while corners are at hand. A
 * kernel.
 */
#ifndef ZR_EARLY_H
#define ZR_EARLY_H

#include "base/isa.h"
#include "raster/prepaint.h"

zr_prepaint_fn zr_early_scalar, zr_early_sse2, zr_early_avx2, zr_early_avx512, zr_early_neon;

static inline zr_prepaint_fn *zr_early_of(enum zr_isa isa)
{
    static zr_prepaint_fn *const table[ZR_ISA_COUNT] = ZR_KERNELS(zr_early);
    return table[isa];
}

#endif
