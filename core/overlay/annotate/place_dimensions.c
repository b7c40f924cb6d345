#include "overlay/annotate/place_dimensions.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "mesh/features/part_features.h"
#include "overlay/annotate/dimension_line.h"
#include "overlay/annotate/length_text.h"
#include "overlay/annotate/round_dimension.h"

/* Distance of rows in heights of capitals; rows that are tried on each side. */
static const double row = 2.6;
enum { ROWS = 10, RANKS = 3 };

/* A dimension with its ends on the window; `foot`: the second end of the line. */
struct given {
    uint32_t number;
    struct zr_point from, to, foot;
    double pixels, length;
    const char *text;
    bool is_drawn;
    const char *why; /* it is left out; NULL: it is not yet */
    int kind;        /* enum zr_dimension_kind */
    zr_dvec3 ends[3];
    const struct zr_hole *hole; /* of a radius or diameter */
};

/* Returns the number of a picked end in frame->ends. */
static uint32_t pick_number(const struct zr_layout *l, const struct zr_dimension_end *end)
{
    const struct zr_annotate *annotate = &l->frame->view->annotate;
    uint32_t number = 0;
    for (uint32_t i = 0; i < annotate->dimension_count; i++) {
        const struct zr_dimension *d = &annotate->dimensions[i];
        const struct zr_dimension_end *const ends[] = {&d->from, &d->to, &d->at};
        for (int k = 0; k < 3; k++) {
            if (ends[k] == end) return number;
            number += ends[k]->is_pick;
        }
    }
    return number;
}

/* Returns the hole of an end, or NULL if there is none: *why then says so. */
static const struct zr_hole *hole_of(const struct zr_layout *l, const struct zr_dimension_end *end, const char **why)
{
    static const char no_search[] = "holes were not searched in this part, which is too large";
    const struct zr_frame_parts *parts = &l->frame->parts;
    bool is_searched = parts->list.count == parts->list.total;
    *why = end->part ? "no part has this name" : "no such hole";
    for (uint32_t p = 0; p < parts->list.count && parts->features; p++) {
        const struct zr_holes *holes = &parts->features[p].holes;
        const bool is_omitted = parts->features[p].is_omitted || holes->hole_count == 0;
        is_searched = is_searched && !parts->features[p].is_omitted;
        if (end->part ? strcmp(end->part, parts->list.at[p].name) != 0 : is_omitted) continue;
        *why = parts->features[p].is_omitted ? no_search : "no such hole";
        uint32_t group = 0, index = 0;
        for (uint32_t i = 0; i < holes->hole_count && !is_omitted; i++) {
            if (holes->holes[i].group != i) continue;
            if (group++ != end->hole) continue;
            for (uint32_t k = i; k < holes->hole_count; k++)
                if (holes->holes[k].group == i && index++ == end->index) return &holes->holes[k];
            *why = "the group has fewer holes than index says";
        }
        return NULL;
    }
    if (!end->part && !is_searched) *why = "no part with holes was found, and some were not searched";
    return NULL;
}

/* Finds an end in world space. Returns why it is not there, or NULL. */
static const char *find_end(const struct zr_layout *l, const struct zr_dimension_end *end, zr_dvec3 *out)
{
    if (end->is_hole) {
        const char *why;
        const struct zr_hole *hole = hole_of(l, end, &why);
        if (!hole) return why;
        *out = hole->at;
    } else if (end->is_pick) {
        const uint32_t number = pick_number(l, end);
        const struct zr_pick *pick = number < l->frame->ends.count ? &l->frame->ends.at[number] : NULL;
        if (!pick || !pick->is_hit) return "nothing is at the pixel";
        *out = (zr_dvec3){pick->at.point[0], pick->at.point[1], pick->at.point[2]};
    } else {
        *out = zr_layout_world(l, end->place);
    }
    return NULL;
}

