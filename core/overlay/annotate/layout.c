#include "overlay/annotate/layout.h"

#include <math.h>
#include <string.h>

#include "base/cancel.h"

zr_dvec3 zr_layout_world(const struct zr_layout *l, zr_vec3 place)
{
    const zr_dvec3 p = zr_dvec3_of(place);
    const double *origin = l->scene->adds_origin ? NULL : l->scene->origin;
    if (!l->scene->file.up) return p;
    const zr_dvec3 near = origin ? (zr_dvec3){p.x - origin[0], p.y - origin[1], p.z - origin[2]} : p;
    zr_dvec3 sum = {0.0, 0.0, 0.0};
    sum = zr_dvec3_add_scaled(sum, l->axes[0], near.x);
    sum = zr_dvec3_add_scaled(sum, l->axes[1], near.y);
    return zr_dvec3_add_scaled(sum, l->axes[2], near.z);
}

bool zr_layout_project(const struct zr_layout *layout, zr_dvec3 place, struct zr_point *out)
{
    const double from[4] = {place.x, place.y, place.z, 1.0};
    double clip[4];
    zr_matrix_apply(&layout->to_clip, from, clip);
    if (!(clip[3] > 1e-30)) return false;
    out->x = (clip[0] / clip[3] + 1.0) * 0.5 * layout->width;
    out->y = (1.0 - clip[1] / clip[3]) * 0.5 * layout->height;
    return fabs(out->x) < 1e6 && fabs(out->y) < 1e6;
}

struct zr_rect zr_layout_text_rect(double x, double y, double width, double height, double by)
{
    const double pen = 0.5 * zr_type_pen(height);
    return (struct zr_rect){x - pen - by, y - height - pen - by, x + width + pen + by, y + 0.3 * height + pen + by};
}

bool zr_layout_is_inside(const struct zr_layout *layout, struct zr_rect rect)
{
    return rect.x0 >= 1.0 && rect.y0 >= 1.0 && rect.x1 <= layout->width - 1.0 && rect.y1 <= layout->height - 1.0;
}

bool zr_layout_is_background(const struct zr_layout *layout, struct zr_rect rect)
{
    if (!layout->ids) return true;
    const int64_t x0 = (int64_t)fmax(floor(rect.x0), 0.0), x1 = (int64_t)fmin(ceil(rect.x1), layout->width);
    const int64_t y0 = (int64_t)fmax(floor(rect.y0), 0.0), y1 = (int64_t)fmin(ceil(rect.y1), layout->height);
    for (int64_t y = y0; y < y1 && !zr_is_cancelled(layout->cancel); y++)
        for (int64_t x = x0; x < x1; x++)
            if (layout->ids[y * (int64_t)layout->frame->width + x] != 0) return false;
    return true;
}

