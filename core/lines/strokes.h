/* strokes.h - lines: polylines to the opacity of ink per pixel.
 *
 * Width:  w = max(1, 1.5 sqrt(min(width, height) / 480)) pixels if none is given. Outlines and those of cuts have w,
 * inner lines 0.7 w, hidden ones 0.5 w, in dashes of 4 w and gaps of 2.5 w along the polyline. A width below a pixel is
 * drawn as a pixel, with that opacity. How:    a segment covers a pixel by clamp(width / 2 + 1/2 - distance of its
 * centre), 0..1. Opacity is 1 for outlines, 0.85 for inner and 0.5 for hidden lines. A pixel has the maximum over all
 * segments: a sum would make dots at joints. Exact:  floats; the same for any number of threads. */
#ifndef ZR_STROKES_H
#define ZR_STROKES_H

#include "base/run.h"
#include "base/team.h"
#include "lines/polylines.h"

/* Returns w for a window; `width`: in pixels, 0: scaled with the window. */
float zr_stroke_width(float width, uint32_t window_width, uint32_t window_height);

/* Returns the width of a class, in units of w. */
float zr_stroke_share(enum zr_stroke_class class);

/* Writes the opacity of each pixel; row 0 is the lowest, rows have `width` values. `w`: of zr_stroke_width. Returns
 * ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_strokes_draw(const struct zr_run *run, const struct zr_polylines *lines, float w, uint32_t width,
                               uint32_t height, float *opacity);

#endif
