/* paint_simd.h - shade: what the parts of the paint kernel share: bytes, and runs of one value. */
#ifndef ZR_PAINT_SIMD_H
#define ZR_PAINT_SIMD_H

#include "base/rgba_simd.h"
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

static inline void zr_fill_run(uint32_t *pixels, uint32_t count, zr_vi colors)
{
    for (; count > ZR_LANES; count -= ZR_LANES, pixels += ZR_LANES)
        zr_vi_store(pixels, colors);
    zr_vi_store_first(pixels, colors, count);
}

#endif
