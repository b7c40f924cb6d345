/* contour_steps.h - lines: drops smooth contours that nothing lies behind, and closes small gaps of the others.
 *
 * Why:    where a surface is nearly tangent to the view, contours by faces zigzag, and the surface behind begins at
 *         the line.
 * How:    visible contours are linked (links.h). Runs of pieces with steps below 1 pixel go if they are longer than 6
 *         pixels or reach an end. Free ends within 6 pixels that look at each other (cosine 0.7) are bridged by a
 *         piece. Linked lines that then never step by 4 pixels, or are shorter than 12 pixels, go. Pieces at the
 *         background always stay, and so does a line with one of them.
 * Exact:  in the order of pieces. */
#ifndef ZR_CONTOUR_STEPS_H
#define ZR_CONTOUR_STEPS_H

#include "lines/line_pieces.h"

/* Drops pieces and appends bridges. Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_contour_steps_apply(struct zr_arena *arena, const struct zr_cancel *cancel,
                                      const struct zr_cells *cells, struct zr_line_pieces *pieces);

#endif
