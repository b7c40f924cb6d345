/* dimension_line.h - overlay: a line of dimension: extension lines, arrow heads and a text. */
#ifndef ZR_DIMENSION_LINE_H
#define ZR_DIMENSION_LINE_H

#include "overlay/annotate/layout.h"

struct zr_dimension_line {
    struct zr_point from, to; /* measured places */
    struct zr_point tips[2];  /* ends of the line, to which extension lines lead */
    double dx, dy;            /* unit vector that leads away from the model, for the text of a short line */
    const char *text;
    bool is_over_model; /* extension lines may cross the model, with a halo */
    bool may_cover;     /* the text may lie on the model, with a halo of the paper */
};

/* Draws the line if it and its text are free. Short lines have their arrows outside, and the text beside them. */
bool zr_dimension_line_place(struct zr_layout *layout, const struct zr_dimension_line *line);

#endif
