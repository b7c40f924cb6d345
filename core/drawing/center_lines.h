/* center_lines.h - drawing: centre lines of holes.
 *
 * Form:   ISO 128: a cross where a hole is seen along its axis, a line along its axis where it is seen from the side; both
 *         3 mm longer than the hole. Lines that lie on one another become one. Oblique holes have none. */
#ifndef ZR_CENTER_LINES_H
#define ZR_CENTER_LINES_H

#include "drawing/part_holes.h"
#include "drawing/placed_views.h"

enum zr_hole_side {
    ZR_HOLE_ROUND,   /* seen along its axis */
    ZR_HOLE_ALONG,   /* from the side */
    ZR_HOLE_OBLIQUE, /* neither */
    ZR_HOLE_GONE     /* in the removed half of a section */
};

/* Returns how a view shows a hole. */
enum zr_hole_side zr_hole_side_of(const struct zr_placed_views *placed, enum zr_page_view view,
                                  const struct zr_part_hole *hole);

/* Adds the lines of a view to the plot's group. `scratch` has room for them meanwhile. False without memory. */
bool zr_center_lines_add(struct zr_plot *plot, struct zr_arena *scratch, const struct zr_placed_views *placed,
                         enum zr_page_view view, const struct zr_part_holes *holes);

#endif
