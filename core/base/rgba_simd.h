/* rgba_simd.h - base: base/rgba.h for kernels: one colour per lane. */
#ifndef ZR_RGBA_SIMD_H
#define ZR_RGBA_SIMD_H

#include "base/mutant.h"
#include "base/rgba.h"
#include "base/simd.h"

/* 0..255, as zr_rgba_byte. */
static inline zr_vi zr_rgba_bytes_v(zr_vf value)
{
    value = zr_vf_min(zr_vf_max(value, zr_vf_set(0.0f)), zr_vf_set(1.0f));
    const zr_vf exact = value * zr_vf_set(255.0f);
    return zr_vi_round(ZR_MUTANT(bytes_rounded_down, exact, exact - zr_vf_set(0.49f)));
}

/* As zr_rgba_opaque. No result is 0, since alpha is 255. */
static inline zr_vi zr_rgba_opaque_v(zr_vf red, zr_vf green, zr_vf blue)
{
    const zr_vi r = zr_rgba_bytes_v(red), g = zr_rgba_bytes_v(green), b = zr_rgba_bytes_v(blue);
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return r | g << 8 | b << 16 | zr_vi_set(-0x1000000);
#else
    return r << 24 | g << 16 | b << 8 | zr_vi_set(255);
#endif
}

#endif
