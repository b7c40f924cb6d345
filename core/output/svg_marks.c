#include "output/svg_marks.h"

#include <string.h>

#include "output/svg_print.h"

/* What all functions need. */
struct writer {
    struct zr_buffer *out;
    double pixel;
    int decimals;
};

static void print_polyline(const struct writer *w, const struct zr_point *points, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        zr_svg_print(w->out, i == 0 ? "M" : "L");
        zr_svg_print_number(w->out, points[i].x * w->pixel, w->decimals);
        zr_svg_print(w->out, " ");
        zr_svg_print_number(w->out, points[i].y * w->pixel, w->decimals);
    }
    if (count == 1) zr_svg_print(w->out, "h0"); /* a dot: its round ends */
}

static void print_path(const struct writer *w, const struct zr_path *path)
{
    for (uint32_t i = 0, begin = 0; i < path->count; begin = path->ends[i++])
        print_polyline(w, path->points + begin, path->ends[i] - begin);
}

static void print_text(const struct writer *w, const struct zr_mark *mark)
{
    struct zr_type_walk walk = {mark->text, mark->place};
    struct zr_letter_path letter;
    while (zr_type_next(&walk, &letter))
        print_path(w, &(struct zr_path){letter.count, letter.ends, letter.points});
}

/* Appends an attribute, and another one for an opacity below 1. */
static void print_color(const struct writer *w, const char *name, uint32_t color)
{
    uint8_t rgba[4];
    memcpy(rgba, &color, sizeof rgba);
    zr_svg_print(w->out, " %s=\"#%02x%02x%02x\"", name, rgba[0], rgba[1], rgba[2]);
    if (rgba[3] < 255) zr_svg_print(w->out, " %s-opacity=\"%.4g\"", name, rgba[3] / 255.0);
}

/* Appends the path of a mark, enlarged by `grow` pixels on all sides. */
static void print_mark(const struct writer *w, const struct zr_mark *mark, double grow, uint32_t color)
{
    const bool is_area = mark->kind == ZR_MARK_AREA;
    const double pen = zr_mark_pen(mark) + 2 * grow;
    zr_svg_print(w->out, "<path d=\"");
    if (mark->kind == ZR_MARK_TEXT)
        print_text(w, mark);
    else
        print_path(w, &mark->path);
    zr_svg_print(w->out, is_area && mark->path.count > 0 ? "Z\"" : "\"");
    if (is_area) print_color(w, "fill", color);
    if (pen > 0) print_color(w, "stroke", color);
    zr_svg_print(w->out, pen > 0 ? " stroke-width=\"%.6g\"/>\n" : " stroke=\"none\"/>\n", pen * w->pixel);
}

static void print_halos(const struct writer *w, const struct zr_marks *marks)
{
    zr_svg_print(w->out, "<g class=\"halos\" aria-hidden=\"true\">\n");
    for (uint32_t i = 0; i < marks->count; i++) {
        const struct zr_mark *mark = &marks->at[i];
        if (mark->ink.halo > 0) print_mark(w, mark, mark->ink.halo, mark->ink.paper);
    }
    zr_svg_print(w->out, "</g>\n");
}

void zr_svg_print_marks(struct zr_buffer *out, const struct zr_marks *marks, double pixel)
{
    const struct writer w = {out, pixel, zr_svg_decimals(pixel)};
    print_halos(&w, marks);
    zr_svg_print(out, "<g class=\"marks\">\n");
    for (uint32_t i = 0; i < marks->count; i++) {
        const struct zr_mark *mark = &marks->at[i];
        if (mark->kind == ZR_MARK_TEXT) {
            zr_svg_print(out, "<g role=\"img\" aria-label=\"");
            zr_svg_print_escaped(out, mark->text);
            zr_svg_print(out, "\">\n");
        }
        print_mark(&w, mark, 0, mark->ink.color);
        if (mark->kind == ZR_MARK_TEXT) zr_svg_print(out, "</g>\n");
    }
    zr_svg_print(out, "</g>\n");
}
