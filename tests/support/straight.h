/* straight.h - support: straight lines the textbook's way, to judge raster/line.h by.
 *
 * Neither knows subpixels or diamonds: Bresenham's runs between pixel centres, in
 * integers; the DDA rounds the ideal line at each step along its major axis.
 */
#ifndef ZR_TEST_STRAIGHT_H
#define ZR_TEST_STRAIGHT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct straight_pixel {
    int32_t x, y;
    bool tie; /* the line passes exactly between this pixel and the next one along the minor axis */
};

/* All pixels from (x0, y0) to (x1, y1), both ends included: max(|dx|, |dy|) + 1 of them, or
 * as many as fit. Returns how many.
 * Source: Bresenham, "Algorithm for computer control of a digital plotter", 1965. */
size_t straight_bresenham(int32_t x0, int32_t y0, int32_t x1, int32_t y1, struct straight_pixel *out, size_t room);

/* One pixel for each pixel centre that the line passes along its major axis; window space,
 * pixel (0, 0) has its centre at (0.5, 0.5). Returns how many fit. */
size_t straight_dda(double x0, double y0, double x1, double y1, struct straight_pixel *out, size_t room);

#endif
