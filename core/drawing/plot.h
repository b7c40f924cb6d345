/* plot.h - drawing: lines, areas and texts of a technical drawing, before they are written or drawn.
 *
 * Space:  millimetres of the paper, x to the right and y down from its top left corner.
 * Groups: items belong to the last group that was begun, such as a view.
 * Pens:   line types and widths of ISO 128-2, group 0.5; the frame has 0.7. Lengths of dashes are those of the standard
 *         (dash 12 d, gap 3 d; long dash 24 d, gap 3 d, dot) with round ends, which add a width to a dash.
 * Memory: points and texts are copied to the arena. If it fails, `has_failed` is set. */
#ifndef ZR_PLOT_H
#define ZR_PLOT_H

#include <stdbool.h>

#include "base/arena.h"
#include "overlay/path.h"

/* ROW(ID, class in files, width, lengths of a dash, a gap, ...: 0 of them: whole) */
#define ZR_PLOT_PEN_ROWS(ROW)                                                                                          \
    ROW(FRAME, "frame", 0.7, {0})                                                                                      \
    ROW(TABLE, "table", 0.35, {0})                                                                                     \
    ROW(VISIBLE, "visible", 0.5, {0})                                                                                  \
    ROW(HIDDEN, "hidden", 0.25, {2.75, 1.0})                                                                           \
    ROW(CENTER, "center", 0.25, {5.75, 1.0, 0.05, 1.0})                                                                \
    ROW(CUT, "cut", 0.5, {0})                                                                                          \
    ROW(HATCH, "hatch", 0.25, {0})                                                                                     \
    ROW(DIMENSION, "dimension", 0.25, {0})                                                                             \
    ROW(SYMBOL, "symbol", 0.35, {0})                                                                                   \
    ROW(TEXT, "text", 0, {0})

enum zr_plot_pen {
#define ZR_PLOT_PEN(ID, ...) ZR_PLOT_##ID,
    ZR_PLOT_PEN_ROWS(ZR_PLOT_PEN)
#undef ZR_PLOT_PEN
        ZR_PLOT_PENS
};

enum { ZR_PLOT_DASH_LENGTHS = 4 };

struct zr_plot_pen_row {
    const char *name;
    double width; /* texts: 0, a tenth of their height */
    double dashes[ZR_PLOT_DASH_LENGTHS];
};

extern const struct zr_plot_pen_row zr_plot_pens[ZR_PLOT_PENS];

enum zr_plot_kind { ZR_PLOT_LINE, ZR_PLOT_RING /* closed */, ZR_PLOT_AREA, ZR_PLOT_WORDS };

struct zr_plot_item {
    enum zr_plot_kind kind;
    enum zr_plot_pen pen;
    uint32_t first, count; /* of points */
    double dash;           /* factor of the lengths of dashes; 0: whole */
    const char *text;      /* of words: UTF-8 */
    double height;         /* likewise: of capitals */
    bool is_upright;       /* likewise: it runs upwards, to be read from the right */
};

struct zr_plot_group {
    const char *name; /* literal, an identifier of XML */
    uint32_t first;   /* item */
};

enum { ZR_PLOT_GROUPS = 24 };

struct zr_plot {
    struct zr_arena *arena;
    double width, height; /* of the paper */
    const char *title;    /* UTF-8 */
    char scale[32];       /* "1:2" */
    uint32_t item_count, item_room, point_count, point_room, group_count;
    uint32_t boxed; /* texts with characters that have no letter: they are drawn as boxes */
    struct zr_plot_item *items;
    struct zr_point *points;
    struct zr_plot_group groups[ZR_PLOT_GROUPS];
    bool has_failed;
};

/* Begins a group. */
void zr_plot_begin(struct zr_plot *plot, const char *name);

/* Add a polyline of two or more points, or a closed one, in the dashes of its pen. */
void zr_plot_add_line(struct zr_plot *plot, enum zr_plot_pen pen, const struct zr_point *points, uint32_t count);
void zr_plot_add_ring(struct zr_plot *plot, enum zr_plot_pen pen, const struct zr_point *points, uint32_t count);

/* Adds a straight line. Its dashes are scaled so that it begins and ends with one, and `has_middle`: another one, or no
 * gap, is in its middle. */
void zr_plot_add_straight(struct zr_plot *plot, enum zr_plot_pen pen, struct zr_point from, struct zr_point to,
                          bool has_middle);

/* Adds a circle as a ring, of a point per degree at most. */
void zr_plot_add_circle(struct zr_plot *plot, enum zr_plot_pen pen, struct zr_point center, double radius);

/* Adds a filled arrow head with its point at `tip`, which points along the unit vector (dx, dy): 3 mm long. */
void zr_plot_add_arrow(struct zr_plot *plot, struct zr_point tip, double dx, double dy);

/* Adds a text whose ink begins at a point on its base line. */
void zr_plot_add_text(struct zr_plot *plot, const char *text, struct zr_point at, double height, bool is_upright);

/* Returns the width of a line, of letters, or 0 of an area. */
double zr_plot_width(const struct zr_plot_item *item);

/* Returns how many lengths of dashes a pen has. */
uint32_t zr_plot_dash_count(enum zr_plot_pen pen);

#endif
