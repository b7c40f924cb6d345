#include "overlay/annotate/dimension_line.h"

#include <math.h>

/* Widths in lines. */
static const double pen = 0.55, gap = 2.2, beyond = 2.2;
/* Sizes in heights of capitals. */
static const double text_gap = 0.45, over_gap = 0.6, short_room = 4.5, tail = 2.2; /* over_gap: with descenders */

/* Half of an arrow's width as a share of its length. */
static const double arrow_share = 0.19;

/* A line that is laid out: at most two extension lines, two pieces and two tails. */
struct laid_out {
    struct zr_segment lines[6];
    uint32_t count;
    struct zr_point tips[2];
    double arrow_x, arrow_y; /* direction of the first arrow; the second one has the opposite */
    double text_x, text_y, text_width;
    struct zr_rect rect;
};

static struct zr_point move(struct zr_point p, double x, double y, double by)
{
    return (struct zr_point){p.x + x * by, p.y + y * by};
}

/* Places the text's box with its middle at a point. */
static void set_text(const struct zr_layout *l, struct laid_out *out, struct zr_point middle)
{
    out->text_x = middle.x - 0.5 * out->text_width;
    out->text_y = middle.y + 0.5 * l->letters;
    out->rect = zr_layout_text_rect(out->text_x, out->text_y, out->text_width, l->letters, 0.15 * l->letters);
}

static bool is_free(const struct zr_layout *l, const struct laid_out *out, enum zr_line_room room)
{
    if (!zr_layout_is_inside(l, out->rect) || !zr_layout_is_apart(l, out->rect) ||
        (room == ZR_ROOM_BESIDE && !zr_layout_is_background(l, out->rect)))
        return false;
    for (uint32_t i = 0; i < out->count; i++)
        if (!(room == ZR_ROOM_ACROSS ? zr_layout_is_line_off_rects : zr_layout_is_line_free)(l, out->lines[i]) ||
            zr_layout_line_meets(out->lines[i], out->rect))
            return false;
    return true;
}

static void draw(struct zr_layout *l, const struct zr_dimension_line *line, const struct laid_out *out)
{
    const double length = l->letters + 2.2 * l->line;
    const struct zr_ink ink = zr_layout_ink(l, l->dimension, 0.0, line->is_over_model);
    for (uint32_t i = 0; i < out->count; i++) {
        zr_layout_draw(l, out->lines[i], l->dimension, pen, line->is_over_model);
        zr_layout_take_line(l, out->lines[i]);
    }
    for (int i = 0; i < 2; i++) {
        const double sign = i == 0 ? 1.0 : -1.0;
        zr_marks_add_arrow(l->marks, out->tips[i], sign * out->arrow_x, sign * out->arrow_y, length,
                           arrow_share * length, ink);
    }
    if (line->room != ZR_ROOM_BESIDE)
        zr_layout_write_over(l, line->text, out->text_x, out->text_y, l->letters, l->dimension);
    else
        zr_layout_write(l, line->text, out->text_x, out->text_y, l->letters, l->dimension, line->is_over_model);
    zr_layout_take_rect(l, out->rect);
}

/* Puts the text in a gap of the line, and arrows between the ends. */
static void lay_inside(const struct zr_layout *l, struct laid_out *out, double ux, double uy, double half)
{
    const struct zr_point a = out->tips[0], b = out->tips[1];
    const struct zr_point middle = {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
    out->lines[out->count++] = (struct zr_segment){a, move(middle, ux, uy, -half)};
    out->lines[out->count++] = (struct zr_segment){move(middle, ux, uy, half), b};
    out->arrow_x = -ux;
    out->arrow_y = -uy;
    set_text(l, out, middle);
}

/* Puts arrows outside of the ends, and the text beside the line, at its lower or at its upper end. */
static bool lay_outside(struct zr_layout *l, const struct zr_dimension_line *line, struct laid_out *out, double ux,
                        double uy)
{
    const double length = tail * (l->letters + 2.2 * l->line), h = l->letters;
    const double half_width = 0.5 * out->text_width + text_gap * h, half_height = (0.5 + text_gap) * h;
    const struct zr_point a = out->tips[0], b = out->tips[1], first = move(a, ux, uy, -length),
                          last = move(b, ux, uy, length);
    const struct zr_point middle = {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
    const bool is_last_low = last.y > first.y || (last.y == first.y && last.x > first.x);
    const double beside = fabs(line->dx) * half_width + fabs(line->dy) * half_height;
    const double along = fabs(ux) * half_width + fabs(uy) * half_height;
    const struct zr_point after_last = move(last, ux, uy, along), before_first = move(first, ux, uy, -along);
    const struct zr_point places[] = {move(middle, line->dx, line->dy, beside), is_last_low ? after_last : before_first,
                                      is_last_low ? before_first : after_last,
                                      move(middle, line->dx, line->dy, -beside)};
    out->lines[out->count++] = (struct zr_segment){first, a};
    out->lines[out->count++] = (struct zr_segment){a, b};
    out->lines[out->count++] = (struct zr_segment){b, last};
    out->arrow_x = ux;
    out->arrow_y = uy;
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        set_text(l, out, places[i]);
        if (!is_free(l, out, line->room)) continue;
        draw(l, line, out);
        return true;
    }
    return false;
}

/* Returns the line from a gap beside a place to beyond a tip. */
static struct zr_segment extension(const struct zr_layout *l, struct zr_point at, struct zr_point tip)
{
    const double x = tip.x - at.x, y = tip.y - at.y, length = fmax(sqrt(x * x + y * y), 1e-9);
    return (struct zr_segment){move(at, x / length, y / length, fmin(gap * l->line, length)),
                               move(tip, x / length, y / length, beyond * l->line)};
}

bool zr_dimension_line_place(struct zr_layout *l, const struct zr_dimension_line *line)
{
    const double h = l->letters, arrow = h + 2.2 * l->line;
    struct laid_out out = {.count = 0, .text_width = zr_type_width(line->text, h)};
    out.tips[0] = line->tips[0];
    out.tips[1] = line->tips[1];
    const double x = out.tips[1].x - out.tips[0].x, y = out.tips[1].y - out.tips[0].y, length = sqrt(x * x + y * y);
    if (!(length > l->line)) return false;
    const double ux = x / length, uy = y / length;
    for (int i = 0; i < 2; i++)
        out.lines[out.count++] = extension(l, i == 0 ? line->from : line->to, out.tips[i]);
    const double across = (0.5 * out.text_width + text_gap * h) / fmax(fabs(ux), 1e-9);
    const double low = line->room == ZR_ROOM_BESIDE ? text_gap : over_gap;
    const double half = fmin(across, (0.5 + low) * h / fmax(fabs(uy), 1e-9));
    if (length < 2.0 * half + fmax(2.4 * arrow, short_room * h - 2.0 * text_gap * h))
        return lay_outside(l, line, &out, ux, uy);
    lay_inside(l, &out, ux, uy, half + l->line);
    if (!is_free(l, &out, line->room)) return false;
    draw(l, line, &out);
    return true;
}