static struct given measure(const struct zr_layout *l, uint32_t number)
{
    const struct zr_dimension *d = &l->frame->view->annotate.dimensions[number];
    struct given given = {.number = number, .kind = d->kind};
    given.why = find_end(l, &d->from, &given.ends[0]);
    if (!given.why && d->has_to) given.why = find_end(l, &d->to, &given.ends[1]);
    if (!given.why && d->has_at) given.why = find_end(l, &d->at, &given.ends[2]);
    const char *none;
    if (!d->has_to) given.hole = given.why ? NULL : hole_of(l, &d->from, &none);
    given.text = d->label;
    if (given.why || given.hole || d->kind == ZR_DIMENSION_ANGLE) return given;
    const zr_dvec3 from = given.ends[0], to = given.ends[1], way = zr_dvec3_sub(to, from);
    given.length = sqrt(zr_dvec3_dot(way, way));
    zr_dvec3 foot = to;
    if (d->along >= 0) {
        const double along = zr_dvec3_dot(way, l->axes[d->along]);
        foot = zr_dvec3_add_scaled(from, l->axes[d->along], along);
        given.length = fabs(along);
    }
    const bool is_seen = zr_layout_project(l, from, &given.from) && zr_layout_project(l, to, &given.to) &&
                         zr_layout_project(l, foot, &given.foot);
    if (!is_seen) given.why = "behind the eye";
    if (!(given.length > 0.0)) given.why = "it has no length";
    const double x = given.foot.x - given.from.x, y = given.foot.y - given.from.y;
    given.pixels = sqrt(x * x + y * y);
    return given;
}

/* Returns how far the bounds reach from a point in a direction of the window. */
static double reach_of(const struct zr_layout *l, struct zr_point from, double nx, double ny)
{
    const zr_vec3 ends[2] = {l->frame->bounds.min, l->frame->bounds.max};
    double most = 0.0;
    for (int i = 0; i < 8; i++) {
        struct zr_point at;
        const zr_dvec3 corner = {(double)ends[i & 1].x, (double)ends[i >> 1 & 1].y, (double)ends[i >> 2].z};
        if (zr_layout_project(l, corner, &at)) most = fmax(most, (at.x - from.x) * nx + (at.y - from.y) * ny);
    }
    return most;
}

/* Half the size of a cross in heights of capitals. */
static const double cross_size = 0.35;

/* Draws a small cross. */
static void draw_cross(struct zr_layout *l, struct zr_point at)
{
    const double r = cross_size * l->letters;
    zr_layout_draw(l, (struct zr_segment){{at.x - r, at.y}, {at.x + r, at.y}}, l->dimension, 0.7, true);
    zr_layout_draw(l, (struct zr_segment){{at.x, at.y - r}, {at.x, at.y + r}}, l->dimension, 0.7, true);
}

/* Keeps leaders, which are placed later, off a cross. Extension lines begin at it. */
static void take_cross(struct zr_layout *l, struct zr_point at)
{
    const double r = cross_size * l->letters;
    zr_layout_take_line(l, (struct zr_segment){{at.x - r, at.y}, {at.x + r, at.y}});
    zr_layout_take_line(l, (struct zr_segment){{at.x, at.y - r}, {at.x, at.y + r}});
}

/* Draws the dimension in the nearest free row, on the side that needs the shorter way first. Rows begin beyond the
 * bounds; with another room at the ends. */
static bool place(struct zr_layout *l, const struct given *given, enum zr_line_room room)
{
    const double x = given->foot.x - given->from.x, y = given->foot.y - given->from.y;
    if (!(given->pixels > 2.0 * l->line)) return false;
    double nx = -y / given->pixels, ny = x / given->pixels;
    if (ny < 0.0 || (ny == 0.0 && nx < 0.0)) { /* first below, or to the right */
        nx = -nx;
        ny = -ny;
    }
    const double below = reach_of(l, given->from, nx, ny), above = reach_of(l, given->from, -nx, -ny);
    const double first = above < below - l->letters ? -1.0 : 1.0;
    for (int i = 1; i <= ROWS; i++)
        for (int side = 0; side < 2; side++) {
            const double sign = side == 0 ? first : -first;
            const double offset = (room != ZR_ROOM_BESIDE ? 0.0 : sign > 0.0 ? below : above) + row * l->letters * i;
            const double mx = sign * nx * offset, my = sign * ny * offset;
            const struct zr_dimension_line line = {
                .from = given->from,
                .to = given->foot,
                .tips = {{given->from.x + mx, given->from.y + my}, {given->foot.x + mx, given->foot.y + my}},
                .dx = sign * nx,
                .dy = sign * ny,
                .text = given->text,
                .is_over_model = true,
                .room = room};
            if (zr_dimension_line_place(l, &line)) return true;
        }
    return false;
}

