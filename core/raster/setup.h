/* setup.h - raster: one triangle -> edge functions and its depth plane.
 *
 * Space:  window space, y up; integers on the snapped grid of geometry/viewport.h.
 * Exact:  the reference's rules 7 (edges and the fill rule) and 8 (depth).
 */
#ifndef ZR_SETUP_H
#define ZR_SETUP_H

#include "raster/plane.h"

/* Inside where c + a X + b Y > 0 for all three edges, at integer pixels X, Y. */
struct zr_edge {
    int64_t a, b, c;
};

struct zr_setup {
    struct zr_edge edges[3];
    struct zr_plane depth;
    int32_t min_x, min_y, max_x, max_y; /* pixels whose centres the bounding box holds, inclusive */
};

/* The box alone. Empty (min > max) where no pixel centre lies inside. */
void zr_setup_box(const struct zr_window_vertex *vertices, const struct zr_triangle *triangle, int32_t box[4]);

struct zr_setup zr_setup_make(const struct zr_window_vertex *vertices, const struct zr_triangle *triangle);

#endif
