#include "drawing/overall.h"

#include <math.h>

#include "overlay/annotate/length_text.h"
#include "overlay/type.h"

static const double gap = 1.0, beyond = 2.0, above = 1.0, arrows = 6.0, outside = 7.0;

static void add_line(struct zr_plot *plot, double x0, double y0, double x1, double y1)
{
    zr_plot_add_line(plot, ZR_PLOT_DIMENSION, (const struct zr_point[2]){{x0, y0}, {x1, y1}}, 2);
}

/* A dimension from `low` to `high` along an axis, at a place across it. Views lie on the side `toward` of that, and
 * extension lines begin at `edge`. */
struct dimension {
    double low, high, at, edge, toward;
    bool is_upright;
    const char *text;
};

/* Adds a line along the dimension, or across it. */
static void add_along(struct zr_plot *plot, const struct dimension *d, double from, double to)
{
    if (d->is_upright)
        add_line(plot, d->at, from, d->at, to);
    else
        add_line(plot, from, d->at, to, d->at);
}

static void add_extension(struct zr_plot *plot, const struct dimension *d, double place)
{
    const double from = d->edge - gap * d->toward, to = d->at - beyond * d->toward;
    if (d->is_upright)
        add_line(plot, from, place, to, place);
    else
        add_line(plot, place, from, place, to);
}

static void add_arrow(struct zr_plot *plot, const struct dimension *d, double place, double direction)
{
    const struct zr_point tip = d->is_upright ? (struct zr_point){d->at, place} : (struct zr_point){place, d->at};
    zr_plot_add_arrow(plot, tip, d->is_upright ? 0.0 : direction, d->is_upright ? direction : 0.0);
}

/* Adds the text with its middle at a place along the line, above it, or left of an upright one. */
static void add_text(struct zr_plot *plot, const struct dimension *d, double middle)
{
    const double half = 0.5 * zr_type_width(d->text, ZR_DRAWING_TEXT);
    if (d->is_upright)
        zr_plot_add_text(plot, d->text, (struct zr_point){d->at - above, middle + half}, ZR_DRAWING_TEXT, true);
    else
        zr_plot_add_text(plot, d->text, (struct zr_point){middle - half, d->at - above}, ZR_DRAWING_TEXT, false);
}

/* Returns the box of the dimension. */
static struct zr_page_box add_dimension(struct zr_plot *plot, const struct dimension *d)
{
    const double length = d->high - d->low, text = zr_type_width(d->text, ZR_DRAWING_TEXT);
    const bool has_arrows = length >= arrows + 2.0, has_text = length >= text + 2.0 && (has_arrows || length >= text);
    add_extension(plot, d, d->low);
    add_extension(plot, d, d->high);
    add_arrow(plot, d, d->low, has_arrows ? -1.0 : 1.0);
    add_arrow(plot, d, d->high, has_arrows ? 1.0 : -1.0);
    add_along(plot, d, d->low, d->high);
    if (!has_arrows) add_along(plot, d, d->low - outside, d->low);
    /* A text beside the line goes to its right or lower end. */
    const double tail = has_text ? (has_arrows ? 0.0 : outside) : (has_arrows ? 2.0 : outside) + text;
    if (tail > 0.0) add_along(plot, d, d->high, d->high + tail);
    add_text(plot, d, has_text ? 0.5 * (d->low + d->high) : d->high + tail - 0.5 * text);
    const double out = has_arrows ? 0.0 : outside, rim = 1.0;
    const double low = fmin(d->low - out, has_text ? 0.5 * (d->low + d->high - text) : d->low) - rim,
                 high = fmax(d->high + tail, has_text ? 0.5 * (d->low + d->high + text) : d->high) + rim;
    const double near = d->at - above - ZR_DRAWING_TEXT - rim, far = d->at + beyond;
    const double from = fmin(fmin(near, d->edge), d->at - beyond), to = fmax(far, d->edge);
    return d->is_upright ? (struct zr_page_box){from, low, to, high} : (struct zr_page_box){low, from, high, to};
}

void zr_overall_add(struct zr_plot *plot, const struct zr_placed_views *placed, struct zr_page_box boxes[3])
{
    const bool is_first = placed->page.is_first_angle;
    const struct zr_page_box front = placed->layout.views[ZR_PAGE_FRONT], top = placed->layout.views[ZR_PAGE_TOP];
    const struct zr_page_box low = is_first ? top : front;
    const double side = is_first ? 1.0 : -1.0, *sizes = placed->sizes;
    const double largest = fmax(sizes[0], fmax(sizes[1], sizes[2]));
    const double front_edge = is_first ? front.x1 : front.x0, top_edge = is_first ? top.x1 : top.x0;
    double offsets[3] = {ZR_OVERALL_OFFSET, ZR_OVERALL_OFFSET, ZR_OVERALL_OFFSET};
    char texts[3][ZR_LENGTH_SIZE];
    for (int k = 0; k < 3; k++)
        zr_length_write(sizes[k], largest, "", texts[k]);
    if (placed->is_cut) /* the dimension beyond an end of the cutting line */
        offsets[placed->cut == ZR_PAGE_FRONT ? 2 : placed->cut == ZR_PAGE_TOP ? 1 : 0] = ZR_OVERALL_BEYOND;
    if (is_first && placed->is_cut && placed->cut == ZR_PAGE_RIGHT) offsets[0] = ZR_OVERALL_OFFSET;
    zr_plot_begin(plot, "dimensions");
    const struct dimension all[3] = {
        {low.x0, low.x1, low.y1 + offsets[0], low.y1, -1.0, false, texts[0]},
        {front.y0, front.y1, front_edge + side * offsets[1], front_edge, -side, true, texts[1]},
        {top.y0, top.y1, top_edge + side * offsets[2], top_edge, -side, true, texts[2]}};
    for (int k = 0; k < 3; k++)
        boxes[k] = sizes[k] > 0.0 ? add_dimension(plot, &all[k]) : placed->page.title;
}