/* Draws a length with its crosses. Returns why it has no place, or NULL. */
static const char *draw_length(struct zr_layout *l, struct given *given)
{
    bool is_placed = false;
    for (int room = 0; room < ZR_ROOM_COUNT && !is_placed; room++)
        is_placed = place(l, given, (enum zr_line_room)room);
    if (!is_placed) return given->pixels > 2.0 * l->line ? "no room" : "along the view";
    draw_cross(l, given->from);
    draw_cross(l, given->to);
    given->is_drawn = true;
    const bool is_moved = given->foot.x != given->to.x || given->foot.y != given->to.y;
    if (is_moved) zr_layout_draw(l, (struct zr_segment){given->to, given->foot}, l->dimension, 0.4, true);
    return NULL;
}

static void take_length(struct zr_layout *l, const struct given *given)
{
    take_cross(l, given->from);
    take_cross(l, given->to);
    if (given->foot.x != given->to.x || given->foot.y != given->to.y)
        zr_layout_take_line(l, (struct zr_segment){given->to, given->foot});
}

/* Returns the dimensions, sorted by their length in pixels. *largest: of their lengths. */
static struct given *measure_all(struct zr_layout *l, uint32_t count, double *largest)
{
    struct given *all = zr_arena_alloc(l->arena, count ? count : 1, sizeof *all);
    *largest = 0.0;
    for (uint32_t i = 0; all && i < count; i++) {
        const struct given given = measure(l, i);
        uint32_t k = i;
        for (; k > 0 && all[k - 1].pixels > given.pixels; k--)
            all[k] = all[k - 1];
        all[k] = given;
        *largest = fmax(*largest, given.length);
    }
    return all;
}

/* Leaves out a dimension. It is a mistake of the caller if the reason is not one of the picture. */
static void leave_out(struct zr_layout *l, const struct given *given, const char *why)
{
    static const char *const by_view[] = {"behind the eye", "along the view", "not seen"};
    char what[32];
    enum zr_left_out_cause cause = ZR_LEFT_OUT_MISTAKE;
    if (strcmp(why, "no room") == 0 || strcmp(why, "no memory") == 0) cause = ZR_LEFT_OUT_NO_ROOM;
    for (size_t i = 0; i < sizeof by_view / sizeof *by_view; i++)
        if (strcmp(why, by_view[i]) == 0) cause = ZR_LEFT_OUT_BY_VIEW;
    snprintf(what, sizeof what, "dimensions/%u", given->number);
    zr_layout_leave_out(l, what, why, cause);
}

/* Angles, then circles, then holes. */
static int rank_of(const struct given *given)
{
    return given->kind == ZR_DIMENSION_ANGLE ? 0 : given->hole ? 2 : 1;
}

void zr_place_dimensions_place(struct zr_layout *l, const char *unit)
{
    const uint32_t count = l->frame->view->annotate.dimension_count;
    double largest;
    struct zr_model_map map;
    struct given *all = measure_all(l, count, &largest);
    bool has_others = false;
    for (uint32_t i = 0; all && i < count; i++) {
        char *text = zr_arena_alloc(l->arena, ZR_LENGTH_SIZE, 1);
        if (!text) return;
        has_others = has_others || all[i].kind != ZR_DIMENSION_LENGTH;
        if (all[i].kind != ZR_DIMENSION_LENGTH && !all[i].why) continue;
        zr_length_write(all[i].length, largest, unit, text);
        if (!all[i].text) all[i].text = text;
        const char *why = all[i].why ? all[i].why : draw_length(l, &all[i]);
        if (why) leave_out(l, &all[i], why);
    }
    for (uint32_t i = 0; all && i < count; i++)
        if (all[i].is_drawn) take_length(l, &all[i]);
    if (!all || !has_others || !zr_model_map_make(l, &map)) return;
    for (int rank = 0; rank < RANKS; rank++) /* those with the most lines of their own first */
        for (uint32_t i = 0; i < count; i++) {
            if (all[i].kind == ZR_DIMENSION_LENGTH || all[i].why || rank_of(&all[i]) != rank) continue;
            const struct zr_round_dimension round = {
                all[i].kind, {all[i].ends[0], all[i].ends[1], all[i].ends[2]}, all[i].hole, all[i].text};
            const char *why = zr_round_dimension_place(l, &map, &round, unit);
            if (why) leave_out(l, &all[i], why);
        }
}
