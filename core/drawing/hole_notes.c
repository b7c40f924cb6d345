#include "drawing/hole_notes.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/cancel.h"
#include "drawing/overall.h"
#include "overlay/annotate/length_text.h"
#include "overlay/type.h"

/* ---- texts ---- */

struct writing {
    const struct zr_placed_views *placed;
    char *text;
    size_t used;
};

__attribute__((format(printf, 2, 3))) static void add(struct writing *w, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    const int length = vsnprintf(w->text + w->used, ZR_NOTE_SIZE - w->used, format, values);
    va_end(values);
    if (length > 0) w->used += (size_t)length;
    if (w->used >= ZR_NOTE_SIZE) w->used = ZR_NOTE_SIZE - 1;
}

static void add_length(struct writing *w, const char *before, double length)
{
    const double *sizes = w->placed->sizes;
    char text[ZR_LENGTH_SIZE];
    zr_length_write(w->placed->unit * length, fmax(sizes[0], fmax(sizes[1], sizes[2])), "", text);
    add(w, "%s%s", before, text);
}

/* Writes the text without the count. */
static void write_text(const struct zr_placed_views *placed, const struct zr_hole *hole, char text[ZR_NOTE_SIZE])
{
    struct writing w = {.placed = placed, .text = text};
    if (hole->coverage < 270.0)
        add_length(&w, "R", 0.5 * hole->diameter);
    else
        add_length(&w, "\xc3\xb8", hole->diameter);
    if (hole->reach == ZR_REACH_THROUGH) add(&w, " through");
    if (hole->reach == ZR_REACH_BLIND) add_length(&w, " depth ", hole->depth);
    for (uint32_t i = 0; i < hole->step_count; i++) {
        add_length(&w, ", \xc3\xb8", hole->steps[i].diameter);
        if (hole->steps[i].angle > 0.0)
            add(&w, " \xc3\x97 %.0f\xc2\xb0", hole->steps[i].angle);
        else
            add_length(&w, " depth ", hole->steps[i].depth);
    }
}

/* ---- groups ---- */

/* Returns the view that sees a hole along its axis; ZR_PAGE_ISOMETRIC: none does. */
static enum zr_page_view view_of(const struct zr_placed_views *placed, const struct zr_part_hole *hole)
{
    for (int view = 0; view < ZR_PAGE_ISOMETRIC; view++) {
        if (zr_hole_side_of(placed, (enum zr_page_view)view, hole) != ZR_HOLE_ROUND) continue;
        const bool opens_away = zr_dvec3_dot(placed->views[view].axes.back, hole->hole.axis) > 0.0;
        const bool is_hidden = opens_away && hole->hole.reach != ZR_REACH_THROUGH;
        if (!is_hidden || (placed->has_hidden && !(placed->is_cut && (int)placed->cut == view)))
            return (enum zr_page_view)view;
    }
    return ZR_PAGE_ISOMETRIC;
}

/* Returns why no view shows a hole round with a note. */
static enum zr_no_note why_unnoted(const struct zr_placed_views *placed, const struct zr_part_hole *hole)
{
    struct zr_placed_views whole = *placed;
    whole.is_cut = false;
    enum zr_no_note why = ZR_NO_NOTE_OBLIQUE;
    for (int view = 0; view < ZR_PAGE_ISOMETRIC; view++) {
        if (zr_hole_side_of(&whole, (enum zr_page_view)view, hole) != ZR_HOLE_ROUND) continue;
        if (zr_hole_side_of(placed, (enum zr_page_view)view, hole) == ZR_HOLE_GONE) return ZR_NO_NOTE_CUT_AWAY;
        why = ZR_NO_NOTE_HIDDEN;
    }
    return why;
}

static void leave_out(struct zr_hole_notes *notes, enum zr_no_note why, const char *text)
{
    struct zr_unnoted *unnoted = &notes->unnoted[why];
    if (unnoted->count++ == 0) memcpy(unnoted->first, text, sizeof unnoted->first);
}

