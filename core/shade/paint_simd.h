/* paint_simd.h - shade: what the parts of the paint kernel share: bytes, and runs of one value. */
#ifndef ZR_PAINT_SIMD_H
#define ZR_PAINT_SIMD_H

#include "base/simd.h"
#include "shade/paint.h"

/* So many runs wait at a time, and are then painted: by then, what was asked for has come from memory. A row adds no
 * more than it has pixels; a group of lanes is filled up behind the last. */
enum { ZR_PAINT_RUNS = 128, ZR_PAINT_QUEUE = ZR_PAINT_RUNS + ZR_LANES };

/* A tile under work. */
struct zr_canvas {
    const struct zr_geometry *geometry;
    int32_t x, y;     /* of its first pixel, in the window */
    uint32_t *colors; /* laid out as a tile's arrays */
};

/* Runs of pixels, each in one row and of one record. */
struct zr_runs {
    uint32_t count;
    int32_t at[ZR_PAINT_QUEUE];     /* first pixel, in the tile's arrays */
    int32_t length[ZR_PAINT_QUEUE]; /* pixels */
};

/* What is seen where there is no record. */
struct zr_backdrop {
    zr_vi nothing;
    const uint32_t *row; /* behind the first pixel under work; NULL: nothing */
    ptrdiff_t stride;
};

/* Which triangles show their back, of those that go counter-clockwise where `turned`: as a front does, but in a mirror.
 */
static inline zr_vm zr_backs_v(zr_vm turned, bool mirrored)
{
    return mirrored ? turned : zr_vm_andnot(ZR_ALL_LANES, turned);
}

static inline zr_vi zr_color_bytes_v(zr_vf value)
{
    value = zr_vf_min(zr_vf_max(value, zr_vf_set(0.0f)), zr_vf_set(1.0f));
    return zr_vi_round(value * zr_vf_set(255.0f));
}

/* As zr_color_pack, opaque: never 0. */
static inline zr_vi zr_color_pack_v(zr_vf red, zr_vf green, zr_vf blue)
{
    const zr_vi r = zr_color_bytes_v(red), g = zr_color_bytes_v(green), b = zr_color_bytes_v(blue);
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return r | g << 8 | b << 16 | zr_vi_set(-0x1000000);
#else
    return r << 24 | g << 16 | b << 8 | zr_vi_set(255);
#endif
}

static inline void zr_fill_run(uint32_t *pixels, uint32_t count, zr_vi colors)
{
    for (; count > ZR_LANES; count -= ZR_LANES, pixels += ZR_LANES)
        zr_vi_store(pixels, colors);
    zr_vi_store_first(pixels, colors, count);
}

#endif
