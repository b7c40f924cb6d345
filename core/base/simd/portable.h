/* portable.h - base: operations of base/simd.h that an instruction set has no instruction for, lane by lane. Included
 * by its header, behind all else.
 */
#ifndef ZR_SIMD_PORTABLE_H
#define ZR_SIMD_PORTABLE_H

#include <stddef.h>

static inline uint32_t zr_vi_compress(void *p, zr_vm m, zr_vi v)
{
    int32_t lanes[ZR_LANES], *out = p;
    uint32_t count = 0;
    zr_vi_store(lanes, v);
    for (uint32_t bits = zr_vm_bits(m); bits; bits &= bits - 1)
        out[count++] = lanes[__builtin_ctz(bits)];
    return count;
}

static inline void zr_load_corners(const float *vertices, const uint32_t *corners, zr_vf x[3], zr_vf y[3])
{
    for (int k = 0; k < 3; k++) {
#define ZR_CORNER_AT(i) (vertices + 4 * (size_t)corners[3 * (i) + k])
        ZR_LOAD2(x[k], y[k], ZR_CORNER_AT);
#undef ZR_CORNER_AT
    }
}

#ifndef ZR_HAS_GATHER
static inline zr_vi zr_vi_gather(zr_vm m, const void *p, zr_vi i)
{
    int32_t at[ZR_LANES], lanes[ZR_LANES];
    zr_vi_store(at, i);
    memset(lanes, 0, sizeof lanes);
    for (uint32_t bits = zr_vm_bits(m); bits; bits &= bits - 1) {
        const int lane = __builtin_ctz(bits);
        memcpy(&lanes[lane], (const char *)p + 4 * (ptrdiff_t)at[lane], sizeof *lanes);
    }
    return zr_vi_load(lanes);
}
#endif

#endif
