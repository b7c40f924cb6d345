/* margins.h - scene: parts of the window that a fitted view leaves free: the padding, and room for marks.
 *
 * Views:  the same for all outputs, so that data channels agree with the picture.
 * Sizes:  those of overlay/annotate, in heights of capitals; widths of texts are assumed. */
#ifndef ZR_MARGINS_H
#define ZR_MARGINS_H

#include <stdbool.h>

#include "scene/view.h"

/* Shares of the window; opposite ones are at most 0.8 together. */
struct zr_margins {
    double left, right, top, bottom;
};

/* Returns the margins: the padding, or more for marks. */
struct zr_margins zr_view_margins(const struct zr_view *view);

/* Returns true if the margins of opposite sides may differ. */
bool zr_view_has_room(const struct zr_view *view);

/* Returns true if corners of the bounds are fitted instead of the geometry, since they have dimensions. */
bool zr_view_fits_corners(const struct zr_view *view);

/* Returns the height of capitals of marks in a window of these sides: 11 pixels at 480, growing with the power 3/4 of
 * the shorter side; at least 7 and whole. That of zr_type_height. */
double zr_margin_letters(double width, double height);

#endif
