/* leader_note.h - overlay: a text beside the model with a leader line to a place on it.
 *
 * Places: 48 directions and 32 lengths of the leader. The text is free of the model, of holes in it, and of other texts
 *         and lines. The leader crosses nothing, and stays apart from other lines.
 * Cost:   the length, half as much again over the model, and a little more to the left, or if it is level or
 *         upright. */
#ifndef ZR_LEADER_NOTE_H
#define ZR_LEADER_NOTE_H

#include "overlay/annotate/model_map.h"

struct zr_leader_note {
    struct zr_segment leader, shelf; /* from the place to an elbow, and on to the text */
    double text_x, text_y;
    struct zr_rect rect, around; /* of the text: up to the shelf, and whole */
    double cost;                 /* HUGE_VAL: no place was found */
};

/* Finds the place of a leader that leads away in the direction (dx, dy); false: none. */
typedef bool zr_leader_tip(const void *context, double dx, double dy, struct zr_point *tip);

/* Replaces *best by a cheaper place of a text with this width, if there is one. */
void zr_leader_note_find(const struct zr_layout *layout, const struct zr_model_map *map, zr_leader_tip *tip_of,
                         const void *context, double width, struct zr_leader_note *best);

/* Keeps later marks off the note. */
void zr_leader_note_take(struct zr_layout *layout, const struct zr_leader_note *note);

/* Draws leader and text, without a mark at the place. */
void zr_leader_note_draw(struct zr_layout *layout, const struct zr_leader_note *note, const char *text, uint32_t color);

#endif
