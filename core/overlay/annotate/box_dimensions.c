#include "overlay/annotate/box_dimensions.h"

#include <math.h>
#include <stdio.h>

#include "overlay/annotate/dimension_line.h"
#include "overlay/annotate/length_text.h"

/* Edge e of the box runs along axis e / 4; bits 0 and 1 of e are the ends along the other two axes. */
enum { EDGES = 12, CANDIDATES = 8 };

static const char *const axis_names[] = {"x", "y", "z"};

struct box {
    double ends[3][2];      /* world space, by axis */
    bool faces[3][2];       /* the side looks to the eye */
    struct zr_point at[8];  /* corners; bit a: the end along axis a */
    bool is_seen[8];        /* the corner is in front of the eye */
    bool is_used[8];        /* a dimension begins there */
    struct zr_point middle; /* of all corners */
    double half_x, half_y;
};

/* Ways to draw a dimension; a larger score is better. */
struct candidate {
    struct zr_dimension_line line;
    int edge, axis; /* the line is moved along the axis */
    double step;    /* length in the world that is a pixel, with the sign of the side */
    double score;
};

static double of_axis(zr_dvec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static zr_dvec3 place_of(const struct box *box, int corner)
{
    return (zr_dvec3){box->ends[0][corner & 1], box->ends[1][corner >> 1 & 1], box->ends[2][corner >> 2]};
}

/* Returns the corners of an edge. */
static void corners_of(int edge, int out[2])
{
    const int axis = edge / 4, b = (axis + 1) % 3, c = (axis + 2) % 3;
    out[0] = (edge & 1) << b | (edge >> 1 & 1) << c;
    out[1] = out[0] | 1 << axis;
}

/* Edges between a side that looks to the eye and one that does not. */
static bool is_outline(const struct box *box, int edge)
{
    const int axis = edge / 4, b = (axis + 1) % 3, c = (axis + 2) % 3;
    return box->faces[b][edge & 1] != box->faces[c][edge >> 1 & 1];
}

static bool looks_to_eye(const struct zr_layout *l, const struct box *box, int axis, int end)
{
    const double sign = end ? 1.0 : -1.0;
    if (l->eye[3] == 0.0) return sign * l->eye[axis] > 1e-6;
    return sign * (l->eye[axis] / l->eye[3] - box->ends[axis][end]) > 0.0;
}

static bool open_box(const struct zr_layout *l, struct box *box)
{
    const struct zr_bounds *bounds = &l->frame->bounds;
    const zr_dvec3 min = zr_dvec3_of(bounds->min), max = zr_dvec3_of(bounds->max);
    double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL;
    *box = (struct box){.middle = {0, 0}};
    for (int a = 0; a < 3; a++) {
        box->ends[a][0] = of_axis(min, a);
        box->ends[a][1] = of_axis(max, a);
        for (int end = 0; end < 2; end++)
            box->faces[a][end] = looks_to_eye(l, box, a, end);
    }
    for (int i = 0; i < 8; i++) {
        box->is_seen[i] = zr_layout_project(l, place_of(box, i), &box->at[i]);
        if (!box->is_seen[i]) return false;
        x0 = fmin(x0, box->at[i].x);
        x1 = fmax(x1, box->at[i].x);
        y0 = fmin(y0, box->at[i].y);
        y1 = fmax(y1, box->at[i].y);
    }
    box->middle = (struct zr_point){0.5 * (x0 + x1), 0.5 * (y0 + y1)};
    box->half_x = fmax(0.5 * (x1 - x0), 1.0);
    box->half_y = fmax(0.5 * (y1 - y0), 1.0);
    return true;
}

/* Returns the place moved along an axis. */
static zr_dvec3 along(zr_dvec3 p, int axis, double by)
{
    if (axis == 0) p.x += by;
    if (axis == 1) p.y += by;
    if (axis == 2) p.z += by;
    return p;
}

/* Finds the unit vector on the window in which the box's side `axis`, `end` leads away from an edge, and the length of
 * a pixel. False: it leads to the eye. */
static bool find_way(const struct zr_layout *l, const struct box *box, int edge, int axis, int end,
                     struct candidate *way)
{
    int corners[2];
    struct zr_point a, b;
    corners_of(edge, corners);
    const zr_dvec3 p = place_of(box, corners[0]), q = place_of(box, corners[1]);
    const zr_dvec3 middle = {0.5 * (p.x + q.x), 0.5 * (p.y + q.y), 0.5 * (p.z + q.z)};
    const double step = 0.02 * (double)zr_diagonal_of(&l->frame->bounds) * (end ? 1.0 : -1.0);
    if (!zr_layout_project(l, middle, &a) || !zr_layout_project(l, along(middle, axis, step), &b)) return false;
    const double x = b.x - a.x, y = b.y - a.y, length = sqrt(x * x + y * y);
    if (!(length > 1e-3)) return false;
    way->axis = axis;
    way->step = step / length;
    way->line.dx = x / length;
    way->line.dy = y / length;
    return true;
}

/* Sets the ends of the line, at a distance from the box in pixels. False: they are behind the eye. */
static bool set_tips(const struct zr_layout *l, const struct box *box, struct candidate *way, double distance)
{
    int corners[2];
    corners_of(way->edge, corners);
    for (int i = 0; i < 2; i++) {
        const zr_dvec3 tip = along(place_of(box, corners[i]), way->axis, way->step * distance);
        if (!zr_layout_project(l, tip, &way->line.tips[i])) return false;
    }
    return true;
}

/* Adds the ways to draw a dimension at an outline edge. */
static int add_ways(const struct zr_layout *l, const struct box *box, int edge, const char *text, struct candidate *out,
                    int count)
{
    int corners[2];
    corners_of(edge, corners);
    const struct zr_point p = box->at[corners[0]], q = box->at[corners[1]];
    const double x = q.x - p.x, y = q.y - p.y, length = sqrt(x * x + y * y);
    if (!(length > 2.0 * l->line)) return count;
    const double mx = 0.5 * (p.x + q.x) - box->middle.x, my = 0.5 * (p.y + q.y) - box->middle.y;
    double nx = -y / length, ny = x / length;
    if (nx * mx + ny * my < 0.0) {
        nx = -nx;
        ny = -ny;
    }
    const double low = my / box->half_y, right = mx / box->half_x;
    const bool is_vertical = fabs(y) > 1.2 * fabs(x);
    /* labels are right of the model: leaders would cross an upright line there */
    const double upright = zr_annotate_has(&l->frame->view->annotate, ZR_ANNOTATE_LABELS) ? -right : right;
    const double place = is_vertical ? 0.55 * upright + 0.2 * low : 0.6 * low + 0.1 * right;
    for (int k = 1; k < 3; k++) {
        const int axis = (edge / 4 + k) % 3, end = k == 1 ? edge & 1 : edge >> 1 & 1;
        struct candidate way = {.line = {.from = p, .to = q, .text = text}, .edge = edge};
        if (!find_way(l, box, edge, axis, end, &way)) continue;
        const double share = way.line.dx * nx + way.line.dy * ny;
        if (share < 0.3) continue;
        way.score = share + place;
        out[count++] = way;
    }
    return count;
}

/* Returns the number of the best way that is left, the first one of equal ones; -1: none. */
static int best_of(const struct candidate *ways, int count)
{
    int best = -1;
    for (int i = 0; i < count; i++)
        if (ways[i].score > -HUGE_VAL && (best < 0 || ways[i].score > ways[best].score + 1e-9)) best = i;
    return best;
}

/* Draws the dimension along an axis of the world; false: no way is free. */
static bool place_axis(struct zr_layout *l, struct box *box, int axis, const char *text, bool *has_way)
{
    static const double farther[] = {1.0, 1.6, 2.4};
    const double offset = fmax(2.6 * l->letters, 0.055 * fmin(l->width, l->height));
    struct candidate ways[2 * CANDIDATES];
    int count = 0;
    for (int edge = 4 * axis; edge < 4 * axis + 4; edge++)
        if (is_outline(box, edge)) count = add_ways(l, box, edge, text, ways, count);
    *has_way = count > 0;
    for (int best = best_of(ways, count); best >= 0; best = best_of(ways, count)) {
        for (size_t i = 0; i < sizeof farther / sizeof *farther; i++) {
            int corners[2];
            if (!set_tips(l, box, &ways[best], offset * farther[i])) continue;
            if (!zr_dimension_line_place(l, &ways[best].line)) continue;
            corners_of(ways[best].edge, corners);
            box->is_used[corners[0]] = box->is_used[corners[1]] = true;
            return true;
        }
        ways[best].score = -HUGE_VAL;
    }
    return false;
}

/* ---- lines from corners to the model ---- */

static bool is_covered(const struct zr_layout *l, double x, double y)
{
    if (!l->ids || !(x >= 0.0 && y >= 0.0 && x < l->width && y < l->height)) return false;
    return l->ids[(size_t)y * l->frame->width + (size_t)x] != 0;
}

/* True if the model has a pixel within a height of capitals of the corner. */
static bool is_near_model(const struct zr_layout *l, struct zr_point p)
{
    const double h = l->letters;
    for (double y = -h; y <= h; y += 1.0)
        for (double x = -h; x <= h; x += 1.0)
            if (x * x + y * y <= h * h && is_covered(l, p.x + x, p.y + y)) return true;
    return false;
}

/* Draws a thin line from one corner towards another one, up to the model. Without a model between them, it is drawn if
 * `is_whole` allows that. */
static void lead(struct zr_layout *l, struct zr_point from, struct zr_point to, bool is_whole)
{
    const double x = to.x - from.x, y = to.y - from.y, length = sqrt(x * x + y * y);
    const int steps = (int)fmin(length, 1e5);
    int last = 0;
    for (; last < steps; last++)
        if (is_covered(l, from.x + x * last / steps, from.y + y * last / steps)) break;
    if (last < 2 || (last == steps && !is_whole)) return;
    const struct zr_segment line = {from, {from.x + x * last / steps, from.y + y * last / steps}};
    for (uint32_t i = 0; i < l->rect_count; i++)
        if (zr_layout_line_meets(line, l->rects[i])) return;
    zr_layout_draw(l, line, l->dimension, 0.4, false);
    zr_layout_take_line(l, line);
}

static void lead_corners(struct zr_layout *l, const struct box *box)
{
    bool is_far[8];
    for (int i = 0; i < 8; i++)
        is_far[i] = box->is_used[i] && l->ids && !is_near_model(l, box->at[i]);
    for (int edge = 0; edge < EDGES; edge++) {
        int ends[2];
        corners_of(edge, ends);
        if (!is_outline(box, edge)) continue;
        const bool is_whole = box->is_used[ends[0]] && box->is_used[ends[1]];
        if (is_far[ends[0]]) lead(l, box->at[ends[0]], box->at[ends[1]], is_whole);
        if (is_far[ends[1]]) lead(l, box->at[ends[1]], box->at[ends[0]], is_whole && !is_far[ends[0]]);
    }
}

zr_dvec3 zr_box_size(const struct zr_layout *layout, double *largest)
{
    const struct zr_bounds *bounds = &layout->frame->bounds;
    const zr_dvec3 size = zr_dvec3_sub(zr_dvec3_of(bounds->max), zr_dvec3_of(bounds->min));
    double of_file[3];
    for (int a = 0; a < 3; a++)
        of_file[a] = fabs(zr_dvec3_dot(layout->axes[a], size));
    *largest = fmax(of_file[0], fmax(of_file[1], of_file[2]));
    return (zr_dvec3){of_file[0], of_file[1], of_file[2]};
}

/* Returns the axis of the file that lies along an axis of the world. */
static int axis_of_file(const struct zr_layout *layout, int axis)
{
    for (int a = 0; a < 3; a++)
        if (fabs(of_axis(layout->axes[a], axis)) > 0.5) return a;
    return axis;
}

void zr_box_dimensions_place(struct zr_layout *layout, const char *unit)
{
    static const int order[] = {0, 2, 1}; /* the upright one last: it has the most ways */
    struct box box;
    double largest;
    const zr_dvec3 size = zr_box_size(layout, &largest);
    const bool is_seen = open_box(layout, &box);
    for (int i = 0; i < 3; i++) {
        const int axis = axis_of_file(layout, order[i]);
        char what[32], *text = zr_arena_alloc(layout->arena, ZR_LENGTH_SIZE, 1);
        bool has_way = false;
        if (!text) return;
        snprintf(what, sizeof what, "dimension %s", axis_names[axis]);
        zr_length_write(of_axis(size, axis), largest, unit, text);
        if (!is_seen)
            zr_layout_leave_out(layout, what, "behind the eye", ZR_LEFT_OUT_BY_VIEW);
        else if (!place_axis(layout, &box, order[i], text, &has_way))
            zr_layout_leave_out(layout, what, has_way ? "no room" : "along the view",
                                has_way ? ZR_LEFT_OUT_NO_ROOM : ZR_LEFT_OUT_UNSEEN);
    }
    if (is_seen) lead_corners(layout, &box);
}
