/* cells.h - drawing: lists of the triangles that hide lines, by cells of 8 x 8 pixels.
 *
 * Space:  window_view.h. Cell 0 begins ZR_WINDOW_MARGIN to the left of and below the window.
 * How:    a triangle is listed in the cells that it overlaps, or that are within 1e-5 pixel of it.
 * Exact:  lists ascend; the same for any number of threads. */
#ifndef ZR_CELLS_H
#define ZR_CELLS_H

#include "drawing/window_mesh.h"

enum { ZR_CELL_PIXELS = 8 };

struct zr_cells {
    uint32_t columns, rows;
    const uint32_t *firsts; /* columns * rows + 1: index of a cell's first entry */
    const uint32_t *hiders; /* triangles and cut pieces of the window mesh */
};

/* Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_cells_make(struct zr_arena *arena, struct zr_team *team, const struct zr_cancel *cancel,
                             const struct zr_window_mesh *mesh, struct zr_cells *out);

/* Returns the column or row of a coordinate, held within 0 .. count - 1. */
static inline uint32_t zr_cell_at(double coordinate, uint32_t count)
{
    const double cell = (coordinate + ZR_WINDOW_MARGIN) * (1.0 / ZR_CELL_PIXELS);
    if (!(cell >= 1.0)) return 0;
    return cell >= (double)count ? count - 1 : (uint32_t)cell;
}

/* Returns the lower border of a column or row. */
static inline double zr_cell_border(uint32_t cell)
{
    return (double)cell * ZR_CELL_PIXELS - ZR_WINDOW_MARGIN;
}

#endif
