/* overall.h - drawing: the overall sizes of the part, each once: width, height and depth.
 *
 * Where:  the width below the column of the front view; height and depth on the outer side of front and top view.
 * Form:   ISO 129-1: extension lines with a gap of 1 mm and 2 mm beyond the dimension line, filled arrows, the text in
 *         the middle above the line, that of upright lines to be read from the right. A line too short for text and
 *         arrows has both outside. */
#ifndef ZR_OVERALL_H
#define ZR_OVERALL_H

#include "drawing/placed_views.h"

/* Height of texts: dimensions, notes and labels. */
#define ZR_DRAWING_TEXT 3.5

/* Distance of a dimension line from its view; more where it would cross an end of the cutting line of a section. */
#define ZR_OVERALL_OFFSET 10.0
#define ZR_OVERALL_BEYOND (ZR_OVERALL_OFFSET + ZR_PAGE_CUT_ROOM)

/* Adds the dimensions that are more than 0, in a group "dimensions". Sets their boxes. */
void zr_overall_add(struct zr_plot *plot, const struct zr_placed_views *placed, struct zr_page_box boxes[3]);

#endif
