/* overall.h - drawing: the overall sizes of the part, each once: width, height and depth.
 *
 * Where:  the width below the column of the front view; height and depth on the outer side of front and top view.
 * Form:   ISO 129-1: extension lines with a gap of 1 mm and 2 mm beyond the dimension line, filled arrows, the text in
 *         the middle above the line, that of upright lines to be read from the right. A line too short for text and
 *         arrows has both outside. */
#ifndef ZR_OVERALL_H
#define ZR_OVERALL_H

#include "drawing/page.h"
#include "drawing/plot.h"

/* Height of texts: dimensions, notes and labels. */
#define ZR_DRAWING_TEXT 3.5

/* Distance of a dimension line from its view. */
#define ZR_OVERALL_OFFSET 10.0

/* Adds the three dimensions, in a group "dimensions". `sizes`: width, height, depth, in millimetres of the model. */
void zr_overall_add(struct zr_plot *plot, const struct zr_page *page, const struct zr_page_layout *layout,
                    const double sizes[3]);

#endif
