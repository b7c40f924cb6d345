#include "overlay/annotate/round_dimension.h"

#include <math.h>
#include <stdio.h>

#include "mesh/features/angles.h"
#include "overlay/annotate/hole_notes.h"
#include "overlay/annotate/leader_note.h"
#include "overlay/annotate/length_text.h"

enum { ARC = 32, TEXT_SIZE = ZR_LENGTH_SIZE + 8 };

/* Half of an arrow's width as a share of its length. */
static const double arrow_share = 0.19;

static double arrow_length(const struct zr_layout *l)
{
    return l->letters + 2.2 * l->line;
}

static void draw_arrow(struct zr_layout *l, struct zr_point tip, double dx, double dy)
{
    const double length = sqrt(dx * dx + dy * dy), size = arrow_length(l);
    if (!(length > 0.0)) return;
    zr_marks_add_arrow(l->marks, tip, dx / length, dy / length, size, arrow_share * size,
                       zr_layout_ink(l, l->dimension, 0.0, true));
}

static bool fixed_tip(const void *context, double dx, double dy, struct zr_point *tip)
{
    (void)dx;
    (void)dy;
    *tip = *(const struct zr_point *)context;
    return true;
}

/* Finds the place of a text with a leader to a point. */
static bool find_note(const struct zr_layout *l, const struct zr_model_map *map, struct zr_point tip, const char *text,
                      struct zr_leader_note *note)
{
    note->cost = HUGE_VAL;
    zr_leader_note_find(l, map, fixed_tip, &tip, zr_type_width(text, l->letters), note);
    return note->cost < HUGE_VAL;
}

/* ---- circles ---- */

static const char *text_of(struct zr_layout *l, const struct zr_round_dimension *d, double radius, const char *unit)
{
    char number[ZR_LENGTH_SIZE];
    const bool is_radius = d->kind == ZR_DIMENSION_RADIUS;
    const double length = is_radius ? radius : 2.0 * radius;
    char *text = zr_arena_alloc(l->arena, TEXT_SIZE, 1);
    if (d->label || !text) return d->label;
    zr_length_write(length, (double)zr_diagonal_of(&l->frame->bounds), unit, number);
    snprintf(text, TEXT_SIZE, "%s%s", is_radius ? "R" : "\xc3\xb8", number);
    return text;
}

static const char *place_circle(struct zr_layout *l, const struct zr_model_map *map, const struct zr_round_dimension *d,
                                const char *unit)
{
    const zr_dvec3 way = zr_dvec3_sub(d->ends[1], d->ends[0]);
    const zr_dvec3 other = zr_dvec3_add_scaled(d->ends[0], way, -1.0);
    const char *text = text_of(l, d, sqrt(zr_dvec3_dot(way, way)), unit);
    struct zr_point center, tip, across;
    struct zr_leader_note note;
    if (!text) return "no memory";
    if (!zr_layout_project(l, d->ends[0], &center) || !zr_layout_project(l, d->ends[1], &tip) ||
        !zr_layout_project(l, other, &across))
        return "behind the eye";
    if (!find_note(l, map, tip, text, &note)) return "no room";
    const struct zr_segment line = {tip, d->kind == ZR_DIMENSION_RADIUS ? center : across};
    zr_layout_draw(l, line, l->dimension, 0.55, true);
    zr_leader_note_draw(l, &note, text, l->dimension);
    draw_arrow(l, tip, tip.x - center.x, tip.y - center.y);
    if (d->kind == ZR_DIMENSION_DIAMETER) draw_arrow(l, across, across.x - center.x, across.y - center.y);
    zr_leader_note_take(l, &note);
    zr_layout_take_line(l, line);
    return NULL;
}

/* ---- angles ---- */

/* Finds the points of an arc between two unit vectors that are not opposite. False: behind the eye. */
static bool find_arc(const struct zr_layout *l, zr_dvec3 apex, zr_dvec3 a, zr_dvec3 b, double radius,
                     struct zr_point out[ARC + 1])
{
    for (int i = 0; i <= ARC; i++) {
        const double t = (double)i / ARC;
        const zr_dvec3 v = {a.x * (1.0 - t) + b.x * t, a.y * (1.0 - t) + b.y * t, a.z * (1.0 - t) + b.z * t};
        const double length = sqrt(zr_dvec3_dot(v, v));
        if (!(length > 1e-6) || !zr_layout_project(l, zr_dvec3_add_scaled(apex, v, radius / length), &out[i]))
            return false;
    }
    return true;
}

