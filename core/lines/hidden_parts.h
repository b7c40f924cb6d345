/* hidden_parts.h - lines: which parts of each line are hidden, exactly.
 *
 * Space:  window_view.h; parts are intervals of t from 0 (ends[0]) to 1 (ends[1]).
 * How:    a line is cut at the borders of cells. In each cell, a triangle that the line does not lie on hides the
 *         interval in which it covers the line (by its three edge functions, 1e-6 to 1.5e-6 pixel outwards, as a line
 * may lie behind the common edge of two triangles) and the line lies behind its plane by more than 0.01 + 0.02 times
 * the slope of the plane. Gaps below 0.6 pixel between hidden parts close: pinholes and T-junctions. Then hidden parts
 * below 0.6 pixel are dropped, unless they reach an end of the line. Exact:  doubles; the same for any number of
 * threads. */
#ifndef ZR_HIDDEN_PARTS_H
#define ZR_HIDDEN_PARTS_H

#include "base/run.h"
#include "lines/cells.h"
#include "lines/lines.h"

struct zr_part_of_line {
    double begin, end;
};

struct zr_hidden_parts {
    const uint32_t *firsts;              /* lines.count + 1: index of a line's first part */
    const struct zr_part_of_line *parts; /* ascending, apart from one another */
};

#define ZR_HIDDEN_DEPTH      0.01
#define ZR_HIDDEN_SLOPE      0.02
#define ZR_HIDDEN_RIM        1e-6 /* less than the rim of cells */
#define ZR_HIDDEN_GAP_PIXELS 0.6

/* Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_hidden_parts_find(const struct zr_run *run, const struct zr_window_mesh *mesh,
                                    const struct zr_cells *cells, const struct zr_lines *lines,
                                    struct zr_hidden_parts *out);

#endif
