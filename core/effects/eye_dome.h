/* eye_dome.h - effects: eye-dome lighting of point clouds: darkens pixels that are farther than their neighbours.
 *
 * In:     the G-buffer of pixel centres. Out: one factor per pixel, 0 (dark) .. 1, in the layout of the G-buffer.
 * How:    8 directions at 3 distances, which grow with the window. The slope towards each neighbour that is nearer to
 *         the eye counts, up to a limit; uncovered neighbours do not. Then a 3 x 3 blur.
 * Source: Boucheny, "Interactive Scientific Visualization of Large Datasets", 2009, chapter 4.
 * Exact:  + - * / in one order. */
#ifndef ZR_EYE_DOME_H
#define ZR_EYE_DOME_H

#include "base/arena.h"
#include "base/run.h"
#include "base/team.h"
#include "effects/occlusion.h"

/* True if the scene has opaque points, and neither faces nor lines.
 * Such points have no normals, so no shading. */
bool zr_eye_dome_fits(const struct zr_scene *scene);

/* Computes the factors of all pixels. NULL if the arena failed. If cancelled, returns early with undefined values. */
const float *zr_eye_dome_make(const struct zr_run *run, const struct zr_gbuffer *pixels,
                              const struct zr_occlusion *occlusion, const struct zr_pixel_scale *scale);

/* Multiplies colours by the factors. color[k][y * stride + x] is component k of a pixel. Stops early if cancelled. */
void zr_eye_dome_apply(const struct zr_run *run, const struct zr_gbuffer *pixels, const float *light,
                       float *const color[3], size_t stride);

#endif
