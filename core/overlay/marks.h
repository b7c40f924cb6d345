/* marks.h - overlay: a list of lines, areas and texts, to be drawn over a picture or written to a file.
 *
 * Space:  pixels, y downwards, as pen.h.
 * Halo:   a rim in the colour `paper` around the ink. All halos are below all ink, whatever the order of marks; else
 *         later marks are above earlier ones.
 * Memory: points and texts are copied to the arena of the list. If it fails, `has_failed` is set, and nothing more is
 *         drawn of that mark. */
#ifndef ZR_MARKS_H
#define ZR_MARKS_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/cancel.h"
#include "core.h"
#include "overlay/type.h"

/* Colours are four bytes as base/rgba.h makes them. */
struct zr_ink {
    uint32_t color, paper;
    double width; /* of lines, and of the pen of texts, for which 0 is the usual one; areas have none */
    double halo;  /* width beyond the ink, on each side; 0: none */
};

enum zr_mark_kind {
    ZR_MARK_LINES, /* polylines with round ends */
    ZR_MARK_AREA,  /* a polygon */
    ZR_MARK_TEXT
};

struct zr_mark {
    enum zr_mark_kind kind;
    struct zr_ink ink;
    struct zr_path path;        /* of lines; an area has one polyline, which is not closed */
    const char *text;           /* of texts: UTF-8 */
    struct zr_type_place place; /* likewise */
};

struct zr_marks {
    struct zr_arena *arena;
    struct zr_mark *at;
    uint32_t count, room;
    uint32_t boxed; /* texts with characters that have no letter: they are drawn as boxes */
    bool has_failed;
};

/* Adds a polyline. */
void zr_marks_add_line(struct zr_marks *marks, const struct zr_point *points, uint32_t count, struct zr_ink ink);

/* Adds a polyline in dashes. `pattern`: lengths of a dash, a gap, a dash and so on, more than 0; `lengths` of them, an
 * even number. A polyline of more than 4096 dashes is added whole. */
void zr_marks_add_dashes(struct zr_marks *marks, const struct zr_point *points, uint32_t count, const double *pattern,
                         uint32_t lengths, struct zr_ink ink);

/* Adds a filled polygon. */
void zr_marks_add_area(struct zr_marks *marks, const struct zr_point *points, uint32_t count, struct zr_ink ink);

/* Adds a filled arrow head with its point at `tip`, which points along the unit vector (dx, dy). */
void zr_marks_add_arrow(struct zr_marks *marks, struct zr_point tip, double dx, double dy, double length,
                        double half_width, struct zr_ink ink);

/* Adds a filled circle. The ink's width is not used. */
void zr_marks_add_disc(struct zr_marks *marks, struct zr_point center, double radius, struct zr_ink ink);

/* Adds a circle. */
void zr_marks_add_ring(struct zr_marks *marks, struct zr_point center, double radius, struct zr_ink ink);

/* Adds a text. */
void zr_marks_add_text(struct zr_marks *marks, const char *text, struct zr_type_place place, struct zr_ink ink);

/* Returns the width of a mark's pen: that of lines or letters; 0 for areas. */
double zr_mark_pen(const struct zr_mark *mark);

/* Draws all marks. Returns ZR_OK, or ZR_CANCELLED. */
enum zr_status zr_marks_draw(const struct zr_marks *marks, const struct zr_cancel *cancel,
                             const struct zr_canvas *canvas);

#endif
