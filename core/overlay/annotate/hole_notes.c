#include "overlay/annotate/hole_notes.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/cancel.h"
#include "base/trig.h"
#include "mesh/features/part_features.h"
#include "overlay/annotate/box_dimensions.h"
#include "overlay/annotate/leader_note.h"
#include "overlay/annotate/length_text.h"

enum { RIM = 36, RIM_SEEN = 12, RIM_WHOLE = 33, HOLES_TRIED = 8, HOLES_MAX = 4096, GROUPS_MAX = 64, ROUNDS = 4 };

/* Depths that agree to this share of the bounds' diagonal. */
static const double depth_share = 0.008;

/* The rim of a hole, as far as it is seen. */
struct rim {
    struct zr_point middle, at[RIM];
    bool is_seen[RIM];
    uint32_t seen;
};

struct group {
    const struct zr_hole *hole;
    char text[ZR_HOLE_TEXT_SIZE], note_text[ZR_HOLE_TEXT_SIZE + 16]; /* of one hole, and with the number */
    uint32_t count, seen;                                            /* holes, and those of them that are seen */
    uint32_t tried;
    struct rim rims[HOLES_TRIED]; /* the first ones that are seen whole, then others */
};

/* ---- texts ---- */

struct writing {
    char *at;
    size_t used;
    double largest;
};

static void add(struct writing *w, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    const int size = vsnprintf(w->at + w->used, ZR_HOLE_TEXT_SIZE - w->used, format, values);
    va_end(values);
    if (size > 0) w->used += (size_t)size;
    if (w->used >= ZR_HOLE_TEXT_SIZE) w->used = ZR_HOLE_TEXT_SIZE - 1;
}

static void add_length(struct writing *w, const char *before, double length, const char *unit)
{
    char text[ZR_LENGTH_SIZE];
    zr_length_write(length, w->largest, unit, text);
    add(w, "%s%s", before, text);
}

void zr_hole_text_write(const struct zr_hole *hole, double largest, const char *unit, char out[ZR_HOLE_TEXT_SIZE])
{
    struct writing w = {out, 0, largest};
    const bool is_round = hole->coverage >= 270.0;
    *out = '\0';
    add_length(&w, is_round ? "\xc3\xb8" : "R", is_round ? hole->diameter : 0.5 * hole->diameter, unit);
    if (hole->reach == ZR_REACH_THROUGH) add(&w, " through");
    if (hole->reach == ZR_REACH_BLIND) add_length(&w, " depth ", hole->depth, "");
    for (uint32_t i = 0; i < hole->step_count; i++) {
        add_length(&w, ", \xc3\xb8", hole->steps[i].diameter, "");
        if (hole->steps[i].angle > 0.0)
            add(&w, " \xc3\x97 %.0f\xc2\xb0", hole->steps[i].angle);
        else
            add_length(&w, " depth ", hole->steps[i].depth, "");
    }
}

/* ---- rims ---- */

/* Returns the depth of a place, as the channel has it. */
static double depth_of(const struct zr_layout *l, zr_dvec3 at)
{
    const float *m = l->frame->camera.world_to_eye.m;
    return -(((double)m[2] * at.x + (double)m[6] * at.y) + (double)m[10] * at.z + (double)m[14]);
}

/* True if one of 3 x 3 pixels shows a surface at this depth. */
static bool shows(const struct zr_layout *l, struct zr_point at, double depth, double near)
{
    const int64_t width = l->frame->width, height = l->frame->height;
    if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < l->width && at.y < l->height)) return false;
    const int64_t x = (int64_t)at.x, y = (int64_t)at.y;
    for (int64_t j = y - 1; j <= y + 1; j++)
        for (int64_t i = x - 1; i <= x + 1; i++)
            if (i >= 0 && j >= 0 && i < width && j < height && l->ids[j * width + i] != 0 &&
                fabs((double)l->frame->depth[j * width + i] - depth) <= near)
                return true;
    return false;
}

