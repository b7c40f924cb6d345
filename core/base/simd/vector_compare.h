/* vector_compare.h - base: the comparisons of base/simd.h where a truth is all bits of a lane, or none, as C's own
 * vectors have it. Included below the types of such an instruction set.
 */
#ifndef ZR_SIMD_VECTOR_COMPARE_H
#define ZR_SIMD_VECTOR_COMPARE_H

static inline zr_vm zr_vf_lt(zr_vf a, zr_vf b)
{
    return (zr_vm)(a < b);
}
static inline zr_vm zr_vf_le(zr_vf a, zr_vf b)
{
    return (zr_vm)(a <= b);
}
static inline zr_vm zr_vf_eq(zr_vf a, zr_vf b)
{
    return (zr_vm)(a == b);
}
static inline zr_vm zr_vi_lt(zr_vi a, zr_vi b)
{
    return (zr_vm)(a < b);
}
static inline zr_vm zr_vi_eq(zr_vi a, zr_vi b)
{
    return (zr_vm)(a == b);
}

#endif
