/* place_marks.h - overlay: numbers or short texts in rings, with a leader line to a dot at their place.
 *
 * Where:  the nearest free ring around the place, first away from the middle of the window. Marks may lie on the model,
 *         and places behind it have marks, too. */
#ifndef ZR_PLACE_MARKS_H
#define ZR_PLACE_MARKS_H

#include "overlay/annotate/layout.h"

/* Draws the marks of the view. */
void zr_place_marks_place(struct zr_layout *layout);

#endif
