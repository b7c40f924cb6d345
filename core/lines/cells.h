/* cells.h - lines: lists of the triangles that hide lines, by cells of 16 x 16 pixels.
 *
 * Space:  window_view.h. Cell 0 begins ZR_WINDOW_MARGIN to the left of and below the window.
 * How:    a triangle is listed in the cells that it overlaps, or that are within 1e-5 pixel of it.
 * Order:  lists ascend by hider; those of more than ZR_CELL_UNSORTED_MOST by `near` first, so that searches end early.
 * Exact:  the same for any number of threads. */
#ifndef ZR_CELLS_H
#define ZR_CELLS_H

#include "base/run.h"
#include "lines/window_mesh.h"

enum { ZR_CELL_PIXELS = 16 };

/* A box within a cell, rounded outwards, in ZR_BOX_STEPS per pixel from the cell's lower left. */
struct zr_cell_box {
    uint8_t low_x, low_y, high_x, high_y;
};

/* A triangle or cut piece of the window mesh in a cell. Most are far from a line in it, or behind; their boxes tell so
 * without a look at their corners. */
struct zr_cell_entry {
    uint32_t hider;
    float near; /* depth of its nearest corner, rounded towards the eye */
    struct zr_cell_box box;
};

enum { ZR_CELL_UNSORTED_MOST = 512 };

enum { ZR_BOX_STEPS = 16, ZR_CELL_STEPS = ZR_BOX_STEPS * ZR_CELL_PIXELS }; /* 256 */

struct zr_cells {
    uint32_t columns, rows;
    const uint32_t *firsts; /* columns * rows + 1: index of a cell's first entry */
    const struct zr_cell_entry *entries;
};

/* Returns ZR_OK, ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_cells_make(const struct zr_run *run, const struct zr_window_mesh *mesh, struct zr_cells *out);

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

/* Returns the step of a coordinate in a column or row, held within the cell. */
static inline uint8_t zr_box_step(double coordinate, uint32_t cell)
{
    const double step = (coordinate - zr_cell_border(cell)) * ZR_BOX_STEPS, most = ZR_CELL_STEPS - 1;
    return step >= most ? (uint8_t)most : step > 0.0 ? (uint8_t)step : 0;
}

/* True if all entries from this one on lie behind a depth. `count`: entries of the cell. */
static inline bool zr_cell_ends(const struct zr_cell_entry *entry, double depth, uint32_t count)
{
    return (double)entry->near > depth && count > ZR_CELL_UNSORTED_MOST;
}

/* True if two boxes of a cell have no point in common. */
static inline bool zr_boxes_are_apart(const struct zr_cell_box *a, const struct zr_cell_box *b)
{
    return (a->high_x < b->low_x) | (b->high_x < a->low_x) | (a->high_y < b->low_y) | (b->high_y < a->low_y);
}

#endif
