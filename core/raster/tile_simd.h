/* tile_simd.h - raster: the z-buffer, ZR_LANES samples at once, for kernels. */
#ifndef ZR_TILE_SIMD_H
#define ZR_TILE_SIMD_H

#include "base/simd.h"

/* Where lanes are seen, by zr_tile_put's rule, they are written: always at a multiple of ZR_LANES, and all lanes of
 * depths, since what one triangle has stored the next one loads, and a load waits long for a store that is not the same
 * whole vector (a third of the bunny's time). Owners are loaded where depths are the same only, which is seldom (4 % of
 * the bunny). Returns the depths that are there now. */
static inline zr_vf zr_tile_put_v(float *depth, uint32_t *owners, zr_vm inside, zr_vf z, zr_vi owner)
{
    const zr_vf old = zr_vf_load(depth);
    const zr_vm ties = zr_vf_eq_where(inside, z, old);
    zr_vm seen = zr_vf_lt_where(inside, z, old);
    if (__builtin_expect(zr_vm_any(ties), 0)) seen = zr_vm_or(seen, zr_vi_lt_where(ties, owner, zr_vi_load(owners)));
    const zr_vf nearest = zr_vf_select(seen, z, old);
    zr_vf_store(depth, nearest);
    zr_vi_store_where(owners, seen, owner);
    return nearest;
}

#endif
