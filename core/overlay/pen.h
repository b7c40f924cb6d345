/* pen.h - overlay: draws polylines of some width, with round ends and joins, into a finished picture.
 *
 * Space:    pixels, y downwards; the middle of the first pixel is at (0.5, 0.5). Points may lie outside of the canvas.
 * Coverage: the area of a pixel in an endless straight stroke that has the place and direction of the polyline at its
 *           point nearest to the middle of the pixel. So it is exact but for ends, joins and bends. Strokes of one path
 *           are one shape: where they cross or touch, the nearest one counts.
 * Blend:    that of zr_canvas_blend.
 * Exact:    doubles with + - * / and square roots only, in a fixed order. */
#ifndef ZR_PEN_H
#define ZR_PEN_H

#include "overlay/canvas.h"
#include "overlay/path.h"

/* Draws a path. `color`: four bytes as base/rgba.h makes them; its alpha multiplies the coverage. Coordinates are
 * finite. */
void zr_pen_draw(const struct zr_canvas *canvas, const struct zr_path *path, double width, uint32_t color);

#endif
