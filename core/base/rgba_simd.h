/* rgba_simd.h - base: base/rgba.h for kernels: one colour per lane. */
#ifndef ZR_RGBA_SIMD_H
#define ZR_RGBA_SIMD_H

#include "base/mutant.h"
#include "base/rgba.h"
#include "base/simd/simd.h"

/* Converts 0..1 to 0..255, as zr_rgba_byte. */
static inline zr_vi zr_rgba_bytes_v(zr_vf value)
{
    value = zr_vf_min(zr_vf_max(value, zr_vf_set(0.0f)), zr_vf_set(1.0f));
    const zr_vf exact = value * zr_vf_set(255.0f);
    return zr_vi_round(ZR_MUTANT(bytes_rounded_down, exact, exact - zr_vf_set(0.49f)));
}

/* Packs four bytes per lane, red first in memory. */
static inline zr_vi zr_rgba_join_v(zr_vi r, zr_vi g, zr_vi b, zr_vi a)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return r | g << 8 | b << 16 | a << 24;
#else
    return r << 24 | g << 16 | b << 8 | a;
#endif
}

/* zr_rgba_make of each lane. */
static inline zr_vi zr_rgba_make_v(zr_vf red, zr_vf green, zr_vf blue, zr_vf alpha)
{
    return zr_rgba_join_v(zr_rgba_bytes_v(red), zr_rgba_bytes_v(green), zr_rgba_bytes_v(blue), zr_rgba_bytes_v(alpha));
}

/* zr_rgba_opaque of each lane; never 0. */
static inline zr_vi zr_rgba_opaque_v(zr_vf red, zr_vf green, zr_vf blue)
{
    return zr_rgba_join_v(zr_rgba_bytes_v(red), zr_rgba_bytes_v(green), zr_rgba_bytes_v(blue), zr_vi_set(255));
}

#endif