/* Finds a rim. False: it is not in front of the eye. */
static bool see_rim(const struct zr_layout *l, zr_dvec3 middle, zr_dvec3 axis, double radius, struct rim *out)
{
    const double near =
        depth_share * (double)zr_diagonal_of(&l->frame->bounds) * (double)zr_eye_scale_of(&l->frame->camera);
    const bool is_upright = fabs(axis.y) > 0.7;
    const zr_dvec3 other = {is_upright ? 1.0 : 0.0, is_upright ? 0.0 : 1.0, 0.0};
    zr_dvec3 u = zr_dvec3_cross(axis, other);
    const double length = sqrt(zr_dvec3_dot(u, u));
    u = (zr_dvec3){u.x / length, u.y / length, u.z / length};
    const zr_dvec3 v = zr_dvec3_cross(axis, u);
    out->seen = 0;
    if (!zr_layout_project(l, middle, &out->middle)) return false;
    for (int i = 0; i < RIM; i++) {
        double sine, cosine;
        zr_sine_cosine(10.0 * i, &sine, &cosine);
        const zr_dvec3 at = zr_dvec3_add_scaled(zr_dvec3_add_scaled(middle, u, radius * cosine), v, radius * sine);
        if (!zr_layout_project(l, at, &out->at[i])) return false;
        out->is_seen[i] = shows(l, out->at[i], depth_of(l, at), near);
        out->seen += out->is_seen[i];
    }
    return true;
}

/* Finds the rim at the entry, or at the other end of a hole that is through, whichever is seen better. */
static void see_hole(const struct zr_layout *l, const struct zr_hole *hole, struct rim *out)
{
    double length = hole->depth;
    struct rim far;
    for (uint32_t i = 0; i < hole->step_count; i++)
        length += hole->steps[i].depth;
    const double first = hole->step_count > 0 ? fmax(hole->steps[0].diameter, hole->diameter) : hole->diameter;
    const double last =
        hole->step_count > 0 ? fmax(hole->steps[hole->step_count - 1].diameter, hole->diameter) : hole->diameter;
    const double ends[2][2] = {{0.0, first}, {length, last}};
    out->seen = 0;
    for (int end = 0; end < (hole->reach == ZR_REACH_BLIND ? 1 : 2); end++)
        for (int wide = 0; wide < 2; wide++) {
            const double diameter = wide == 0 ? ends[end][1] : hole->diameter;
            if (wide == 1 && !(ends[end][1] > hole->diameter)) continue;
            const zr_dvec3 middle = zr_dvec3_add_scaled(hole->at, hole->axis, ends[end][0]);
            if (see_rim(l, middle, hole->axis, 0.5 * diameter, &far) && far.seen > out->seen) *out = far;
        }
}

/* ---- groups ---- */

static bool is_equal(const struct group *group, const struct zr_hole *hole, const char *text)
{
    return strcmp(group->text, text) == 0 && fabs(zr_dvec3_dot(group->hole->axis, hole->axis)) > 0.9999;
}

/* Keeps a seen rim: those that are seen whole come first. */
static void keep_rim(struct group *group, const struct rim *rim)
{
    if (rim->seen < RIM_SEEN) return;
    group->seen++;
    if (group->tried < HOLES_TRIED) {
        group->rims[group->tried++] = *rim;
        return;
    }
    if (rim->seen < RIM_WHOLE) return;
    for (uint32_t i = 0; i < group->tried; i++)
        if (group->rims[i].seen < RIM_WHOLE) {
            group->rims[i] = *rim;
            return;
        }
}

