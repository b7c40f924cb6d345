/* occlusion_simd.h - effects: interpolates occlusion from pixel centres to samples; for kernels. */
#ifndef ZR_OCCLUSION_SIMD_H
#define ZR_OCCLUSION_SIMD_H

#include "base/vec3_simd.h"
#include "effects/occlusion.h"

/* Returns the lanes whose point is covered. Uncovered pixels store ZR_FAR_POINT, which the plane of a point seen
 * edge-on may pass at a small distance. */
static inline zr_vm zr_is_near_v(zr_vm where, zr_vf point_x)
{
    return zr_vf_lt_where(where, point_x, zr_vf_set(0.5f * ZR_FAR_POINT));
}

/* Two neighbouring pixel rows, or columns per lane, and the weight of each. At the window's border both are the
 * same. */
struct zr_pixel_row {
    ptrdiff_t start[2]; /* offsets of the rows in the G-buffer */
    float share[2];
};

struct zr_pixel_column {
    int32_t base; /* first column of vectors that contain all columns */
    zr_vi at[2];  /* columns, per lane */
    zr_vf share[2];
};

/* Returns n such that sample v, at `side` samples per pixel, lies between the centres of pixels n and n + 1; may be -1.
 * Centres are at integers here: the sample is at (v + 1/2) / side - 1/2. */
static inline int32_t zr_pixel_before(int32_t v, int32_t side)
{
    return (2 * v + 1 + side) / (2 * side) - 1;
}

static inline struct zr_pixel_row zr_pixel_row_at(const struct zr_gbuffer *pixels, int32_t sample_y, int32_t side)
{
    const int32_t before = zr_pixel_before(sample_y, side), top = pixels->height - 1;
    const float share = (((float)sample_y + 0.5f) / (float)side - 0.5f) - (float)before;
    const int32_t low = before < 0 ? 0 : before, high = before < top ? before + 1 : top;
    return (struct zr_pixel_row){{low * pixels->stride, high * pixels->stride}, {1.0f - share, share}};
}

/* For ZR_LANES neighbouring samples, at least two per pixel. With 4 lanes or more, one vector contains all pixels
 * between them, and lanes are picked from it, which takes a third of the time of gathering. */
static inline struct zr_pixel_column zr_pixel_column_at(const struct zr_gbuffer *pixels, int32_t sample_x, int32_t side)
{
    struct zr_pixel_column column;
    const int32_t first = zr_pixel_before(sample_x, side), most = (int32_t)pixels->stride - ZR_LANES;
    const zr_vf x =
        (zr_vf_of(zr_vi_set(sample_x) + zr_vi_ramp()) + zr_vf_set(0.5f)) / zr_vf_set((float)side) - zr_vf_set(0.5f);
    const zr_vi near = zr_vi_round(x), zero = zr_vi_set(0), last = zr_vi_set(pixels->width - 1);
    const zr_vi before = zr_vi_select(zr_vf_lt(x, zr_vf_of(near)), near - zr_vi_set(1), near);
    column.base = first < 0 ? 0 : first < most ? first : most;
    column.at[0] = zr_vi_min(zr_vi_max(before, zero), last);
    column.at[1] = zr_vi_min(zr_vi_max(before + zr_vi_set(1), zero), last);
    column.share[1] = x - zr_vf_of(before);
    column.share[0] = zr_vf_set(1.0f) - column.share[1];
    return column;
}

static inline zr_vf zr_pixel_pick(const float *row, int32_t base, zr_vi at)
{
    if (ZR_LANES == 1) return zr_vf_bits(zr_vi_gather(ZR_ALL_LANES, row, at));
    return zr_vf_pick(zr_vf_load(row + base), at - zr_vi_set(base));
}

/* Returns the interpolated occlusion. Weights are (bilinear + 0.001) / (0.0001 + distance^2), where distance is that of
 * the pixel's point from the sample's plane, times map->plane_scale. 1 if the weights sum up to 0. */
static inline zr_vf zr_occlusion_between_v(const struct zr_occlusion_map *map, const struct zr_pixel_row *row,
                                           const struct zr_pixel_column *column, struct zr_vec3_v point,
                                           struct zr_vec3_v normal)
{
    const zr_vf zero = zr_vf_set(0.0f);
    zr_vf sum = zero, weights = zero;
    for (int i = 0; i < 4; i++) {
        const ptrdiff_t start = row->start[i >> 1];
        const zr_vi at = column->at[i & 1];
        const struct zr_vec3_v there = {zr_pixel_pick(map->pixels->point[0] + start, column->base, at),
                                        zr_pixel_pick(map->pixels->point[1] + start, column->base, at),
                                        zr_pixel_pick(map->pixels->point[2] + start, column->base, at)};
        const zr_vf light = zr_pixel_pick(map->light + start, column->base, at);
        const zr_vf away = zr_dot_v(zr_minus_v(there, point), normal) * zr_vf_set(map->plane_scale);
        const zr_vf bilinear = column->share[i & 1] * zr_vf_set(row->share[i >> 1]);
        const zr_vf weight = (bilinear + zr_vf_set(0.001f)) / (zr_vf_set(0.0001f) + away * away);
        const zr_vm counts = zr_is_near_v(ZR_ALL_LANES, there.x);
        sum = sum + zr_vf_select(counts, weight * light, zero);
        weights = weights + zr_vf_select(counts, weight, zero);
    }
    return zr_vf_select(zr_vf_lt(zr_vf_set(1e-12f), weights), sum / weights, zr_vf_set(1.0f));
}

#endif