void zr_hole_notes_list(const struct zr_placed_views *placed, const struct zr_part_holes *holes,
                        struct zr_hole_notes *out)
{
    out->count = 0;
    memset(out->unnoted, 0, sizeof out->unnoted);
    for (uint32_t i = 0; i < holes->count; i++) {
        const enum zr_page_view view = view_of(placed, &holes->at[i]);
        char text[ZR_NOTE_SIZE];
        uint32_t n = 0;
        write_text(placed, &holes->at[i].hole, text);
        if (view == ZR_PAGE_ISOMETRIC) {
            leave_out(out, why_unnoted(placed, &holes->at[i]), text);
            continue;
        }
        while (n < out->count && !(out->at[n].view == view && strcmp(out->at[n].text, text) == 0))
            n++;
        if (n == ZR_NOTES_MAX) {
            leave_out(out, ZR_NO_NOTE_BEYOND, text);
            continue;
        }
        struct zr_hole_note *note = &out->at[n];
        if (n == out->count) {
            *note = (struct zr_hole_note){.view = view};
            memcpy(note->text, text, sizeof text);
            out->count++;
        }
        note->count++;
        if (note->held < ZR_NOTE_HOLES_MAX) note->holes[note->held++] = i;
    }
}

/* ---- places ---- */

enum {
    BOXES_MAX = ZR_NOTES_MAX + 32,
    LEADERS_MAX = 2 * ZR_NOTES_MAX,
    ROWS = 6,
    SIDE_ROWS = 24,
    SLOPES = 6,
    HEIGHTS = 2
};

static const double heights[HEIGHTS] = {ZR_DRAWING_TEXT, 2.5}; /* of ISO 3098 */
static const double beside = 8.0, below = 9.0, away = 14.0, other_half = 10.0, other_hole = 12.0, rim = 1.0;

struct leader {
    struct zr_point from, to;
};

struct placing {
    const struct zr_cancel *cancel;
    struct zr_plot *plot;
    const struct zr_placed_views *placed;
    const struct zr_part_holes *holes;
    double height; /* of texts */
    uint32_t box_count, leader_count;
    struct zr_page_box boxes[BOXES_MAX];
    struct leader leaders[LEADERS_MAX];
};

/* A place of a note: the leader goes from the rim of a hole to the elbow, and the text runs from there to the left or
 * to the right on a shelf. */
struct place {
    double cost;
    struct zr_point center, elbow, rim;
    double side; /* 1: to the right */
};

