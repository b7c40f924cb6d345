/* hole_notes.h - overlay: one note per group of equal holes: "6x o0.26 through", with a leader line.
 *
 * Groups:  holes with the same text and parallel axes, over all parts (mesh/features/holes.h).
 * Seen:    a hole is seen if 12 of 36 points of its rim are: the depth of one of 3 x 3 pixels is within 0.008 of the
 *          diagonal of the bounds. Without that, notes would point at walls.
 * Places:  by overlay/annotate/leader_note.h, at up to 8 seen holes of the group. Holes that are seen whole come first.
 *          If a group has no place, all are placed again with that one first, up to 4 times.
 * Left out: groups that are not seen, or without a place. */
#ifndef ZR_HOLE_NOTES_H
#define ZR_HOLE_NOTES_H

#include "mesh/features/holes.h"
#include "overlay/annotate/model_map.h"

enum { ZR_HOLE_TEXT_SIZE = 256 };

/* Writes the text of a hole: diameter, through or depth, and steps. `largest`: length of the model; `unit` follows the
 * diameter. */
void zr_hole_text_write(const struct zr_hole *hole, double largest, const char *unit, char out[ZR_HOLE_TEXT_SIZE]);

/* Places the notes of the frame's parts. The frame has a depth. */
void zr_hole_notes_place(struct zr_layout *layout, const char *unit);

/* Places a text with an arrow at the rim of one hole. Returns why it has no place, or NULL. */
const char *zr_hole_note_place(struct zr_layout *layout, const struct zr_model_map *map, const struct zr_hole *hole,
                               const char *text, uint32_t color);

#endif
