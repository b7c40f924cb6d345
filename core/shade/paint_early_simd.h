/* paint_early_simd.h - shade: colours of triangles that are painted early (paint.h), for the kernels that draw them:
 * of tiny ones a sample at a time, and of small ones all that they cover in their stamps.
 */
#ifndef ZR_PAINT_EARLY_SIMD_H
#define ZR_PAINT_EARLY_SIMD_H

#include "raster/stamp_simd.h"
#include "shade/paint_smooth_simd.h"

/* Which colour corner k of triangle t has. */
static inline uint32_t zr_early_color(const struct zr_batch *batch, uint32_t t, uint32_t k)
{
    if (batch->colors == ZR_BATCH_PER_VERTEX) return batch->corners[3 * (size_t)t + k];
    return batch->slots ? batch->slots[3 * (size_t)t + k] : 3 * (batch->first_face + t) + k;
}

/* Of triangles by their numbers. v: the corners as they stand in the mesh; those that are `turned` change places
 * (rule 6). */
static inline struct zr_color_planes zr_early_planes(const struct zr_batch *batch, const uint32_t *numbers,
                                                     zr_vm turned, const struct zr_corner_v v[3])
{
    struct zr_corner_v corners[3] = {v[0], v[1], v[2]};
    struct zr_color_v c[3];
    zr_vf alpha;
#define ZR_EARLY_COLOR_0(i) (&batch->front[zr_early_color(batch, numbers[i] - batch->first, 0)].x)
#define ZR_EARLY_COLOR_1(i) (&batch->front[zr_early_color(batch, numbers[i] - batch->first, 1)].x)
#define ZR_EARLY_COLOR_2(i) (&batch->front[zr_early_color(batch, numbers[i] - batch->first, 2)].x)
    ZR_LOAD4(c[0].red, c[0].green, c[0].blue, alpha, ZR_EARLY_COLOR_0);
    ZR_LOAD4(c[1].red, c[1].green, c[1].blue, alpha, ZR_EARLY_COLOR_1);
    ZR_LOAD4(c[2].red, c[2].green, c[2].blue, alpha, ZR_EARLY_COLOR_2);
#undef ZR_EARLY_COLOR_0
#undef ZR_EARLY_COLOR_1
#undef ZR_EARLY_COLOR_2
    (void)alpha;
    return zr_color_planes_of(turned, corners, c);
}

/* ---- stamps ---- */

static inline struct zr_plane_v zr_plane_pick(const struct zr_plane_v *p, zr_vi lane)
{
    return (struct zr_plane_v){zr_vf_pick(p->a0, lane), zr_vf_pick(p->dadx, lane), zr_vf_pick(p->dady, lane)};
}

/* Lists what ZR_LANES triangles have in their stamps: triangle * ZR_STAMP_SAMPLES + sample. Returns how many there are;
 * the last one fills the vector that it is in. */
static inline uint32_t zr_early_list(const uint32_t stamps[ZR_LANES], uint32_t *samples)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < ZR_LANES; i++)
        for (uint32_t s = 0; s < ZR_STAMP_SAMPLES; s += ZR_LANES)
            count += zr_vi_compress(samples + count, zr_vm_of(stamps[i] >> s & ZR_ALL_BITS),
                                    zr_vi_set((int32_t)(i * ZR_STAMP_SAMPLES + s)) + zr_vi_ramp());
    if (count > 0) zr_vi_store(samples + count, zr_vi_set((int32_t)samples[count - 1]));
    return count;
}

/* Samples of ZR_LANES triangles, to a tile's colours: of two in one place the later triangle's. x0, y0: where their
 * stamps begin. */
static inline void zr_early_paint(struct zr_tile *tile, const struct zr_color_planes *planes, zr_vi x0, zr_vi y0,
                                  const uint32_t stamps[ZR_LANES])
{
    uint32_t samples[ZR_STAMP_SAMPLES * ZR_LANES + 2 * ZR_LANES];
    const uint32_t count = zr_early_list(stamps, samples);
    const zr_vf left = zr_vf_of(x0), low = zr_vf_of(y0), stride = zr_vf_set(ZR_TILE_STRIDE);
    const zr_vf tile_x = zr_vf_set((float)tile->x), tile_y = zr_vf_set((float)tile->y);
    for (uint32_t i = 0; i < count; i += ZR_LANES) {
        const zr_vi sample = zr_vi_load(samples + i), lane = sample >> 4;
        const zr_vi column = sample & zr_vi_set(ZR_STAMP - 1), row = sample >> 2 & zr_vi_set(ZR_STAMP - 1);
        const struct zr_color_planes p = {zr_plane_pick(&planes->oow, lane), zr_plane_pick(&planes->red, lane),
                                          zr_plane_pick(&planes->green, lane), zr_plane_pick(&planes->blue, lane)};
        const zr_vf x = zr_vf_pick(left, lane) + zr_vf_of(column), y = zr_vf_pick(low, lane) + zr_vf_of(row);
        const zr_vi at = zr_vi_round((y - tile_y) * stride + (x - tile_x));
        zr_vi_scatter(tile->color, at, zr_color_at(&p, x, y));
    }
}
_Static_assert(ZR_STAMP == 1 << 2 && ZR_STAMP_SAMPLES == 1 << 4, "rows and triangles are shifts");

#endif
