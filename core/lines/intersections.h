/* intersections.h - lines: lines along which pieces of the scene cut one another.
 *
 * Space:  window_view.h: planes and lines of space are planes and lines there.
 * How:    in each cell, triangles of two pieces whose boxes overlap are compared: the first is cut by the plane of the
 *         second, and the segment is clipped to the second. Corners within 1e-3 pixel of a plane lie on it; a triangle
 *         that does not cross the plane gives no line. The cell that holds the middle of a line emits it, so pairs
 *         whose planes meet outside a cell are left to other cells.
 *         Triangles of one piece (mesh/edge_mesh.h) and those that share a corner are not compared.
 * Exact:  lines are in the order of cells, the same for any number of threads. */
#ifndef ZR_INTERSECTIONS_H
#define ZR_INTERSECTIONS_H

#include "base/run.h"
#include "lines/cells.h"
#include "lines/lines.h"

/* Appends the lines to `lines`, which must be the newest allocation of the arena or is copied. Returns ZR_OK,
 * ZR_NO_MEMORY or ZR_CANCELLED. */
enum zr_status zr_intersections_add(const struct zr_run *run, const struct zr_window_mesh *mesh,
                                    const struct zr_cells *cells, struct zr_lines *lines);

/* Finds the line of two triangles, given by their corners. False if there is none. */
bool zr_intersection_of(const struct zr_window_point *const a[3], const struct zr_window_point *const b[3],
                        struct zr_window_point ends[2]);

#endif
