/* vector_masks.h - base: what follows from the rest of base/simd.h where a truth is all bits of a lane, or none, and
 * there are no instructions for it. Included at the end of such an instruction set's header.
 */
#ifndef ZR_SIMD_VECTOR_MASKS_H
#define ZR_SIMD_VECTOR_MASKS_H

static inline void zr_vi_store_where(void *p, zr_vm m, zr_vi v)
{
    zr_vi_store(p, zr_vi_select(m, v, zr_vi_load(p)));
}
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
#ifndef ZR_HAS_COMPRESS
/* Every lane is stored, and the next one over it where it was not to be: no branch, and no table. */
static inline uint32_t zr_vi_compress(void *p, zr_vm m, zr_vi v)
{
    const uint32_t bits = zr_vm_bits(m);
    uint32_t count = 0;
    for (int i = 0; i < ZR_LANES; i++) {
        const int32_t lane = v[i];
        memcpy((char *)p + 4 * (size_t)count, &lane, sizeof lane);
        count += bits >> i & 1u;
    }
    return count;
}
#endif
static inline zr_vf zr_vf_bits(zr_vi a)
{
    return (zr_vf)a;
}
static inline zr_vi zr_vi_bits_of(zr_vf a)
{
    return (zr_vi)a;
}

#endif
