#include "overlay/annotate/leader_note.h"

#include <math.h>

#include "base/trig.h"

enum { DIRECTIONS = 48, LENGTHS = 32 };

/* Sizes in heights of capitals. */
static const double first_length = 1.6, length_step = 0.8, shelf = 0.9, text_gap = 0.25, text_room = 0.35,
                    line_room = 0.8, left_cost = 1.5, level_cost = 1.0;

/* Cost of a pixel over the model. */
static const double model_cost = 1.5;

static double square_to(struct zr_point p, struct zr_segment s)
{
    const double x = s.to.x - s.from.x, y = s.to.y - s.from.y, length = x * x + y * y;
    double t = length > 0.0 ? ((p.x - s.from.x) * x + (p.y - s.from.y) * y) / length : 0.0;
    t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
    const double dx = s.from.x + t * x - p.x, dy = s.from.y + t * y - p.y;
    return dx * dx + dy * dy;
}

/* True if no other line comes close. Lines that cross are tested elsewhere. */
static bool is_apart(const struct zr_layout *l, struct zr_segment s)
{
    const double least = line_room * l->letters * line_room * l->letters;
    for (uint32_t i = 0; i < l->segment_count; i++) {
        const struct zr_segment other = l->segments[i];
        if (square_to(s.from, other) < least || square_to(s.to, other) < least || square_to(other.from, s) < least ||
            square_to(other.to, s) < least)
            return false;
    }
    return true;
}

static bool is_free(const struct zr_layout *l, const struct zr_model_map *map, const struct zr_leader_note *note)
{
    return zr_layout_is_inside(l, note->rect) && zr_model_map_is_free(map, note->around) &&
           zr_layout_is_apart(l, note->rect) && zr_layout_is_line_free(l, note->leader) &&
           zr_layout_is_line_free(l, note->shelf) && is_apart(l, note->leader) && is_apart(l, note->shelf);
}

/* Makes the note whose leader has this length. */
static struct zr_leader_note note_of(const struct zr_layout *l, struct zr_point tip, double dx, double dy,
                                     double length, double width)
{
    const double h = l->letters, side = dx >= 0.0 ? 1.0 : -1.0;
    const struct zr_point elbow = {tip.x + dx * length, tip.y + dy * length};
    const struct zr_point end = {elbow.x + side * shelf * h, elbow.y};
    struct zr_leader_note note = {.leader = {tip, elbow}, .shelf = {elbow, end}};
    note.text_x = end.x + side * text_gap * h - (side < 0.0 ? width : 0.0);
    note.text_y = elbow.y + 0.5 * h;
    note.rect = note.around = zr_layout_text_rect(note.text_x, note.text_y, width, h, text_room * h);
    if (side > 0.0) /* the shelf ends before the box */
        note.rect.x0 = fmax(note.rect.x0, end.x + 0.01);
    else
        note.rect.x1 = fmin(note.rect.x1, end.x - 0.01);
    return note;
}

/* Tries all lengths in a direction. */
static void try_direction(const struct zr_layout *l, const struct zr_model_map *map, zr_leader_tip *tip_of,
                          const void *context, int number, double width, struct zr_leader_note *best)
{
    const double h = l->letters;
    double dx, dy, walked = 0.0, over = 0.0;
    struct zr_point tip;
    zr_sine_cosine(360.0 / DIRECTIONS * number, &dy, &dx);
    if (!tip_of(context, dx, dy, &tip)) return;
    double extra = dx < 0.0 ? left_cost * h : 0.0;
    if (fabs(dx) < 0.2 || fabs(dy) < 0.2) extra += level_cost * h;
    for (int i = 0; i < LENGTHS; i++) {
        const double length = (first_length + length_step * i) * h;
        for (; walked < length; walked += 1.0)
            over += zr_model_map_at(map, tip.x + dx * walked, tip.y + dy * walked) ? 1.0 : 0.0;
        const double cost = length + model_cost * over + extra;
        if (!(cost < best->cost)) break;
        struct zr_leader_note note = note_of(l, tip, dx, dy, length, width);
        if (!is_free(l, map, &note)) continue;
        note.cost = cost;
        *best = note;
        return;
    }
}

void zr_leader_note_find(const struct zr_layout *l, const struct zr_model_map *map, zr_leader_tip *tip_of,
                         const void *context, double width, struct zr_leader_note *best)
{
    for (int k = 0; k < DIRECTIONS; k++)
        try_direction(l, map, tip_of, context, k, width, best);
}

void zr_leader_note_take(struct zr_layout *l, const struct zr_leader_note *note)
{
    zr_layout_take_rect(l, note->rect);
    zr_layout_take_line(l, note->leader);
    zr_layout_take_line(l, note->shelf);
}

void zr_leader_note_draw(struct zr_layout *l, const struct zr_leader_note *note, const char *text, uint32_t color)
{
    const struct zr_point points[] = {note->leader.from, note->leader.to, note->shelf.to};
    zr_marks_add_line(l->marks, points, 3, zr_layout_ink(l, color, 0.55, true));
    zr_layout_write(l, text, note->text_x, note->text_y, l->letters, color, true);
}
