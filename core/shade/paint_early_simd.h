/* paint_early_simd.h - shade: colours of triangles that are painted early (paint.h), for the kernels that draw them. */
#ifndef ZR_PAINT_EARLY_SIMD_H
#define ZR_PAINT_EARLY_SIMD_H

#include "shade/planes_simd.h"

/* Of triangles by their numbers. v: the corners as they stand in the mesh; those that are `turned` change places
 * (rule 6). */
static inline struct zr_color_planes zr_early_planes(const struct zr_batch *batch, const uint32_t *numbers,
                                                     zr_vm turned, const struct zr_corner_v v[3])
{
    struct zr_corner_v corners[3] = {v[0], v[1], v[2]};
    struct zr_color_v c[3];
#define ZR_EARLY_COLOR_0(i) (&batch->front[zr_batch_corner_color(batch, numbers[i] - batch->first, 0)].x)
#define ZR_EARLY_COLOR_1(i) (&batch->front[zr_batch_corner_color(batch, numbers[i] - batch->first, 1)].x)
#define ZR_EARLY_COLOR_2(i) (&batch->front[zr_batch_corner_color(batch, numbers[i] - batch->first, 2)].x)
    ZR_LOAD_COLORS(c, ZR_EARLY_COLOR_0, ZR_EARLY_COLOR_1, ZR_EARLY_COLOR_2);
#undef ZR_EARLY_COLOR_0
#undef ZR_EARLY_COLOR_1
#undef ZR_EARLY_COLOR_2
    return zr_color_planes_of(turned, corners, c);
}

/* Of pixels x, y, each with the planes of the lane that it names. */
static inline zr_vi zr_early_colors(const struct zr_color_planes *planes, zr_vi lane, zr_vf x, zr_vf y)
{
    const struct zr_color_planes p = {zr_plane_pick(&planes->oow, lane), zr_plane_pick(&planes->red, lane),
                                      zr_plane_pick(&planes->green, lane), zr_plane_pick(&planes->blue, lane)};
    return zr_color_at(&p, x, y);
}

#endif
