#include "output/svg.h"

#include "output/svg_marks.h"
#include "output/svg_print.h"

/* Dashes and gaps of hidden lines, in units of their width, as of strokes (lines/strokes.h). */
static const double dash = 8.0, gap = 5.0;

double zr_iso_line_width(double width)
{
    static const double series[] = {0.13, 0.18, 0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0};
    enum { COUNT = sizeof series / sizeof *series };
    int i = 0;
    if (width * width * 1.4 < series[0] * series[0] || width * width > 1.4 * series[COUNT - 1] * series[COUNT - 1])
        return width;
    while (i + 1 < COUNT && width * width > series[i] * series[i + 1])
        i++;
    return series[i];
}

static void print_point(const struct zr_svg_desc *desc, struct zr_buffer *out, const double point[2], int decimals)
{
    zr_svg_print_number(out, point[0] * desc->pixel, decimals);
    zr_buffer_add(out, " ", 1);
    zr_svg_print_number(out, ((double)desc->height - point[1]) * desc->pixel, decimals);
}

static void print_path(const struct zr_svg_desc *desc, struct zr_buffer *out, const struct zr_polyline *line)
{
    const double(*points)[2] = (const double(*)[2])desc->lines->points + line->first;
    const double *last = points[line->count - 1];
    const bool is_ring = line->count > 3 && points[0][0] == last[0] && points[0][1] == last[1];
    const int decimals = zr_svg_decimals(desc->pixel);
    zr_buffer_add(out, "<path d=\"M", 10);
    for (uint32_t i = 0; i < line->count - is_ring; i++) {
        if (i > 0) zr_buffer_add(out, "L", 1);
        print_point(desc, out, points[i], decimals);
    }
    zr_svg_print(out, is_ring ? "Z\"/>\n" : "\"/>\n");
}

static unsigned byte_of(float value)
{
    return (unsigned)(value * 255.0f + 0.5f);
}

static void begin_class(const struct zr_svg_desc *desc, struct zr_buffer *out, enum zr_stroke_class class)
{
    static const char *const names[ZR_STROKE_CLASSES] = {"outline", "inner", "hidden"};
    const double width = desc->widths[class];
    zr_svg_print(out, "<g class=\"%s\" stroke-width=\"%.6g\"", names[class], width);
    if (class == ZR_STROKE_HIDDEN)
        zr_svg_print(out, " stroke-opacity=\"0.5\" stroke-dasharray=\"%.6g %.6g\"", dash * width, gap * width);
    zr_svg_print(out, ">\n");
}

/* ---- polylines by part and class: a counting sort ---- */

static uint32_t key_of(const struct zr_svg_desc *desc, uint32_t line)
{
    return desc->parts[line] * ZR_STROKE_CLASSES + (ZR_STROKE_CLASSES - 1u - desc->lines->at[line].class);
}

/* Writes the numbers of polylines by key. Returns NULL if the arena failed. */
static const uint32_t *sort_lines(const struct zr_svg_desc *desc, struct zr_arena *arena)
{
    const size_t keys = (size_t)desc->part_count * ZR_STROKE_CLASSES;
    uint32_t *begins = zr_arena_zero(arena, keys + 1, sizeof *begins);
    uint32_t *sorted = zr_arena_alloc(arena, desc->lines->count, sizeof *sorted);
    if (!begins || !sorted) return NULL;
    for (uint32_t i = 0; i < desc->lines->count; i++)
        begins[key_of(desc, i) + 1]++;
    for (size_t k = 1; k <= keys; k++)
        begins[k] += begins[k - 1];
    for (uint32_t i = 0; i < desc->lines->count; i++)
        sorted[begins[key_of(desc, i)]++] = i;
    return sorted;
}

static void print_lines(const struct zr_svg_desc *desc, struct zr_buffer *out, const uint32_t *sorted)
{
    for (uint32_t i = 0; i < desc->lines->count; i++) {
        const uint32_t line = sorted[i], part = desc->parts[line], count = desc->lines->count;
        const bool begins_part = i == 0 || desc->parts[sorted[i - 1]] != part;
        const bool ends_part = i + 1 == count || desc->parts[sorted[i + 1]] != part;
        const bool begins = begins_part || key_of(desc, sorted[i - 1]) != key_of(desc, line);
        const bool ends = ends_part || key_of(desc, sorted[i + 1]) != key_of(desc, line);
        if (begins_part) {
            zr_svg_print(out, "<g id=\"part-%u\"", part);
            if (*desc->part_names[part]) zr_svg_print(out, " data-name=\"");
            zr_svg_print_escaped(out, desc->part_names[part]);
            zr_svg_print(out, *desc->part_names[part] ? "\">\n" : ">\n");
        }
        if (begins) begin_class(desc, out, desc->lines->at[line].class);
        print_path(desc, out, &desc->lines->at[line]);
        if (ends) zr_svg_print(out, "</g>\n");
        if (ends_part) zr_svg_print(out, "</g>\n");
    }
}

/* Prints the paper as a style, which viewers show and plotters ignore. */
static void print_paper(struct zr_buffer *out, const zr_vec3 *paper)
{
    if (paper)
        zr_svg_print(out, " style=\"background:#%02x%02x%02x\"", byte_of(paper->x), byte_of(paper->y),
                     byte_of(paper->z));
}

bool zr_svg_encode(const struct zr_svg_desc *desc, struct zr_buffer *out)
{
    const double width = (double)desc->width * desc->pixel, height = (double)desc->height * desc->pixel;
    const uint32_t *sorted = sort_lines(desc, out->arena);
    if (!sorted) return false;
    zr_svg_print(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.7g%s\" height=\"%.7g%s\" viewBox=\"0 0 %.7g %.7g\" "
        "fill=\"none\" stroke=\"#%02x%02x%02x\" stroke-linecap=\"round\" stroke-linejoin=\"round\"",
        *desc->unit ? width : (double)desc->width, desc->unit, *desc->unit ? height : (double)desc->height, desc->unit,
        width, height, byte_of(desc->color.x), byte_of(desc->color.y), byte_of(desc->color.z));
    print_paper(out, desc->paper);
    zr_svg_print(out, ">\n");
    print_lines(desc, out, sorted);
    if (desc->marks) zr_svg_print_marks(out, desc->marks, desc->pixel);
    zr_svg_print(out, "</svg>\n");
    return zr_arena_ok(out->arena);
}