static bool overlap(struct zr_page_box a, struct zr_page_box b)
{
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

static double turn(struct zr_point a, struct zr_point b, struct zr_point c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static bool cross(struct leader a, struct leader b)
{
    return (turn(a.from, a.to, b.from) > 0.0) != (turn(a.from, a.to, b.to) > 0.0) &&
           (turn(b.from, b.to, a.from) > 0.0) != (turn(b.from, b.to, a.to) > 0.0);
}

/* True if a line has a point in a box: an end, or a crossing with a diagonal. */
static bool meets(struct leader line, struct zr_page_box box)
{
    const struct leader one = {{box.x0, box.y0}, {box.x1, box.y1}}, other = {{box.x0, box.y1}, {box.x1, box.y0}};
    const bool has_end = line.to.x > box.x0 && line.to.x < box.x1 && line.to.y > box.y0 && line.to.y < box.y1;
    return has_end || cross(line, one) || cross(line, other);
}

static struct zr_page_box text_box(const struct placing *p, const struct place *place, double width)
{
    const double x0 = place->side > 0.0 ? place->elbow.x : place->elbow.x - width;
    return (struct zr_page_box){x0 - rim, place->elbow.y - p->height - 2.0, x0 + width + rim, place->elbow.y + rim};
}

static bool is_free(const struct placing *p, const struct place *place, double width)
{
    const struct zr_page_box box = text_box(p, place, width), frame = p->placed->page.frame;
    const struct leader leader = {place->rim, place->elbow};
    if (box.x0 < frame.x0 + 2.0 || box.x1 > frame.x1 - 2.0 || box.y0 < frame.y0 + 2.0 || box.y1 > frame.y1 - 2.0)
        return false;
    for (uint32_t i = 0; i < p->box_count; i++)
        if (overlap(box, p->boxes[i])) return false;
    for (uint32_t i = ZR_PAGE_VIEWS; i < p->box_count; i++)
        if (meets(leader, p->boxes[i])) return false;
    for (uint32_t i = 0; i < p->leader_count; i++)
        if (cross(leader, p->leaders[i]) || meets(p->leaders[i], box)) return false;
    return true;
}

/* Returns the distance of a point from a leader. */
static double distance(struct leader line, struct zr_point at)
{
    const double x = line.to.x - line.from.x, y = line.to.y - line.from.y, squared = x * x + y * y;
    const double along = squared > 0.0 ? ((at.x - line.from.x) * x + (at.y - line.from.y) * y) / squared : 0.0;
    const double share = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along;
    const double dx = at.x - (line.from.x + share * x), dy = at.y - (line.from.y + share * y);
    return sqrt(dx * dx + dy * dy);
}

/* Returns how many other holes a leader crosses. */
static uint32_t crossed_holes(const struct placing *p, enum zr_page_view view, const struct zr_part_hole *own,
                              struct leader leader)
{
    const double factor = zr_placed_factor(p->placed);
    uint32_t crossed = 0;
    for (uint32_t i = 0; i < p->holes->count; i++) {
        const struct zr_part_hole *hole = &p->holes->at[i];
        if (hole == own || zr_hole_side_of(p->placed, view, hole) != ZR_HOLE_ROUND) continue;
        const double from = distance(leader, zr_placed_world(p->placed, view, hole->ends[0]));
        crossed += from < factor * hole->radius + 0.5;
    }
    return crossed;
}

/* Completes a place whose elbow and side are set, and takes it if it is free and cheaper than the best one. */
static void offer(const struct placing *p, enum zr_page_view view, const struct zr_part_hole *hole, struct place place,
                  double width, struct place *best)
{
    const double x = place.elbow.x - place.center.x, y = place.elbow.y - place.center.y;
    const double length = sqrt(x * x + y * y), radius = zr_placed_factor(p->placed) * 0.5 * hole->hole.diameter;
    if (!(length > radius + 3.0)) return;
    place.rim = (struct zr_point){place.center.x + radius * (x / length), place.center.y + radius * (y / length)};
    place.cost += length;
    if (!(place.cost < best->cost) || !is_free(p, &place, width)) return;
    place.cost += other_hole * crossed_holes(p, view, hole, (struct leader){place.rim, place.elbow});
    if (place.cost < best->cost) *best = place;
}

/* Offers places above the view, or below it. */
static void offer_rows(const struct placing *p, const struct zr_hole_note *note, const struct zr_part_hole *hole,
                       double width, bool is_below, struct place *best)
{
    static const double slopes[SLOPES] = {0.58, 1.0, 0.36, 0.18, 1.7, 2.7},
                        costs[SLOPES] = {0.0, 1.0, 4.0, 8.0, 2.0, 4.0};
    const struct zr_page_box view = p->placed->layout.views[note->view];
    const struct zr_point center = zr_placed_world(p->placed, note->view, hole->ends[0]);
    const bool is_left = center.x < 0.5 * (view.x0 + view.x1);
    for (int row = 0; row < ROWS; row++)
        for (int slope = 0; slope < SLOPES; slope++)
            for (int k = 0; k < 2; k++) {
                const double side = (k == 0) == is_left ? -1.0 : 1.0;
                const double y = is_below ? view.y1 + below + ZR_PAGE_NOTE_ROW * row
                                          : view.y0 - ZR_PAGE_NOTE_FIRST - ZR_PAGE_NOTE_ROW * row;
                const struct place place = {.cost =
                                                costs[slope] + (k == 0 ? 0.0 : other_half) + (is_below ? away : 0.0),
                                            .center = center,
                                            .elbow = {center.x + side * slopes[slope] * fabs(center.y - y), y},
                                            .side = side};
                offer(p, note->view, hole, place, width, best);
            }
}

/* Offers places at both sides of the view. */
static void offer_beside(const struct placing *p, const struct zr_hole_note *note, const struct zr_part_hole *hole,
                         double width, struct place *best)
{
    const struct zr_page_box view = p->placed->layout.views[note->view];
    const struct zr_point center = zr_placed_world(p->placed, note->view, hole->ends[0]);
    for (int row = -2; row < SIDE_ROWS; row++)
        for (int k = 0; k < 2; k++) {
            const double side = k == 0 ? 1.0 : -1.0, y = view.y0 + ZR_PAGE_NOTE_ROW * row;
            const struct place place = {.cost = away,
                                        .center = center,
                                        .elbow = {(k == 0 ? view.x1 : view.x0) + side * beside, y},
                                        .side = side};
            if (y < view.y1 + 2.0 * ZR_PAGE_NOTE_ROW) offer(p, note->view, hole, place, width, best);
        }
}

static void take(struct placing *p, const struct place *place, const char *text, double width)
{
    const struct zr_page_box box = text_box(p, place, width);
    const double x = place->rim.x - place->center.x, y = place->rim.y - place->center.y, length = sqrt(x * x + y * y);
    const double x0 = place->side > 0.0 ? place->elbow.x : place->elbow.x - width;
    const struct zr_point points[] = {place->rim, place->elbow, {place->elbow.x + place->side * width, place->elbow.y}};
    zr_plot_add_line(p->plot, ZR_PLOT_DIMENSION, points, 3);
    zr_plot_add_arrow(p->plot, place->rim, 0.0 - x / length, 0.0 - y / length);
    zr_plot_add_text(p->plot, text, (struct zr_point){x0, place->elbow.y - 1.0}, p->height, false);
    p->boxes[p->box_count++] = box;
    p->leaders[p->leader_count++] = (struct leader){place->rim, place->elbow};
}

/* Places a text of p->height. */
static bool place_text(struct placing *p, const struct zr_hole_note *note, const char *text)
{
    const double width = zr_type_width(text, p->height);
    struct place best = {.cost = HUGE_VAL};
    for (uint32_t i = 0; i < note->held && !zr_is_cancelled(p->cancel); i++) {
        const struct zr_part_hole *hole = &p->holes->at[note->holes[i]];
        offer_rows(p, note, hole, width, false, &best);
        offer_rows(p, note, hole, width, true, &best);
        offer_beside(p, note, hole, width, &best);
    }
    if (best.cost < HUGE_VAL) take(p, &best, text, width);
    return best.cost < HUGE_VAL;
}

static bool place_note(struct placing *p, const struct zr_hole_note *note)
{
    char text[ZR_NOTE_SIZE + 16];
    if (note->count > 1)
        snprintf(text, sizeof text, "%u\xc3\x97 %s", note->count, note->text);
    else
        snprintf(text, sizeof text, "%s", note->text);
    for (int i = 0; i < HEIGHTS; i++) {
        p->height = heights[i];
        if (place_text(p, note, text)) return true;
    }
    return false;
}

static void warn_of_unnoted(const struct zr_run *run, const struct zr_hole_notes *notes,
                            struct zr_warning_list *warnings)
{
    static const char *const whys[ZR_NO_NOTE_COUNT] = {
        [ZR_NO_NOTE_CUT_AWAY] = "cut away by the section in the view that would show it round",
        [ZR_NO_NOTE_HIDDEN] = "hidden in the view that would show it round",
        [ZR_NO_NOTE_OBLIQUE] = "round in no view",
        [ZR_NO_NOTE_BEYOND] = "beyond the first 64 kinds of holes"};
    for (int why = 0; why < ZR_NO_NOTE_COUNT; why++) {
        const struct zr_unnoted *unnoted = &notes->unnoted[why];
        if (unnoted->count == 1)
            zr_warning_list_add(run->arena, warnings, "1 hole has no note, %s: it is %s", unnoted->first, whys[why]);
        else if (unnoted->count > 1)
            zr_warning_list_add(run->arena, warnings, "%u holes have no note, the first %s: it is %s", unnoted->count,
                                unnoted->first, whys[why]);
    }
}

uint32_t zr_hole_notes_add(const struct zr_run *run, struct zr_plot *plot, const struct zr_placed_views *placed,
                           const struct zr_part_holes *holes, const struct zr_hole_notes *notes,
                           const struct zr_page_box *boxes, uint32_t box_count, struct zr_warning_list *warnings)
{
    struct placing p = {.cancel = run->cancel, .plot = plot, .placed = placed, .holes = holes};
    const double grown = 2.0;
    uint32_t noted = 0;
    for (int view = 0; view < ZR_PAGE_VIEWS; view++) {
        const struct zr_page_box box = placed->layout.views[view];
        p.boxes[p.box_count++] = (struct zr_page_box){box.x0 - grown, box.y0 - grown, box.x1 + grown, box.y1 + grown};
    }
    p.boxes[p.box_count++] = placed->page.title;
    for (uint32_t i = 0; i < box_count; i++)
        p.boxes[p.box_count++] = boxes[i];
    zr_plot_begin(plot, "notes");
    for (uint32_t i = 0; i < notes->count; i++)
        if (place_note(&p, &notes->at[i]))
            noted += notes->at[i].count;
        else
            zr_warning_list_add(run->arena, warnings, "no room for the note of %u holes, %s", notes->at[i].count,
                                notes->at[i].text);
    warn_of_unnoted(run, notes, warnings);
    return noted;
}