static void draw_angle(struct zr_layout *l, struct zr_point apex, const struct zr_point *arc,
                       const struct zr_point *ends)
{
    for (int i = 0; i < 2; i++) {
        const struct zr_segment arm = {apex, ends[i]};
        zr_layout_draw(l, arm, l->dimension, 0.4, true);
    }
    zr_marks_add_line(l->marks, arc, ARC + 1, zr_layout_ink(l, l->dimension, 0.55, true));
    for (int i = 0; i < ARC; i += 4)
        zr_layout_take_line(l, (struct zr_segment){arc[i], arc[i + 4]});
    draw_arrow(l, arc[0], arc[0].x - arc[2].x, arc[0].y - arc[2].y);
    draw_arrow(l, arc[ARC], arc[ARC].x - arc[ARC - 2].x, arc[ARC].y - arc[ARC - 2].y);
}

/* Writes a text beyond the middle of an arc, over the model if need be. */
static bool write_outside(struct zr_layout *l, struct zr_point apex, struct zr_point middle, const char *text)
{
    const double h = l->letters, width = zr_type_width(text, h);
    const double x = middle.x - apex.x, y = middle.y - apex.y, length = sqrt(x * x + y * y);
    for (int i = 0; i < 8 && length > 0.0; i++) {
        const double by = (0.8 + 0.5 * i) * h + 0.5 * fabs(x / length) * width;
        const double left = middle.x + x / length * by - 0.5 * width, base = middle.y + y / length * by + 0.5 * h;
        const struct zr_rect rect = zr_layout_text_rect(left, base, width, h, 0.15 * h);
        if (!zr_layout_is_inside(l, rect) || !zr_layout_is_apart(l, rect)) continue;
        zr_layout_write(l, text, left, base, h, l->dimension, true);
        zr_layout_take_rect(l, rect);
        return true;
    }
    return false;
}

static const char *place_angle(struct zr_layout *l, const struct zr_model_map *map, const struct zr_round_dimension *d)
{
    zr_dvec3 arms[2];
    double lengths[2];
    struct zr_point arc[ARC + 1], apex, ends[2];
    struct zr_leader_note note;
    for (int i = 0; i < 2; i++) {
        arms[i] = zr_dvec3_sub(d->ends[i], d->ends[2]);
        lengths[i] = sqrt(zr_dvec3_dot(arms[i], arms[i]));
        if (!(lengths[i] > 0.0)) return "an end lies at the apex";
        arms[i] = (zr_dvec3){arms[i].x / lengths[i], arms[i].y / lengths[i], arms[i].z / lengths[i]};
    }
    const zr_dvec3 across = zr_dvec3_cross(arms[0], arms[1]);
    const double angle = zr_angle_of(zr_dvec3_dot(arms[0], arms[1]), sqrt(zr_dvec3_dot(across, across)));
    char number[ZR_LENGTH_SIZE], *text = zr_arena_alloc(l->arena, TEXT_SIZE, 1);
    if (!text) return "no memory";
    zr_length_write(angle, 180.0, "", number);
    snprintf(text, TEXT_SIZE, "%s\xc2\xb0", number);
    if (!zr_layout_project(l, d->ends[2], &apex) || !zr_layout_project(l, d->ends[0], &ends[0]) ||
        !zr_layout_project(l, d->ends[1], &ends[1]))
        return "behind the eye";
    if (!find_arc(l, d->ends[2], arms[0], arms[1], 0.5 * fmin(lengths[0], lengths[1]), arc)) return "a straight angle";
    static const int tips[] = {ARC / 2, ARC / 4, 3 * ARC / 4, ARC / 8, 7 * ARC / 8};
    const uint32_t segments = l->segment_count;
    bool is_found = false;
    for (int i = 0; i < 2; i++) /* which the leader does not cross */
        zr_layout_take_line(l, (struct zr_segment){apex, ends[i]});
    for (size_t i = 0; i < sizeof tips / sizeof *tips && !is_found; i++)
        is_found = find_note(l, map, arc[tips[i]], d->label ? d->label : text, &note);
    const char *shown = d->label ? d->label : text;
    if (!is_found && write_outside(l, apex, arc[ARC / 2], shown)) {
        draw_angle(l, apex, arc, ends);
        return NULL;
    }
    if (!is_found) {
        l->segment_count = segments;
        return "no room";
    }
    draw_angle(l, apex, arc, ends);
    zr_leader_note_draw(l, &note, shown, l->dimension);
    zr_leader_note_take(l, &note);
    return NULL;
}

const char *zr_round_dimension_place(struct zr_layout *l, const struct zr_model_map *map,
                                     const struct zr_round_dimension *d, const char *unit)
{
    if (d->kind == ZR_DIMENSION_ANGLE) return place_angle(l, map, d);
    if (!d->hole) return place_circle(l, map, d, unit);
    const char *text = text_of(l, d, 0.5 * d->hole->diameter, unit);
    return text ? zr_hole_note_place(l, map, d->hole, text, l->dimension) : "no memory";
}
