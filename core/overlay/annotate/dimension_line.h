/* dimension_line.h - overlay: a line of dimension: extension lines, arrow heads and a text. */
#ifndef ZR_DIMENSION_LINE_H
#define ZR_DIMENSION_LINE_H

#include "overlay/annotate/layout.h"

/* Room that a line may take: the text on background only; on the model, too, with a halo of the paper; and lines that
 * cross others, but no text. */
enum zr_line_room { ZR_ROOM_BESIDE, ZR_ROOM_OVER_MODEL, ZR_ROOM_ACROSS, ZR_ROOM_COUNT };

struct zr_dimension_line {
    struct zr_point from, to; /* measured places */
    struct zr_point tips[2];  /* ends of the line, to which extension lines lead */
    double dx, dy;            /* unit vector that leads away from the model, for the text of a short line */
    const char *text;
    bool is_over_model; /* extension lines may cross the model, with a halo */
    enum zr_line_room room;
};

/* Draws the line if it and its text are free. Short lines have their arrows outside, and the text beside them. */
bool zr_dimension_line_place(struct zr_layout *layout, const struct zr_dimension_line *line);

#endif
