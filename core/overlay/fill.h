/* fill.h - overlay: fills a polygon in a finished picture, with smooth edges.
 *
 * Space:    that of pen.h. The last point is joined to the first one.
 * Coverage: the area of the pixel inside of the polygon, exactly, if the polygon does not overlap itself. Places that
 *           edges surround twice in one sense count twice, up to all of a pixel.
 * Blend:    that of zr_canvas_blend.
 * Exact:    as pen.h. */
#ifndef ZR_FILL_H
#define ZR_FILL_H

#include "overlay/canvas.h"
#include "overlay/path.h"

/* Fills a polygon of any orientation. Time: pixels of its bounds times its points, so shapes should have few points.
 * Coordinates are finite. */
void zr_fill_draw(const struct zr_canvas *canvas, const struct zr_point *points, uint32_t count, uint32_t color);

#endif
