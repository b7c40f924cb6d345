/* occlusion.h - effects: ambient occlusion: how much of the light from all around reaches each pixel's centre, and from
 * there each sample.
 *
 * In:     the G-buffer of pixel centres (owner, normal, point). Out: one float a pixel, 0 (dark) .. 1 (open), laid out
 *         as the G-buffer is; 1 where nobody is seen, and on lines.
 * How:    8 directions of 4 steps, interleaved over 4 x 4 pixels, then a separable 5 x 5 blur over pixels on the same
 *         plane. Samples take the four nearest pixel centres, by bilinear weights over their distance to the sample's
 *         plane.
 * Exact:  + - * / and sqrt in one order: every instruction set and thread count gives the same bytes.
 */
#ifndef ZR_OCCLUSION_H
#define ZR_OCCLUSION_H

#include "base/arena.h"
#include "base/isa.h"
#include "base/team.h"
#include "scene/camera.h"
#include "scene/picture.h"
#include "shade/gbuffer.h"
#include "zraster.h"

/* Points no farther than this share of the diagonal from a point's plane are on the same surface. */
#define ZR_OCCLUSION_PLANE 0.01f

/* How large a length at a point is in pixels: pixels = length * scale / (slope . point + offset), which is the point's
 * w of clip space. */
struct zr_pixel_scale {
    float scale;
    float slope[3], offset;
};

/* In a window of that height. */
struct zr_pixel_scale zr_pixel_scale_of(const struct zr_camera *camera, uint32_t height);

/* `diagonal` is that of the scene's bounds. NULL where the arena has failed. Cancelled, it returns early, with numbers
 * that mean nothing. */
const float *zr_occlusion_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                               const struct zr_gbuffer *pixels, const struct zr_occlusion *occlusion,
                               const struct zr_pixel_scale *scale, float diagonal);

/* What samples are lit from. */
struct zr_occlusion_map {
    const struct zr_gbuffer *pixels;
    const float *light; /* of zr_occlusion_make */
    float plane_scale;  /* 1 / (ZR_OCCLUSION_PLANE * diagonal) */
};

/* Samples of a tile, whose lower left one is sample tile_x, tile_y of the whole window at side x side samples a pixel
 * (1, 2, 4 or 8). To out[y * samples->stride + x]; what follows a row's last sample there may be written. 1 where
 * nobody is seen, and on lines. Of one sample a pixel it is the pixel's own. A kernel. */
typedef void zr_occlusion_samples_fn(const struct zr_occlusion_map *map, const struct zr_gbuffer *samples,
                                     uint32_t side, int32_t tile_x, int32_t tile_y, float *out);

zr_occlusion_samples_fn zr_occlusion_samples_scalar, zr_occlusion_samples_sse2, zr_occlusion_samples_avx2,
    zr_occlusion_samples_avx512, zr_occlusion_samples_neon;

zr_occlusion_samples_fn *zr_occlusion_samples_of(enum zr_isa isa);

/* ---- kernels of zr_occlusion_make ---- */

enum { ZR_OCCLUSION_DIRECTIONS = 8, ZR_OCCLUSION_STEPS = 4, ZR_OCCLUSION_TILE = 4 };

/* What is the same for all pixels. Tables have rows of 16, for pixel x at x & 15: the pattern of 4, repeated, so that
 * vectors can be loaded from them; the first index is y & 3. */
struct zr_occlusion_work {
    const struct zr_gbuffer *pixels;
    struct zr_pixel_scale scale;
    float radius, over_square_radius; /* in the scene's units; 1 / radius^2 */
    float strength;
    float plane_limit; /* ZR_OCCLUSION_PLANE of the diagonal */
    zr_vec4 *points;   /* of pixels, laid out as they are; x, y and z side by side, so that a lane loads one at once */
    float *rows;       /* blurred along rows */
    float *light;      /* the result; until a row is blurred, what is found at its pixels */
    float cosine[ZR_OCCLUSION_TILE][ZR_OCCLUSION_DIRECTIONS][16], sine[ZR_OCCLUSION_TILE][ZR_OCCLUSION_DIRECTIONS][16];
    float step[ZR_OCCLUSION_TILE][ZR_OCCLUSION_STEPS][16]; /* shares of the radius */
};

/* Lays out the points of row y. */
typedef void zr_occlusion_row_fn(const struct zr_occlusion_work *work, int32_t y);

zr_occlusion_row_fn zr_occlusion_points_scalar, zr_occlusion_points_sse2, zr_occlusion_points_avx2,
    zr_occlusion_points_avx512, zr_occlusion_points_neon;

/* Finds row y, when all points are there, and blurs it along the row: light and rows. */
zr_occlusion_row_fn zr_occlusion_row_scalar, zr_occlusion_row_sse2, zr_occlusion_row_avx2, zr_occlusion_row_avx512,
    zr_occlusion_row_neon;

/* Blurs across rows, when all are there: rows to row y of light. */
zr_occlusion_row_fn zr_occlusion_blur_scalar, zr_occlusion_blur_sse2, zr_occlusion_blur_avx2, zr_occlusion_blur_avx512,
    zr_occlusion_blur_neon;

#endif
