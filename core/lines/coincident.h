/* coincident.h - lines: hidden pieces that coincide in the window become one.
 *
 * Why:    each line has its own dashes. Those of coincident edges fill the gaps of one another, and look solid.
 * How:    hidden pieces, the longest first, belong to the first of the longer ones on whose straight line both their
 *         ends lie, within 1/32 pixel. Those of one line that overlap by 1/8 pixel become one piece, without the parts
 *         that visible pieces on the line cover. Rests below 0.6 pixel go. A piece that overlaps no other stays as it
 *         is.
 * Exact:  in the order of pieces. At most 64 lines of about the same angle and place are compared with a piece. */
#ifndef ZR_COINCIDENT_H
#define ZR_COINCIDENT_H

#include "lines/line_pieces.h"

/* Drops pieces and appends those that replace them. Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_coincident_join(struct zr_arena *arena, const struct zr_cancel *cancel,
                                  struct zr_line_pieces *pieces);

#endif
