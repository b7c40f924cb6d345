/* hole_notes.h - drawing: notes of holes, such as "4x o5.2 through", with leaders.
 *
 * Which:  one note per group of holes with the same text in one view: the one that sees them along their axis. Holes
 *         seen only obliquely have none.
 * Text:   count, diameter (a radius if the hole is open over more than a quarter), through or depth, and the steps:
 *         diameter and depth of counterbores, diameter and angle of countersinks.
 * Where:  the leader ends with an arrow at the rim of one of the holes and points to its middle. All holes of the group
 *         (the first 64), both sides, rows above the view, below and beside it are compared in a fixed order. Texts lie
 *         apart from views, dimensions, labels and other notes, and inside the frame. Leaders cross no text and no
 *         other leader. The shortest leader wins; those to the left from the left half, above the view and across no
 *         other hole are cheaper. If there is no place, smaller letters are tried. A note without a place is left out,
 *         with a warning.
 * Without: holes that no view shows round have no note, and there is one warning per cause. */
#ifndef ZR_HOLE_NOTES_H
#define ZR_HOLE_NOTES_H

#include "base/warning_list.h"
#include "drawing/center_lines.h"

enum { ZR_NOTE_SIZE = 160, ZR_NOTES_MAX = 64, ZR_NOTE_HOLES_MAX = 64 };

struct zr_hole_note {
    enum zr_page_view view;
    char text[ZR_NOTE_SIZE];
    uint32_t count; /* of holes */
    uint32_t held;  /* the first ones */
    uint32_t holes[ZR_NOTE_HOLES_MAX];
};

/* Why a hole has no note. */
enum zr_no_note { ZR_NO_NOTE_CUT_AWAY, ZR_NO_NOTE_HIDDEN, ZR_NO_NOTE_OBLIQUE, ZR_NO_NOTE_BEYOND, ZR_NO_NOTE_COUNT };

/* Holes without a note, and the text of the first one. */
struct zr_unnoted {
    uint32_t count;
    char first[ZR_NOTE_SIZE];
};

struct zr_hole_notes {
    uint32_t count;
    struct zr_unnoted unnoted[ZR_NO_NOTE_COUNT];
    struct zr_hole_note at[ZR_NOTES_MAX];
};

/* Lists the notes. `placed` needs axes, sizes and section only. Without hidden lines, holes that open away from the eye
 * have no notes. */
void zr_hole_notes_list(const struct zr_placed_views *placed, const struct zr_part_holes *holes,
                        struct zr_hole_notes *out);

/* Adds the notes in a group "notes", and returns how many holes they are of. `boxes`: to be kept free, beside the
 * views. Warnings, of holes without a note too, are in run->arena. If run->cancel is raised, notes are missing. */
uint32_t zr_hole_notes_add(const struct zr_run *run, struct zr_plot *plot, const struct zr_placed_views *placed,
                           const struct zr_part_holes *holes, const struct zr_hole_notes *notes,
                           const struct zr_page_box *boxes, uint32_t box_count, struct zr_warning_list *warnings);

#endif
