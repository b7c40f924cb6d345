/* probe.h - drawing: the nearest triangle at a point of the window.
 *
 * Space:  window_view.h. */
#ifndef ZR_PROBE_H
#define ZR_PROBE_H

#include "lines/cells.h"

#define ZR_NO_HIDER UINT32_MAX

struct zr_probe {
    uint32_t hider; /* triangle or cut piece; ZR_NO_HIDER: background */
    double depth;
};

struct zr_probe zr_probe_at(const struct zr_window_mesh *mesh, const struct zr_cells *cells, double x, double y);

/* The hiders of a cell. */
struct zr_cell_hiders {
    uint32_t count;
    const struct zr_cell_entry *at;
};

struct zr_cell_hiders zr_cell_hiders_at(const struct zr_cells *cells, double x, double y);

/* Returns true if a hider covers a point, or touches it. */
bool zr_hider_covers(const struct zr_window_mesh *mesh, uint32_t hider, double x, double y);

/* Returns the depth of a hider's plane at a point. */
double zr_plane_depth(const struct zr_window_mesh *mesh, uint32_t hider, double x, double y);

/* Returns the cosine of the angle between two hiders, both turned towards the eye. */
float zr_hider_cosine(const struct zr_window_mesh *mesh, uint32_t a, uint32_t b);

#endif
