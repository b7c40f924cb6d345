/* canvas.h - overlay: boxes of one colour in a finished picture.
 *
 * Space:  pixels of the picture, (0, 0) at the top left corner, y downwards.
 */
#ifndef ZR_CANVAS_H
#define ZR_CANVAS_H

#include <stdint.h>

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

/* With `by` more on all sides. */
static inline struct zr_box zr_box_grow(struct zr_box box, int32_t by)
{
    return (struct zr_box){box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by};
}

/* The smallest one that holds both. */
struct zr_box zr_box_join(struct zr_box a, struct zr_box b);

/* The part of it that is in the canvas; without width or height where there is none. */
struct zr_box zr_canvas_clip(const struct zr_canvas *canvas, struct zr_box box);

/* What of the box is in the canvas gets the colour, four bytes as base/rgba.h makes them. */
void zr_canvas_fill(const struct zr_canvas *canvas, struct zr_box box, uint32_t color);

/* The median of each of red, green and blue in the box's part in the canvas, opaque: the background's colour where that
 * has half of the pixels. What is transparent counts as white, as paper is. White where there is no part. */
uint32_t zr_canvas_median(const struct zr_canvas *canvas, struct zr_box box);

/* Black or white: the one that is read better on that opaque colour. */
uint32_t zr_canvas_ink(uint32_t paper);

#endif
