/* vector_masks.h - base: what follows in base/simd.h where a truth is all bits of a lane, or none: where zr_vm is a
 * vector. Included when the rest of an instruction set is there.
 */
#ifndef ZR_SIMD_VECTOR_MASKS_H
#define ZR_SIMD_VECTOR_MASKS_H

static inline zr_vm zr_vm_and(zr_vm a, zr_vm b)
{
    return a & b;
}
static inline zr_vm zr_vm_or(zr_vm a, zr_vm b)
{
    return a | b;
}
static inline zr_vm zr_vm_andnot(zr_vm a, zr_vm b)
{
    return a & ~b;
}
static inline zr_vm zr_vf_lt_where(zr_vm m, zr_vf a, zr_vf b)
{
    return m & zr_vf_lt(a, b);
}
static inline zr_vm zr_vf_eq_where(zr_vm m, zr_vf a, zr_vf b)
{
    return m & zr_vf_eq(a, b);
}
static inline zr_vm zr_vi_lt_where(zr_vm m, zr_vi a, zr_vi b)
{
    return m & zr_vi_lt(a, b);
}
/* Whole vectors, also where there are masked stores: the next load of them then need not wait for the cache. */
static inline void zr_vf_store_where(zr_vm m, float *p, zr_vf v)
{
    zr_vf_store(p, zr_vf_select(m, v, zr_vf_load(p)));
}
static inline void zr_vi_store_where(zr_vm m, void *p, zr_vi v)
{
    zr_vi_store(p, zr_vi_select(m, v, zr_vi_load(p)));
}
static inline zr_vf zr_vf_bits(zr_vi a)
{
    return (zr_vf)a;
}
static inline zr_vi zr_vi_bits_of(zr_vf a)
{
    return (zr_vi)a;
}

#include "base/simd/portable.h"

#endif
