#include "overlay/annotate/place_dimensions.h"

#include <math.h>
#include <stdio.h>

#include "overlay/annotate/dimension_line.h"
#include "overlay/annotate/length_text.h"

/* Distance of rows in heights of capitals; rows that are tried on each side. */
static const double row = 2.6;
enum { ROWS = 10 };

/* A dimension with its ends on the window; `foot`: the second end of the line. */
struct given {
    uint32_t number;
    struct zr_point from, to, foot;
    double pixels, length;
    const char *text;
    bool is_seen, is_drawn;
};

static struct given measure(const struct zr_layout *l, uint32_t number)
{
    const struct zr_dimension *d = &l->frame->view->annotate.dimensions[number];
    const zr_dvec3 from = zr_layout_world(l, d->from), to = zr_layout_world(l, d->to), way = zr_dvec3_sub(to, from);
    struct given given = {.number = number, .length = sqrt(zr_dvec3_dot(way, way))};
    zr_dvec3 foot = to;
    if (d->along >= 0) {
        const double along = zr_dvec3_dot(way, l->axes[d->along]);
        foot = zr_dvec3_add_scaled(from, l->axes[d->along], along);
        given.length = fabs(along);
    }
    given.is_seen = zr_layout_project(l, from, &given.from) && zr_layout_project(l, to, &given.to) &&
                    zr_layout_project(l, foot, &given.foot);
    const double x = given.foot.x - given.from.x, y = given.foot.y - given.from.y;
    given.pixels = sqrt(x * x + y * y);
    given.text = d->label;
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

/* Draws the dimension in the nearest free row, on the side that needs the shorter way first. */
static bool place(struct zr_layout *l, const struct given *given)
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
            const double offset = (sign > 0.0 ? below : above) + row * l->letters * i;
            const double mx = sign * nx * offset, my = sign * ny * offset;
            const struct zr_dimension_line line = {
                .from = given->from,
                .to = given->foot,
                .tips = {{given->from.x + mx, given->from.y + my}, {given->foot.x + mx, given->foot.y + my}},
                .dx = sign * nx,
                .dy = sign * ny,
                .text = given->text,
                .is_over_model = true};
            if (zr_dimension_line_place(l, &line)) return true;
        }
    return false;
}

void zr_place_dimensions_place(struct zr_layout *l, const char *unit)
{
    const uint32_t count = l->frame->view->annotate.dimension_count;
    struct given *all = zr_arena_alloc(l->arena, count ? count : 1, sizeof *all);
    double largest = 0.0;
    if (!all) return;
    for (uint32_t i = 0; i < count; i++) { /* sorted by length in pixels */
        const struct given given = measure(l, i);
        uint32_t k = i;
        for (; k > 0 && all[k - 1].pixels > given.pixels; k--)
            all[k] = all[k - 1];
        all[k] = given;
        largest = fmax(largest, given.length);
    }
    for (uint32_t i = 0; i < count; i++) {
        char what[32];
        char *text = zr_arena_alloc(l->arena, ZR_LENGTH_SIZE, 1);
        if (!text) return;
        zr_length_write(all[i].length, largest, unit, text);
        if (!all[i].text) all[i].text = text;
        snprintf(what, sizeof what, "dimensions/%u", all[i].number);
        if (!all[i].is_seen) {
            zr_layout_leave_out(l, what, "behind the eye");
            continue;
        }
        if (!place(l, &all[i])) {
            zr_layout_leave_out(l, what, all[i].pixels > 2.0 * l->line ? "no room" : "along the view");
            continue;
        }
        draw_cross(l, all[i].from);
        draw_cross(l, all[i].to);
        const bool is_moved = all[i].foot.x != all[i].to.x || all[i].foot.y != all[i].to.y;
        all[i].is_drawn = true;
        if (is_moved) zr_layout_draw(l, (struct zr_segment){all[i].to, all[i].foot}, l->dimension, 0.4, true);
    }
    for (uint32_t i = 0; i < count; i++) {
        if (!all[i].is_drawn) continue;
        take_cross(l, all[i].from);
        take_cross(l, all[i].to);
        if (all[i].foot.x != all[i].to.x || all[i].foot.y != all[i].to.y)
            zr_layout_take_line(l, (struct zr_segment){all[i].to, all[i].foot});
    }
}