static bool overlap(struct zr_rect a, struct zr_rect b)
{
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

/* Narrows the range [*low, *high] of a line's parameter to where from + t step lies between min and max. */
static bool narrow(double from, double step, double min, double max, double *low, double *high)
{
    if (fabs(step) < 1e-12) return from >= min && from <= max;
    const double a = (min - from) / step, b = (max - from) / step;
    *low = fmax(*low, fmin(a, b));
    *high = fmin(*high, fmax(a, b));
    return *low <= *high;
}

bool zr_layout_line_meets(struct zr_segment line, struct zr_rect rect)
{
    double low = 0.0, high = 1.0;
    return narrow(line.from.x, line.to.x - line.from.x, rect.x0, rect.x1, &low, &high) &&
           narrow(line.from.y, line.to.y - line.from.y, rect.y0, rect.y1, &low, &high);
}

/* Returns twice the signed area of a triangle. */
static double area(struct zr_point a, struct zr_point b, struct zr_point c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static double length_of(struct zr_segment s)
{
    const double x = s.to.x - s.from.x, y = s.to.y - s.from.y;
    return sqrt(x * x + y * y);
}

/* Lines that are one upon another, or meet at an end within a third of a pixel, do not cross. */
static bool cross(struct zr_segment a, struct zr_segment b)
{
    const double by_a = 0.3 * length_of(a), by_b = 0.3 * length_of(b);
    const double c = area(a.from, a.to, b.from), d = area(a.from, a.to, b.to);
    const double e = area(b.from, b.to, a.from), f = area(b.from, b.to, a.to);
    return ((c > by_a && d < -by_a) || (c < -by_a && d > by_a)) && ((e > by_b && f < -by_b) || (e < -by_b && f > by_b));
}

bool zr_layout_is_apart(const struct zr_layout *layout, struct zr_rect rect)
{
    for (uint32_t i = 0; i < layout->rect_count; i++)
        if (overlap(layout->rects[i], rect)) return false;
    for (uint32_t i = 0; i < layout->segment_count; i++)
        if (zr_layout_line_meets(layout->segments[i], rect)) return false;
    return true;
}

bool zr_layout_is_line_off_rects(const struct zr_layout *layout, struct zr_segment line)
{
    const struct zr_rect box = {fmin(line.from.x, line.to.x), fmin(line.from.y, line.to.y),
                                fmax(line.from.x, line.to.x), fmax(line.from.y, line.to.y)};
    if (!zr_layout_is_inside(layout, box)) return false;
    for (uint32_t i = 0; i < layout->rect_count; i++)
        if (zr_layout_line_meets(line, layout->rects[i])) return false;
    return true;
}

bool zr_layout_is_line_free(const struct zr_layout *layout, struct zr_segment line)
{
    if (!zr_layout_is_line_off_rects(layout, line)) return false;
    for (uint32_t i = 0; i < layout->segment_count; i++)
        if (cross(layout->segments[i], line)) return false;
    return true;
}

void zr_layout_take_rect(struct zr_layout *layout, struct zr_rect rect)
{
    if (layout->rect_count < ZR_LAYOUT_RECTS) layout->rects[layout->rect_count++] = rect;
}

void zr_layout_take_line(struct zr_layout *layout, struct zr_segment line)
{
    if (layout->segment_count < ZR_LAYOUT_SEGMENTS) layout->segments[layout->segment_count++] = line;
}

void zr_layout_leave_out(struct zr_layout *layout, const char *what, const char *why, enum zr_left_out_cause cause)
{
    layout->causes[cause]++;
    if (layout->left_out_count == ZR_LEFT_OUT_MAX) return;
    const char *copy = zr_arena_copy(layout->arena, what, strlen(what) + 1);
    if (copy) layout->left_out[layout->left_out_count++] = (struct zr_left_out){copy, why, cause};
}

struct zr_ink zr_layout_ink(const struct zr_layout *layout, uint32_t color, double lines, bool has_halo)
{
    return (struct zr_ink){color, layout->paper, lines * layout->line, has_halo ? 1.6 * layout->line : 0.0};
}

/* Returns the median colour behind a text: backgrounds may be gradients. */
static uint32_t paper_around(const struct zr_layout *layout, double x, double y, double width, double height)
{
    const struct zr_frame *frame = layout->frame;
    const struct zr_canvas canvas = {(uint32_t *)(void *)frame->color, (int32_t)frame->width, (int32_t)frame->height};
    return zr_canvas_median(
        &canvas, (struct zr_box){(int32_t)x, (int32_t)(y - height), 1 + (int32_t)width, 1 + (int32_t)height});
}

void zr_layout_write(struct zr_layout *layout, const char *text, double x, double y, double height, uint32_t color,
                     bool has_halo)
{
    const struct zr_type_place place = {floor(x + 0.5) + 0.5, floor(y + 0.5) - 0.5, height, 1.0, 0.0};
    struct zr_ink ink = zr_layout_ink(layout, color, 0.0, has_halo);
    ink.width = 0.0;
    if (has_halo && layout->frame->color) ink.paper = paper_around(layout, x, y, zr_type_width(text, height), height);
    zr_marks_add_text(layout->marks, text, place, ink);
}

void zr_layout_write_over(struct zr_layout *layout, const char *text, double x, double y, double height, uint32_t color)
{
    const struct zr_type_place place = {floor(x + 0.5) + 0.5, floor(y + 0.5) - 0.5, height, 1.0, 0.0};
    zr_marks_add_text(layout->marks, text, place, zr_layout_ink(layout, color, 0.0, true));
}

void zr_layout_draw(struct zr_layout *layout, struct zr_segment line, uint32_t color, double lines, bool has_halo)
{
    const struct zr_point points[2] = {line.from, line.to};
    zr_marks_add_line(layout->marks, points, 2, zr_layout_ink(layout, color, lines, has_halo));
}
