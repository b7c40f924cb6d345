/* svg.h - output: the polylines of a drawing as SVG, and marks above them.
 *
 * Space:  units of the output, y down; the point (0, 0) is the top left corner of the window.
 * Form:   a group per part, with its name as data-name; in it, a group per class of lines: hidden, inner, outline. A
 *         path per polyline. Rings are closed. The marks come last, as svg_marks.h has them. Coordinates have as many
 *         decimals as a hundredth of a pixel needs.
 * Exact:  the same bytes for every machine, LC_NUMERIC being "C". */
#ifndef ZR_SVG_H
#define ZR_SVG_H

#include "lines/polylines.h"
#include "output/bytes/buffer.h"
#include "overlay/marks.h"

struct zr_svg_desc {
    const struct zr_polylines *lines;
    const uint32_t *parts;            /* by polyline: its part, below part_count */
    uint32_t part_count;              /* at most 2^30 */
    const char *const *part_names;    /* by part: UTF-8, "": none */
    uint32_t width, height;           /* of the window, pixels */
    double pixel;                     /* length of a pixel in units of the output; more than 0 */
    const char *unit;                 /* of the size: "mm"; "": the size is that of the window in pixels */
    double widths[ZR_STROKE_CLASSES]; /* of lines, in units of the output */
    zr_vec3 color;                    /* sRGB-encoded, 0..1 */
    const zr_vec3 *paper;             /* colour behind the lines, likewise; NULL: none */
    const struct zr_marks *marks;     /* NULL: none */
};

/* Appends the file. Returns false if the arena failed. */
bool zr_svg_encode(const struct zr_svg_desc *desc, struct zr_buffer *out);

/* Returns the line width of ISO 128-2 that is nearest to `width` by ratio: 0.13, 0.18, 0.25, 0.35, 0.5, 0.7, 1, 1.4 or
 * 2 mm. A width beyond the series, by more than half of its ratio of sqrt(2), stays. */
double zr_iso_line_width(double width);

#endif
