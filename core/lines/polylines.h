/* polylines.h - lines: pieces joined to polylines, for strokes and files.
 *
 * Space:  window, pixels, y up.
 * How:    pieces of one class are linked (links.h). Visible lines with no ends of others within a pixel of theirs, and
 *         nowhere at the background, are specks if they are shorter than 12 pixels in all; hidden lines, if shorter
 *         than 3. Specks go. Points within `straight` pixels of the chord of their neighbours go.
 * Exact:  in the order of pieces. */
#ifndef ZR_POLYLINES_H
#define ZR_POLYLINES_H

#include "lines/line_pieces.h"

enum zr_stroke_class {
    ZR_STROKE_OUTLINE, /* contours of smooth surfaces, borders, all lines at the background */
    ZR_STROKE_INNER,   /* creases, intersections and sharp contours */
    ZR_STROKE_HIDDEN,
    ZR_STROKE_CLASSES
};

struct zr_polyline {
    uint32_t first, count; /* of `points`: two or more; in a ring, the last one equals the first */
    uint8_t class;         /* enum zr_stroke_class */
    uint8_t kind;          /* enum zr_line_kind of its first piece */
    uint32_t line;         /* line of its first piece */
};

struct zr_polylines {
    uint32_t count, point_count;
    struct zr_polyline *at;
    double (*points)[2];
};

#define ZR_POLYLINE_STRAIGHT 0.02 /* pixel: the usual `straight` */

/* Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_polylines_make(struct zr_arena *arena, const struct zr_cancel *cancel,
                                 const struct zr_line_pieces *pieces, double straight, struct zr_polylines *out);

#endif
