#include "output/plot_svg.h"

#include <stdio.h>
#include <string.h>

#include "output/svg_print.h"
#include "overlay/type.h"

enum { DECIMALS = 6, ITEMS_PER_CANCEL_CHECK = 1 << 8 };

/* Appends a coordinate without zeros at its end. */
static void print_number(struct zr_buffer *out, double value)
{
    char text[64];
    int length = snprintf(text, sizeof text, "%.*f", DECIMALS, value);
    while (length > 1 && length < (int)sizeof text && text[length - 1] == '0')
        length--;
    if (length > 1 && length < (int)sizeof text && text[length - 1] == '.') length--;
    if (length == 2 && text[0] == '-' && text[1] == '0') {
        text[0] = '0';
        length = 1;
    }
    if (length < (int)sizeof text) zr_buffer_add(out, text, (size_t)length);
}

static void print_points(struct zr_buffer *out, const struct zr_point *points, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        zr_buffer_add(out, i == 0 ? "M" : "L", 1);
        print_number(out, points[i].x);
        zr_buffer_add(out, " ", 1);
        print_number(out, points[i].y);
    }
    if (count == 1) zr_buffer_add(out, "h0", 2); /* a dot: its round ends */
}

static void print_text(struct zr_buffer *out, const struct zr_plot_item *item, struct zr_point at)
{
    const struct zr_type_place place = {at.x, at.y, item->height, item->is_upright ? 0.0 : 1.0,
                                        item->is_upright ? -1.0 : 0.0};
    struct zr_type_walk walk = {item->text, place};
    struct zr_letter_path letter;
    zr_svg_print(out, "<g role=\"img\" aria-label=\"");
    zr_svg_print_escaped(out, item->text);
    zr_svg_print(out, "\">\n<path stroke-width=\"%.6g\" d=\"", zr_plot_width(item));
    while (zr_type_next(&walk, &letter))
        for (uint32_t i = 0, begin = 0; i < letter.count; begin = letter.ends[i++])
            print_points(out, letter.points + begin, letter.ends[i] - begin);
    zr_svg_print(out, "\"/>\n</g>\n");
}

static void print_item(struct zr_buffer *out, const struct zr_plot *plot, const struct zr_plot_item *item)
{
    const struct zr_point *points = plot->points + item->first;
    if (item->kind == ZR_PLOT_WORDS) {
        print_text(out, item, points[0]);
        return;
    }
    const bool is_closed = item->kind != ZR_PLOT_LINE, is_area = item->kind == ZR_PLOT_AREA;
    zr_svg_print(out, "<path d=\"");
    print_points(out, points, item->count);
    zr_svg_print(out, is_closed ? "Z\"" : "\"");
    if (is_area) zr_svg_print(out, " fill=\"#000\" stroke=\"none\"");
    const uint32_t lengths = item->dash > 0.0 ? zr_plot_dash_count(item->pen) : 0;
    for (uint32_t i = 0; i < lengths; i++) {
        zr_svg_print(out, i == 0 ? " stroke-dasharray=\"" : " ");
        print_number(out, item->dash * zr_plot_pens[item->pen].dashes[i]);
    }
    zr_svg_print(out, lengths > 0 ? "\"/>\n" : "/>\n");
}

/* Prints the items of a group, in groups by pen. */
static void print_items(struct zr_buffer *out, const struct zr_plot *plot, uint32_t first, uint32_t end,
                        const struct zr_cancel *cancel)
{
    for (uint32_t i = first; i < end; i++) {
        const struct zr_plot_item *item = &plot->items[i];
        const struct zr_plot_pen_row *pen = &zr_plot_pens[item->pen];
        if (i % ITEMS_PER_CANCEL_CHECK == 0 && zr_is_cancelled(cancel)) return;
        if (i == first || plot->items[i - 1].pen != item->pen) {
            zr_svg_print(out, "<g class=\"%s\"", pen->name);
            if (pen->width > 0.0) zr_svg_print(out, " stroke-width=\"%.6g\"", pen->width);
            zr_svg_print(out, ">\n");
        }
        print_item(out, plot, item);
        if (i + 1 == end || plot->items[i + 1].pen != item->pen) zr_svg_print(out, "</g>\n");
    }
}

enum zr_status zr_plot_svg_write(const struct zr_plot *plot, const struct zr_cancel *cancel, struct zr_buffer *out)
{
    zr_svg_print(out,
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.6gmm\" height=\"%.6gmm\" viewBox=\"0 0 %.6g "
                 "%.6g\" fill=\"none\" stroke=\"#000\" stroke-linecap=\"round\" stroke-linejoin=\"round\" "
                 "data-scale=\"%s\">\n",
                 plot->width, plot->height, plot->width, plot->height, plot->scale);
    zr_svg_print(out, "<rect width=\"%.6g\" height=\"%.6g\" fill=\"#fff\" stroke=\"none\"/>\n", plot->width,
                 plot->height);
    for (uint32_t g = 0; g < plot->group_count; g++) {
        const uint32_t first = plot->groups[g].first,
                       end = g + 1 < plot->group_count ? plot->groups[g + 1].first : plot->item_count;
        zr_svg_print(out, "<g id=\"%s\">\n", plot->groups[g].name);
        print_items(out, plot, first, end, cancel);
        zr_svg_print(out, "</g>\n");
    }
    zr_svg_print(out, "</svg>\n");
    if (zr_is_cancelled(cancel)) return ZR_CANCELLED;
    return zr_arena_ok(out->arena) ? ZR_OK : ZR_NO_MEMORY;
}
