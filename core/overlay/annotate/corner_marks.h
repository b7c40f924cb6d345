/* corner_marks.h - overlay: title line, triad of axes and scale bar, in corners of the window. */
#ifndef ZR_CORNER_MARKS_H
#define ZR_CORNER_MARKS_H

#include "overlay/annotate/layout.h"

/* Places the name of the model with its size below, at the top left. */
void zr_title_place(struct zr_layout *layout);

/* Places the axes of the file at the lower left. An axis that points at the eye is a dot. */
void zr_triad_place(struct zr_layout *layout);

/* Places a bar of a round length at the lower right, if rays are parallel. */
void zr_scale_place(struct zr_layout *layout);

#endif
