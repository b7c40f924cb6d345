/* occlusion.h - effects: ambient occlusion at pixel centres, and its interpolation to samples.
 *
 * In:     the G-buffer of pixel centres (owner, normal, point). Out: one float per pixel, 0 (dark) .. 1 (open), in the
 *         layout of the G-buffer; 1 for uncovered pixels and lines.
 * How:    2 axes, each in both directions, of 4 steps, interleaved over 4 x 4 pixels. Each point found is the top of a
 *         column on the plane of the pixel's point, which hides light as in a height field. Then a separable 5 x 5 blur
 *         over pixels on the same plane. Samples interpolate the four nearest pixel centres: bilinear weights, divided
 *         by the squared distance to the sample's plane.
 * Exact:  + - * / and sqrt in one order: every instruction set and thread count gives the same bytes. */
#ifndef ZR_OCCLUSION_H
#define ZR_OCCLUSION_H

#include "base/arena.h"
#include "base/isa.h"
#include "base/run.h"
#include "base/team.h"
#include "core.h"
#include "scene/camera/camera.h"
#include "scene/effects.h"
#include "shade/lights/gbuffer.h"
#include "shade/sample_list.h"

/* Points within this distance of a point's plane are on the same surface; relative to the diagonal. */
#define ZR_OCCLUSION_PLANE 0.01f

/* Converts lengths at a point to pixels: pixels = length * scale / w, where w = slope . point + offset is the point's w
 * in clip space. */
struct zr_pixel_scale {
    float scale;
    float slope[3], offset;
};

/* Returns the scale for a window of `height` pixels. */
struct zr_pixel_scale zr_pixel_scale_of(const struct zr_camera *camera, uint32_t height);

/* Computes the occlusion of all pixels. `diagonal`: that of the scene's bounds, scene units. NULL if the arena failed.
 * If cancelled, returns early with undefined values. */
const float *zr_occlusion_make(const struct zr_run *run, const struct zr_gbuffer *pixels,
                               const struct zr_occlusion *occlusion, const struct zr_pixel_scale *scale,
                               float diagonal);

/* Occlusion of pixels, for samples to interpolate. */
struct zr_occlusion_map {
    const struct zr_gbuffer *pixels;
    const float *light; /* from zr_occlusion_make */
    float plane_scale;  /* 1 / (ZR_OCCLUSION_PLANE * diagonal) */
};

/* Interpolates the occlusion of a tile's samples. The lower left one is sample tile_x, tile_y of the whole window at
 * side x side samples per pixel (1, 2, 4 or 8). Writes out[y * samples->stride + x], and may write past a row's last
 * sample. Uncovered samples and lines get 1. At one sample per pixel, copies the pixel's value. A kernel. */
typedef void zr_occlusion_samples_fn(const struct zr_occlusion_map *map, const struct zr_gbuffer *samples,
                                     uint32_t side, int32_t tile_x, int32_t tile_y, float *out);

ZR_KERNEL_TABLE(zr_occlusion_samples_fn, zr_occlusion_samples)

/* Interpolates the occlusion at places of a list, with `side` samples per side of a pixel, whose values are a G-buffer
 * of one row. Up to 15 values behind the last may be written. */
typedef void zr_occlusion_places_fn(const struct zr_occlusion_map *map, const struct zr_sample_list *list,
                                    const struct zr_gbuffer *values, uint32_t side, float *out);

ZR_KERNEL_TABLE(zr_occlusion_places_fn, zr_occlusion_places)

/* ---- kernels of zr_occlusion_make ---- */

enum { ZR_OCCLUSION_AXES = 2, ZR_OCCLUSION_STEPS = 4, ZR_OCCLUSION_TILE = 4 };

/* Parameters shared by all pixels. Table rows hold the pattern of 4 pixels repeated to 16, so that a vector for pixel x
 * can be loaded from x & 15; the first index is y & 3. */
struct zr_occlusion_work {
    const struct zr_gbuffer *pixels;
    struct zr_pixel_scale scale;
    float radius, over_radius; /* in scene units; 1 / radius */
    float strength;
    float plane_limit; /* ZR_OCCLUSION_PLANE times the diagonal */
    zr_vec4 *points;   /* per pixel, in radii, in the G-buffer's layout; x, y and z are adjacent, so that a lane loads a
                        * point at once */
    float *rows;       /* blurred along rows */
    float *light;      /* the result; before a row is blurred, its raw occlusion */
    float cosine[ZR_OCCLUSION_TILE][ZR_OCCLUSION_AXES][16], sine[ZR_OCCLUSION_TILE][ZR_OCCLUSION_AXES][16];
    float step[ZR_OCCLUSION_TILE][ZR_OCCLUSION_STEPS][16]; /* relative to the radius */
};

/* Sets row y of `points`. */
typedef void zr_occlusion_row_fn(const struct zr_occlusion_work *work, int32_t y);

ZR_KERNEL_TABLE(zr_occlusion_row_fn, zr_occlusion_points)

/* Computes row y of `light`, and its blur along the row to `rows`. All points must be there. */
ZR_KERNEL_TABLE(zr_occlusion_row_fn, zr_occlusion_row)

/* Blurs `rows` across rows to row y of `light`. All rows must be there. */
ZR_KERNEL_TABLE(zr_occlusion_row_fn, zr_occlusion_blur)

#endif