/* Lists the groups of all parts. Returns their number; `beyond` counts holes of further groups. */
static uint32_t list_groups(const struct zr_layout *l, const char *unit, struct group *groups, uint32_t *beyond)
{
    const struct zr_frame_parts *parts = &l->frame->parts;
    uint32_t count = 0, holes = 0;
    double largest;
    *beyond = 0;
    zr_box_size(l, &largest);
    for (uint32_t p = 0; p < parts->list.count && !zr_is_cancelled(l->cancel); p++) {
        const struct zr_holes *list = &parts->features[p].holes;
        if (parts->facts[p].is_hidden || parts->features[p].is_omitted) continue;
        for (uint32_t i = 0; i < list->hole_count && holes < HOLES_MAX && !zr_is_cancelled(l->cancel); i++, holes++) {
            char text[ZR_HOLE_TEXT_SIZE];
            struct rim rim;
            uint32_t g = 0;
            zr_hole_text_write(&list->holes[i], largest, unit, text);
            while (g < count && !is_equal(&groups[g], &list->holes[i], text))
                g++;
            if (g == GROUPS_MAX) {
                *beyond += 1;
                continue;
            }
            if (g == count) {
                groups[count++] = (struct group){.hole = &list->holes[i]};
                memcpy(groups[g].text, text, sizeof text);
            }
            groups[g].count++;
            see_hole(l, &list->holes[i], &rim);
            keep_rim(&groups[g], &rim);
        }
    }
    return count;
}

/* ---- places ---- */

/* Returns the point of a rim that is seen in a direction; false: none is. */
static bool find_tip(const void *context, double dx, double dy, struct zr_point *tip)
{
    const struct rim *rim = context;
    double best = 0.97; /* cosine */
    bool is_found = false;
    for (int i = 0; i < RIM; i++) {
        const double x = rim->at[i].x - rim->middle.x, y = rim->at[i].y - rim->middle.y, length = sqrt(x * x + y * y);
        if (!rim->is_seen[i] || !(length > 0.0)) continue;
        const double cosine = (x * dx + y * dy) / length;
        if (!(cosine > best)) continue;
        best = cosine;
        *tip = rim->at[i];
        is_found = true;
    }
    return is_found;
}

static void find_place(const struct zr_layout *l, const struct zr_model_map *map, const struct group *group,
                       struct zr_leader_note *best)
{
    const double width = zr_type_width(group->note_text, l->letters);
    best->cost = HUGE_VAL;
    for (int whole = 1; whole >= 0 && best->cost == HUGE_VAL; whole--)
        for (uint32_t i = 0; i < group->tried && !zr_is_cancelled(l->cancel); i++)
            if ((group->rims[i].seen >= RIM_WHOLE) == (whole == 1))
                zr_leader_note_find(l, map, find_tip, &group->rims[i], width, best);
}

/* Finds places in an order of the groups. Returns the number of those without one, and moves these to the front. */
static uint32_t find_places(struct zr_layout *l, const struct zr_model_map *map, const struct group *groups,
                            uint32_t count, uint32_t *order, struct zr_leader_note *notes)
{
    const uint32_t rects = l->rect_count, segments = l->segment_count;
    uint32_t failed = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t g = order[i];
        find_place(l, map, &groups[g], &notes[g]);
        if (notes[g].cost < HUGE_VAL)
            zr_leader_note_take(l, &notes[g]);
        else if (groups[g].seen > 0) {
            memmove(order + failed + 1, order + failed, (i - failed) * sizeof *order);
            order[failed++] = g;
        }
    }
    l->rect_count = rects;
    l->segment_count = segments;
    return failed;
}

static void draw(struct zr_layout *l, const struct zr_leader_note *note, const char *text, uint32_t color)
{
    const double length = l->letters + 2.2 * l->line;
    const double x = note->leader.from.x - note->leader.to.x, y = note->leader.from.y - note->leader.to.y;
    const double way = sqrt(x * x + y * y);
    zr_leader_note_draw(l, note, text, color);
    zr_marks_add_arrow(l->marks, note->leader.from, x / way, y / way, length, 0.19 * length,
                       zr_layout_ink(l, color, 0.0, true));
    zr_leader_note_take(l, note);
}

