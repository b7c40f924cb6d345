/* canvas.h - overlay: fills boxes and blends pixels in a finished picture.
 *
 * Space:  pixels of the picture, (0, 0) at the top left corner, y downwards. */
#ifndef ZR_CANVAS_H
#define ZR_CANVAS_H

#include <stdint.h>

#include "overlay/path.h"

struct zr_canvas {
    uint32_t *pixels; /* RGBA in memory, row 0 on top */
    int32_t width, height;
};

struct zr_box {
    int32_t x, y, width, height;
};

static inline int32_t zr_lesser(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static inline int32_t zr_greater(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* Grows a box by `by` pixels on all sides. */
static inline struct zr_box zr_box_grow(struct zr_box box, int32_t by)
{
    return (struct zr_box){box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by};
}

/* Returns the smallest box that contains both. */
struct zr_box zr_box_join(struct zr_box a, struct zr_box b);

/* Returns the part of the box that lies in the canvas; of width or height 0 if it is empty. */
struct zr_box zr_canvas_clip(const struct zr_canvas *canvas, struct zr_box box);

/* Returns the pixels within `reach` of points, in the canvas; none of no points. */
struct zr_box zr_canvas_bounds(const struct zr_canvas *canvas, const struct zr_point *points, uint32_t count,
                               double reach);

/* Fills the box's part in the canvas with a colour, four bytes as base/rgba.h makes them. */
void zr_canvas_fill(const struct zr_canvas *canvas, struct zr_box box, uint32_t color);

/* Returns a pixel of colour `below` of which the share `covered` has a colour over it: in encoded bytes with straight
 * alpha, rounded to the nearest. */
uint32_t zr_canvas_blend(uint32_t below, uint32_t color, double covered);

/* Returns the medians of red, green and blue over the box's part in the canvas, opaque: the background colour if it
 * covers half of the pixels. Transparent pixels are blended over white. White if the part is empty. */
uint32_t zr_canvas_median(const struct zr_canvas *canvas, struct zr_box box);

/* Returns black or white, whichever is more legible on the opaque colour `paper`. */
uint32_t zr_canvas_ink(uint32_t paper);

#endif
