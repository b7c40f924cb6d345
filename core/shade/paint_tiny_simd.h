/* paint_tiny_simd.h - shade: colours of tiny triangles that are painted early (paint.h), for the kernel that sorts. */
#ifndef ZR_PAINT_TINY_SIMD_H
#define ZR_PAINT_TINY_SIMD_H

#include "shade/paint_smooth_simd.h"

/* Which colour corner k of triangle t has. */
static inline uint32_t zr_tiny_color(const struct zr_batch *batch, uint32_t t, uint32_t k)
{
    if (batch->colors == ZR_BATCH_PER_VERTEX) return batch->corners[3 * (size_t)t + k];
    return batch->slots ? batch->slots[3 * (size_t)t + k] : 3 * (batch->first_face + t) + k;
}

/* Of triangles by their numbers, each at a pixel x, y of its own. v: the corners as they stand in the mesh; those that
 * are `turned` change places (rule 6). */
static inline zr_vi zr_tiny_colors(const struct zr_batch *batch, const uint32_t *numbers, zr_vm turned,
                                   const struct zr_corner_v v[3], zr_vf x, zr_vf y)
{
    struct zr_corner_v corners[3] = {v[0], v[1], v[2]};
    struct zr_color_v c[3];
    zr_vf alpha;
#define ZR_TINY_COLOR_0(i) (&batch->front[zr_tiny_color(batch, numbers[i] - batch->first, 0)].x)
#define ZR_TINY_COLOR_1(i) (&batch->front[zr_tiny_color(batch, numbers[i] - batch->first, 1)].x)
#define ZR_TINY_COLOR_2(i) (&batch->front[zr_tiny_color(batch, numbers[i] - batch->first, 2)].x)
    ZR_LOAD4(c[0].red, c[0].green, c[0].blue, alpha, ZR_TINY_COLOR_0);
    ZR_LOAD4(c[1].red, c[1].green, c[1].blue, alpha, ZR_TINY_COLOR_1);
    ZR_LOAD4(c[2].red, c[2].green, c[2].blue, alpha, ZR_TINY_COLOR_2);
#undef ZR_TINY_COLOR_0
#undef ZR_TINY_COLOR_1
#undef ZR_TINY_COLOR_2
    (void)alpha;
    const struct zr_color_planes planes = zr_color_planes_of(turned, corners, c);
    return zr_color_at(&planes, x, y);
}

#endif