/* Places all groups. If some have no place, they are tried first in the next round. */
static void place_all(struct zr_layout *l, const struct zr_model_map *map, const struct group *groups, uint32_t count)
{
    uint32_t order[GROUPS_MAX], least = UINT32_MAX;
    struct zr_leader_note *notes = zr_arena_alloc(l->arena, GROUPS_MAX, sizeof *notes);
    struct zr_leader_note *best = zr_arena_alloc(l->arena, GROUPS_MAX, sizeof *best);
    if (!notes || !best) return;
    for (uint32_t i = 0; i < count; i++)
        order[i] = i;
    for (int round = 0; round < ROUNDS && least > 0 && !zr_is_cancelled(l->cancel); round++) {
        const uint32_t failed = find_places(l, map, groups, count, order, notes);
        if (failed < least) memcpy(best, notes, count * sizeof *best);
        least = failed < least ? failed : least;
    }
    for (uint32_t i = 0; i < count; i++)
        if (best[i].cost < HUGE_VAL)
            draw(l, &best[i], groups[i].note_text, l->ink);
        else
            zr_layout_leave_out(l, groups[i].note_text, groups[i].seen > 0 ? "no room" : "not seen",
                                groups[i].seen > 0 ? ZR_LEFT_OUT_NO_ROOM : ZR_LEFT_OUT_UNSEEN);
}

const char *zr_hole_note_place(struct zr_layout *l, const struct zr_model_map *map, const struct zr_hole *hole,
                               const char *text, uint32_t color)
{
    struct zr_leader_note note = {.cost = HUGE_VAL};
    struct rim rim;
    see_hole(l, hole, &rim);
    if (rim.seen < RIM_SEEN) return "not seen";
    zr_leader_note_find(l, map, find_tip, &rim, zr_type_width(text, l->letters), &note);
    if (note.cost == HUGE_VAL) return "no room";
    draw(l, &note, text, color);
    return NULL;
}

static void write_texts(struct group *groups, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (groups[i].count > 1)
            snprintf(groups[i].note_text, sizeof groups[i].note_text, "%u\xc3\x97 %s", groups[i].count, groups[i].text);
        else
            snprintf(groups[i].note_text, sizeof groups[i].note_text, "%s", groups[i].text);
}

/* Notes where holes were not searched. */
static void leave_out_unsearched(struct zr_layout *l)
{
    enum { SIZE = 128 };
    const struct zr_frame_parts *parts = &l->frame->parts;
    uint64_t count = parts->list.total - parts->list.count;
    for (uint32_t p = 0; p < parts->list.count; p++)
        count += parts->features[p].is_omitted && !parts->facts[p].is_hidden;
    char *why = zr_arena_alloc(l->arena, SIZE, 1);
    if (!why) return;
    if (count > 0) {
        snprintf(why, SIZE, "holes were not searched in %" PRIu64 " part%s too large or too many", count,
                 count == 1 ? ", which is" : "s, which are");
        zr_layout_leave_out(l, "holes", why, ZR_LEFT_OUT_NOT_SEARCHED);
    }
    if (l->scene->csg)
        zr_layout_leave_out(l, "holes", "holes were not searched in the combined solid, which has no mesh",
                            ZR_LEFT_OUT_NOT_SEARCHED);
}

void zr_hole_notes_place(struct zr_layout *l, const char *unit)
{
    struct zr_model_map map;
    uint32_t beyond;
    if (!l->frame->parts.features) return;
    leave_out_unsearched(l);
    if (!l->frame->depth || !zr_model_map_make(l, &map)) return;
    struct group *groups = zr_arena_alloc(l->arena, GROUPS_MAX, sizeof *groups);
    if (!groups) return;
    const uint32_t count = list_groups(l, unit, groups, &beyond);
    write_texts(groups, count);
    place_all(l, &map, groups, count);
    if (beyond > 0) zr_layout_leave_out(l, "more holes", "more than 64 kinds of holes", ZR_LEFT_OUT_NO_ROOM);
}
